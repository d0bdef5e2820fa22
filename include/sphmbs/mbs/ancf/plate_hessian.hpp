// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/ancf/plate_strain.hpp>

namespace sphmbs::mbs::ancf::detail {

/// A 3 x 3 matrix, row by row.
template <class N>
struct Block {
  std::array<Vec3<N>, 3> row;

  static SPHMBS_INLINE Block zero() {
    const Vec3<N> none = Vec3<N>::all(N(0.0));
    return {{none, none, none}};
  }
  /// += x y^T.
  SPHMBS_INLINE Block& add(const Vec3<N>& x, const Vec3<N>& y) {
    row[0] += x[0] * y;
    row[1] += x[1] * y;
    row[2] += x[2] * y;
    return *this;
  }
  /// += s I.
  SPHMBS_INLINE Block& add(const N& s) {
    row[0][0] += s;
    row[1][1] += s;
    row[2][2] += s;
    return *this;
  }
  /// += the matrix of x times (cross product).
  SPHMBS_INLINE Block& add_cross(const Vec3<N>& x) {
    row[0][1] -= x[2];
    row[0][2] += x[1];
    row[1][0] += x[2];
    row[1][2] -= x[0];
    row[2][0] -= x[1];
    row[2][1] += x[0];
    return *this;
  }
  /// += s B.
  SPHMBS_INLINE Block& add(const N& s, const Block& B) {
    row[0] += s * B.row[0];
    row[1] += s * B.row[1];
    row[2] += s * B.row[2];
    return *this;
  }
  SPHMBS_INLINE Block& add(const Block& B) {
    row[0] += B.row[0];
    row[1] += B.row[1];
    row[2] += B.row[2];
    return *this;
  }
  SPHMBS_INLINE Block transpose() const {
    return {{Vec3<N>{row[0][0], row[1][0], row[2][0]}, Vec3<N>{row[0][1], row[1][1], row[2][1]},
             Vec3<N>{row[0][2], row[1][2], row[2][2]}}};
  }
};

/// Derivative of PlateSurface::force in g by 3 x 3 blocks: left^T D right + sum of the stresses
/// times the second derivatives of their strains. Without damping `right` is `left` and the matrix
/// is symmetric; only the blocks m <= n are set then.
template <class N, bool symmetric>
struct SurfaceHessian {
  std::array<std::array<Block<N>, 5>, 5> block;

  SPHMBS_INLINE void set(const PlateSurface<N>& at, const StrainRows<N>& left,
                         const StrainRows<N>& right, const PlateStiffness<N>& D,
                         const Strain<N>& stress) {
    for (std::size_t m = 0; m < 5; ++m)
      for (std::size_t n = symmetric ? m : 0; n < 5; ++n) block[m][n] = Block<N>::zero();
    add_membrane(left, right, D.membrane);
    add_bending(left, right, D.bending);
    add_stress(at, stress);
  }

  /// Sum over n of block (m, n) times G[n].
  SPHMBS_INLINE Block<N> row_times(std::size_t m, const N* G) const {
    Block<N> sum = Block<N>::zero();
#pragma GCC unroll 5
    for (std::size_t n = 0; n < 5; ++n) {
      if (symmetric && n < m)
        sum.add(G[n], block[n][m].transpose());
      else
        sum.add(G[n], block[m][n]);
    }
    return sum;
  }

 private:
  SPHMBS_INLINE void add_membrane(const StrainRows<N>& l, const StrainRows<N>& r,
                                  const PlaneStress<N>& D) {
    block[0][0].add(D.direct * l.a, r.a).add(D.shear * l.b, r.b);
    block[0][1].add(D.across * l.a, r.b).add(D.shear * l.b, r.a);
    block[1][1].add(D.direct * l.b, r.b).add(D.shear * l.a, r.a);
    if constexpr (!symmetric) block[1][0].add(D.across * l.b, r.a).add(D.shear * l.a, r.b);
  }

  SPHMBS_INLINE void add_bending(const StrainRows<N>& l, const StrainRows<N>& r,
                                 const PlaneStress<N>& D) {
    const auto alpha = D.stress(l.alpha), beta = D.stress(l.beta);
    for (std::size_t i = 0; i < 3; ++i) {
      block[0][0].add(alpha[i], r.alpha[i]);
      block[0][1].add(alpha[i], r.beta[i]);
      block[1][1].add(beta[i], r.beta[i]);
      block[0][i + 2].add(alpha[i], r.p);
      block[1][i + 2].add(beta[i], r.p);
    }
    block[2][2].add(D.direct * l.p, r.p);
    block[2][3].add(D.across * l.p, r.p);
    block[3][3].add(D.direct * l.p, r.p);
    block[4][4].add(D.shear * l.p, r.p);
    if constexpr (!symmetric) {
      const auto right_alpha = D.stress(r.alpha), right_beta = D.stress(r.beta);
      for (std::size_t i = 0; i < 3; ++i) {
        block[1][0].add(beta[i], r.alpha[i]);
        block[i + 2][0].add(l.p, right_alpha[i]);
        block[i + 2][1].add(l.p, right_beta[i]);
      }
      block[3][2].add(D.across * l.p, r.p);
    }
  }

  // With the moment vector m = sum of M_i h_i and A = dn/dr_x, B = dn/dr_y, the second derivative
  // of p.m is A^T Q A and so on, Q = d^2(p.m)/dn^2 = x p^T + p x^T + c (p.m) I, and n itself is
  // bilinear.
  SPHMBS_INLINE void add_stress(const PlateSurface<N>& at, const Strain<N>& stress) {
    const auto& [S, M] = stress;
    const Vec3<N>&a = at.a(), &b = at.b(), &n = at.n(), &p = at.p();
    const Vec3<N> m = at.moment(M);
    const N c = N(-3.0) * at.inverse2(), pm = dot(p, m);
    const Vec3<N> x = c * m + N(7.5) * pm * at.inverse() * n;
    const Vec3<N> bx = cross(b, x), bp = cross(b, p), xa = cross(x, a), pa = cross(p, a);
    const N q = c * pm;
    block[0][0].add(bx, bp).add(bp, bx).add(-q * b, b).add(q * dot(b, b) + S[0]);
    block[1][1].add(xa, pa).add(pa, xa).add(-q * a, a).add(q * dot(a, a) + S[1]);
    Block<N> ab = Block<N>::zero();
    ab.add(bx, pa).add(bp, xa).add(q * a, b).add(S[2] - q * dot(a, b));
    ab.add_cross(-N(1.0) * at.turned(m));
    add_with_transpose(0, 1, ab);
    for (std::size_t i = 0; i < 3; ++i) {
      const N s = M[i] * at.inverse3();
      Block<N> ah = Block<N>::zero(), bh = Block<N>::zero();
      ah.add(M[i] * c * bp, n).add_cross(s * b);
      bh.add(M[i] * c * pa, n).add_cross(-s * a);
      add_with_transpose(0, i + 2, ah);
      add_with_transpose(1, i + 2, bh);
    }
  }

  SPHMBS_INLINE void add_with_transpose(std::size_t m, std::size_t n, const Block<N>& B) {
    block[m][n].add(B);
    if constexpr (!symmetric) block[n][m].add(B.transpose());
  }
};

}  // namespace sphmbs::mbs::ancf::detail
