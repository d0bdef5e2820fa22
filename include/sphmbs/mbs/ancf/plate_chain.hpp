// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include <sphmbs/mbs/ancf/plate_hessian.hpp>
#include <sphmbs/mbs/ancf/plate_nodal.hpp>

namespace sphmbs::mbs::ancf::detail {

/// Doubles are computed with several Gauss points at once, other types one by one.
template <class S>
using PointNumber =
    std::conditional_t<std::is_same_v<S, double>, Number<double, native_lanes<double>>, S>;

/// How many points an N stands for.
template <class N>
constexpr int lanes_of() {
  if constexpr (requires { N::lanes; }) return N::lanes;
  return 1;
}

/// That many points from a table.
template <class N>
SPHMBS_INLINE N points_at(const double* table) {
  if constexpr (requires { N::lanes; })
    return N::load(table);
  else
    return N(*table);
}

inline std::complex<double> lane_sum(const std::complex<double>& a) { return a; }
using sphmbs::lane_sum;

/// Energy, forces and tangent of a plate element: the surface's derivatives at 4 x 4 Gauss points,
/// chained through the shape functions. The tables are those of the unit square: sizes enter by
/// factors at nodes (PlateScale) and at points. The stiffness comes multiplied with the element's
/// area. With `damped`, the stress is D (e + tau de/dt).
template <class Shape>
class PlateChain {
 public:
  static constexpr const auto& table = plate_table<Shape, 4>;
  static constexpr int functions = PlateFunctions<Shape>::size;
  static constexpr int dofs = 3 * functions;

  PlateChain(double length, double width)
      : scale_(length, width),
        point_{1 / length, 1 / width, 1 / (length * length), 1 / (width * width),
               1 / (length * width)} {}

  template <class S>
  S energy(const PlateStiffness<double>& D, const Vector<dofs, S>& q) const {
    using N = PointNumber<S>;
    const Nodal<S> x(scale_, q);
    S sum(0);
    for (int p = 0; p < points; p += lanes_of<N>()) {
      const Strain<N> strain = surface<N>(x, p).strain();
      sum += 0.5 * lane_sum(work(weighted<N>(D, p).stress(strain), strain));
    }
    return sum;
  }

  /// Integral of D (de/dt)^2.
  double squared_rate(const PlateStiffness<double>& D, const Vector<dofs>& q,
                      const Vector<dofs>& v) const {
    using N = PointNumber<double>;
    const Nodal<double> x(scale_, q), u(scale_, v);
    double sum = 0;
    for (int p = 0; p < points; p += lanes_of<N>()) {
      const Strain<N> rate = surface<N>(x, p).rate(vectors<N>(u, p));
      sum += lane_sum(work(weighted<N>(D, p).stress(rate), rate));
    }
    return sum;
  }

  template <bool damped, class S>
  Vector<dofs, S> force(const PlateStiffness<double>& D, const Vector<dofs, S>& q,
                        const Vector<dofs, S>& v, double tau) const {
    using N = PointNumber<S>;
    constexpr int lanes = lanes_of<N>();
    const Nodal<S> x(scale_, q);
    const Rates<damped, S> u(scale_, v);
    Array<SurfaceVectors<N>, points / lanes> f;
    for (int p = 0; p < points; p += lanes) {
      const PlateSurface<N> at = surface<N>(x, p);
      Strain<N> strain = at.strain();
      if constexpr (damped) strain.add(N(tau), at.rate(vectors<N>(u, p)));
      f[p / lanes] = at.force(weighted<N>(D, p).stress(strain));
      for (std::size_t m = 0; m < 5; ++m) f[p / lanes][m] = N(point_[m]) * f[p / lanes][m];
    }
    Vector<dofs, S> F;
    for (int k = 0; k < functions; ++k) {
      Vec3<N> sum = Vec3<N>::all(N(0.0));
      for (int p = 0; p < points; p += lanes)
#pragma GCC unroll 5
        for (std::size_t m = 0; m < 5; ++m)
          sum += points_at<N>(table.derivative[m][k] + p) * f[p / lanes][m];
      for (int c = 0; c < 3; ++c) F[3 * k + c] = scale_(k) * lane_sum(sum[c]);
    }
    return F;
  }

  /// d force/dq + w d force/dv.
  template <bool damped>
  Matrix<dofs, dofs> tangent(const PlateStiffness<double>& D, const Vector<dofs>& q,
                             const Vector<dofs>& v, double tau, double w) const {
    using N = PointNumber<double>;
    constexpr int lanes = lanes_of<N>();
    const Nodal<double> x(scale_, q);
    const Rates<damped, double> u(scale_, v);
    Array<Hessian<damped>, packs> H;
    for (int p = 0; p < points; p += lanes) {
      const PlateSurface<N> at = surface<N>(x, p);
      const PlateStiffness<N> weighted_D = weighted<N>(D, p);
      const StrainRows<N> rows = at.rows();
      Strain<N> strain = at.strain();
      if constexpr (damped) {
        const SurfaceVectors<N> rates = vectors<N>(u, p);
        strain.add(N(tau), at.rate(rates));
        H[p / lanes].set(at, rows, at.viscous_rows(rates, N(tau), N(w)), weighted_D,
                         weighted_D.stress(strain));
      } else {
        H[p / lanes].set(at, rows, rows, weighted_D, weighted_D.stress(strain));
      }
    }
    return chained<damped>(H);
  }

 private:
  using Lanes = PointNumber<double>;
  static constexpr int points = table.points;
  static constexpr int packs = points / lanes_of<Lanes>();
  template <bool damped>
  using Hessian = SurfaceHessian<Lanes, !damped>;

  template <class S>
  using Nodal = NodalVectors<Shape, S>;
  struct NoRates {
    NoRates(const PlateScale<Shape>&, const auto&) {}
  };
  template <bool damped, class S>
  using Rates = std::conditional_t<damped, Nodal<S>, NoRates>;

  template <class N, class S>
  SPHMBS_INLINE SurfaceVectors<N> vectors(const Nodal<S>& x, int p) const {
    SurfaceVectors<N> g;
    for (Vec3<N>& vector : g) vector = Vec3<N>::all(N(0.0));
    for (int k = 0; k < functions; ++k) {
      const Vec3<N> nodal{N(x.value[k][0]), N(x.value[k][1]), N(x.value[k][2])};
#pragma GCC unroll 5
      for (std::size_t m = 0; m < 5; ++m) g[m] += points_at<N>(table.derivative[m][k] + p) * nodal;
    }
    for (std::size_t m = 0; m < 5; ++m) g[m] = N(point_[m]) * g[m];
    return g;
  }

  template <class N, class S>
  SPHMBS_INLINE PlateSurface<N> surface(const Nodal<S>& x, int p) const {
    return PlateSurface<N>(vectors<N>(x, p));
  }

  template <class N>
  static SPHMBS_INLINE PlateStiffness<N> weighted(const PlateStiffness<double>& D, int p) {
    const N w = points_at<N>(table.weight + p);
    const auto& [m, b] = D;
    return {{w * N(m.direct), w * N(m.across), w * N(m.shear)},
            {w * N(b.direct), w * N(b.across), w * N(b.shear)}};
  }

  // K = sum of G^T H G over the points, G = dg/dq: one column of 3 x 3 blocks after the other.
  template <bool damped>
  Matrix<dofs, dofs> chained(const Hessian<damped>* H) const {
    using N = Lanes;
    Array<Array<N[5], packs>, functions> G;
    for (int k = 0; k < functions; ++k)
      for (int p = 0; p < packs; ++p)
        for (std::size_t m = 0; m < 5; ++m)
          G[k][p][m] =
              N(scale_(k) * point_[m]) * points_at<N>(table.derivative[m][k] + p * lanes_of<N>());
    Matrix<dofs, dofs> K;
    for (int l = 0; l < functions; ++l) {
      Array<Block<N>[5], packs> T;
      for (int p = 0; p < packs; ++p)
#pragma GCC unroll 5
        for (std::size_t m = 0; m < 5; ++m) T[p][m] = H[p].row_times(m, G[l][p]);
      for (int k = 0; k < (damped ? functions : l + 1); ++k) {
        Block<N> sum = Block<N>::zero();
        for (int p = 0; p < packs; ++p)
#pragma GCC unroll 5
          for (std::size_t m = 0; m < 5; ++m) sum.add(G[k][p][m], T[p][m]);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            K(3 * k + i, 3 * l + j) = lane_sum(sum.row[static_cast<std::size_t>(i)][j]);
            if constexpr (!damped) K(3 * l + j, 3 * k + i) = K(3 * k + i, 3 * l + j);
          }
      }
    }
    return K;
  }

  PlateScale<Shape> scale_;
  std::array<double, 5> point_;
};

}  // namespace sphmbs::mbs::ancf::detail
