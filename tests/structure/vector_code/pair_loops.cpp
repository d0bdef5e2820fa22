// SPDX-License-Identifier: MIT
// The pair loop as functions that vector_code.cmake finds in the object code.
#include <cstddef>

#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/kernels/quintic_spline.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/sph/rates.hpp>

namespace {

template <int dim, int lanes>
using Body = sphmbs::sph::EvaluateRates<
    sphmbs::sph::RiemannSph<sphmbs::kernels::QuinticSpline<dim>, sphmbs::riemann::Acoustic,
                            sphmbs::eos::IdealGas>,
    double, lanes>;

constexpr int wide = sphmbs::native_lanes<double>;

}  // namespace

extern "C" {

[[gnu::noinline]] void pair_loop_2d(const Body<2, wide>& body, std::size_t i) { body(i); }

[[gnu::noinline]] void pair_loop_3d(const Body<3, wide>& body, std::size_t i) { body(i); }

// What the check must refuse: a neighbour at a time.
[[gnu::noinline]] void scalar_pair_loop_3d(const Body<3, 1>& body, std::size_t i) { body(i); }
}
