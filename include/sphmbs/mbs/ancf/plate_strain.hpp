// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <complex>

#include <sphmbs/core/math.hpp>
#include <sphmbs/core/vec.hpp>

/// The thin plate at one point of its surface, or at several at once: strains, stresses and
/// derivatives of the energy in the five vectors g = (r_x, r_y, r_xx, r_yy, r_xy), for any number
/// type N. Elements chain them through their shape functions.
namespace sphmbs::mbs::ancf::detail {

template <class N>
using Vec3 = Vec<3, N>;
template <class N>
using SurfaceVectors = std::array<Vec3<N>, 5>;  // r_x, r_y, r_xx, r_yy, r_xy

template <class N>
SPHMBS_INLINE Vec3<N> cross(const Vec3<N>& a, const Vec3<N>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class N>
SPHMBS_INLINE N root(const N& x) {
  return math::sqrt(x);
}
inline std::complex<double> root(const std::complex<double>& x) { return std::sqrt(x); }

/// Three components of strain, or of stress, 11, 22 and 12: of the membrane and of bending. The
/// bending strains are p.r_xx, p.r_yy and p.r_xy with p = n/|n|^3: k12 is twice the last.
template <class N>
struct Strain {
  std::array<N, 3> membrane, bending;

  /// += s e.
  SPHMBS_INLINE void add(const N& s, const Strain& e) {
    for (std::size_t i = 0; i < 3; ++i) {
      membrane[i] += s * e.membrane[i];
      bending[i] += s * e.bending[i];
    }
  }
};

/// Sum of products of stresses and strains.
template <class N>
SPHMBS_INLINE N work(const Strain<N>& a, const Strain<N>& b) {
  N sum = a.membrane[0] * b.membrane[0] + a.bending[0] * b.bending[0];
  for (std::size_t i = 1; i < 3; ++i)
    sum += a.membrane[i] * b.membrane[i] + a.bending[i] * b.bending[i];
  return sum;
}

/// Isotropic plane stress for one set of three strains.
template <class N>
struct PlaneStress {
  N direct, across, shear;

  /// Of numbers, or of vectors.
  template <class T>
  SPHMBS_INLINE std::array<T, 3> stress(const std::array<T, 3>& e) const {
    return {direct * e[0] + across * e[1], direct * e[1] + across * e[0], shear * e[2]};
  }
};

/// Stiffness of a plate, per area or times an area, so that sums over points need no more weights.
template <class N>
struct PlateStiffness {
  PlaneStress<N> membrane, bending;

  SPHMBS_INLINE Strain<N> stress(const Strain<N>& e) const {
    return {membrane.stress(e.membrane), bending.stress(e.bending)};
  }
};

/// Rows of the derivative of the strains in g, or their rates, with h = (r_xx, r_yy, r_xy):
///   d membrane  = (a.dr_x, b.dr_y, b.dr_x + a.dr_y)
///   d bending_i = alpha_i.dr_x + beta_i.dr_y + p.dh_i
template <class N>
struct StrainRows {
  Vec3<N> a, b, p;
  std::array<Vec3<N>, 3> alpha, beta;
};

/// The surface at a point.
template <class N>
class PlateSurface {
 public:
  SPHMBS_INLINE explicit PlateSurface(const SurfaceVectors<N>& g)
      : a_(g[0]), b_(g[1]), h_{g[2], g[3], g[4]}, n_(cross(a_, b_)) {
    inverse2_ = N(1.0) / dot(n_, n_);
    inverse_ = root(inverse2_);
    inverse3_ = inverse_ * inverse2_;
    p_ = inverse3_ * n_;
  }

  SPHMBS_INLINE Strain<N> strain() const {
    const N half(0.5), one(1.0);
    return {{half * (dot(a_, a_) - one), half * (dot(b_, b_) - one), dot(a_, b_)},
            {dot(p_, h_[0]), dot(p_, h_[1]), dot(p_, h_[2])}};
  }

  /// Rate of the strains while g changes at the rate v.
  SPHMBS_INLINE Strain<N> rate(const SurfaceVectors<N>& v) const {
    const Vec3<N> dp = director_rate(v);
    return {{dot(a_, v[0]), dot(b_, v[1]), dot(a_, v[1]) + dot(b_, v[0])},
            {dot(p_, v[2]) + dot(dp, h_[0]), dot(p_, v[3]) + dot(dp, h_[1]),
             dot(p_, v[4]) + dot(dp, h_[2])}};
  }

  /// Sum of the stresses times the derivatives of their strains in g: the gradient of the energy.
  SPHMBS_INLINE SurfaceVectors<N> force(const Strain<N>& stress) const {
    const auto& [S, M] = stress;
    const Vec3<N> w = turned(moment(M));
    return {S[0] * a_ + S[2] * b_ + cross(b_, w), S[1] * b_ + S[2] * a_ + cross(w, a_), M[0] * p_,
            M[1] * p_, M[2] * p_};
  }

  SPHMBS_INLINE StrainRows<N> rows() const {
    StrainRows<N> rows{.a = a_, .b = b_, .p = p_, .alpha = {}, .beta = {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3<N> w = turned(h_[i]);
      rows.alpha[i] = cross(b_, w);
      rows.beta[i] = cross(w, a_);
    }
    return rows;
  }

  /// (1 + w tau) rows + tau d(rows)/dt while g changes at the rate v: what the viscous stress
  /// tau D rate adds to the derivative of the stresses.
  SPHMBS_INLINE StrainRows<N> viscous_rows(const SurfaceVectors<N>& v, N tau, N w) const {
    const N scale = N(1.0) + w * tau;
    const Vec3<N> dn = cross(v[0], b_) + cross(a_, v[1]);
    StrainRows<N> sum = rows();
    sum.a = scale * a_ + tau * v[0];
    sum.b = scale * b_ + tau * v[1];
    sum.p = scale * p_ + tau * turned(dn);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3<N> u = turned(h_[i]), du = turned(v[i + 2]) + bent(h_[i], dn);
      sum.alpha[i] = scale * sum.alpha[i] + tau * (cross(v[1], u) + cross(b_, du));
      sum.beta[i] = scale * sum.beta[i] + tau * (cross(du, a_) + cross(u, v[0]));
    }
    return sum;
  }

  const Vec3<N>& a() const { return a_; }
  const Vec3<N>& b() const { return b_; }
  const Vec3<N>& n() const { return n_; }
  const Vec3<N>& p() const { return p_; }
  N inverse() const { return inverse_; }
  N inverse2() const { return inverse2_; }
  N inverse3() const { return inverse3_; }

  /// Sum of the moments times h.
  SPHMBS_INLINE Vec3<N> moment(const std::array<N, 3>& M) const {
    return M[0] * h_[0] + M[1] * h_[1] + M[2] * h_[2];
  }

  /// (dp/dn) x, with dp/dn = (I - 3 n n^T/|n|^2)/|n|^3.
  SPHMBS_INLINE Vec3<N> turned(const Vec3<N>& x) const {
    return inverse3_ * x - N(3.0) * inverse2_ * dot(p_, x) * n_;
  }

 private:
  SPHMBS_INLINE Vec3<N> director_rate(const SurfaceVectors<N>& v) const {
    return turned(cross(v[0], b_) + cross(a_, v[1]));
  }

  /// (d^2(p.x)/dn^2) y = -3/|n|^5 (x n^T + n x^T + (n.x) I) y + 15 (n.x)/|n|^7 n n^T y.
  SPHMBS_INLINE Vec3<N> bent(const Vec3<N>& x, const Vec3<N>& y) const {
    const N c = N(-3.0) * inverse2_, py = dot(p_, y), px = dot(p_, x);
    return c * (py * x + px * y) +
           (c * inverse3_ * dot(x, y) + N(15.0) * inverse2_ * inverse2_ * px * dot(n_, y)) * n_;
  }

  Vec3<N> a_, b_;
  std::array<Vec3<N>, 3> h_;
  Vec3<N> n_, p_;
  N inverse_, inverse2_, inverse3_;  // 1/|n| and its powers
};

}  // namespace sphmbs::mbs::ancf::detail
