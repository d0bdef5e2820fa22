// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include <sphmbs/core/math.hpp>

namespace sphmbs::sph {

/// How two particles weigh the face between them: the pair's force on a is
/// -m_a m_b area(rho_a, rho_b) p* grad W, and dilation(rho_a, rho_b) m_b (u* - u_a) dW/dr is half
/// of what it adds to d rho_a / dt.
template <class F>
concept FluxForm = std::is_trivially_copyable_v<F> && requires(const F form, double rho) {
  { form.area(rho, rho) } -> std::same_as<double>;      // [m^6/kg^2]
  { form.dilation(rho, rho) } -> std::same_as<double>;  // [-]
};

/// The paper's, eqs. (20)-(22): 1/rho_a^2 + 1/rho_b^2 in the force, 1 in the density.
struct MassForm {
  /// For densities a and b, see `FluxForm` [m^6/kg^2].
  template <class N>
  SPHMBS_INLINE N area(N a, N b) const {
    return N(1) / (a * a) + N(1) / (b * b);
  }
  /// For densities a and b, see `FluxForm` [-].
  template <class N>
  SPHMBS_INLINE N dilation(N, N) const {
    return N(1);
  }
};

/// Volumes weigh, 2/(rho_a rho_b), in the force, the work and the change of volume alike (Vila
/// 1999; Parshikov and Medin 2002). The faces that push are then the faces that move, so that
/// shocks obey the jump conditions, and the energy together with background pressure times volume
/// is conserved pair by pair.
struct VolumeForm {
  /// For densities a and b, see `FluxForm` [m^6/kg^2].
  template <class N>
  SPHMBS_INLINE N area(N a, N b) const {
    return N(2) / (a * b);
  }
  /// For densities a and b, see `FluxForm` [-].
  template <class N>
  SPHMBS_INLINE N dilation(N a, N b) const {
    return a / b;
  }
};

static_assert(FluxForm<MassForm> && FluxForm<VolumeForm>);

}  // namespace sphmbs::sph
