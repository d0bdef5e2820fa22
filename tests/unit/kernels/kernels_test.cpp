// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <tuple>

#include <sphmbs/core/pack.hpp>
#include <sphmbs/kernels/cubic_spline.hpp>
#include <sphmbs/kernels/quintic_spline.hpp>
#include <sphmbs/kernels/wendland.hpp>

#include "support/catch.hpp"
#include "support/quadrature.hpp"

namespace {

using namespace sphmbs::kernels;

using Kernels =
    std::tuple<QuinticSpline<1>, QuinticSpline<2>, QuinticSpline<3>, CubicSpline<1>, CubicSpline<2>,
               CubicSpline<3>, WendlandC2<1>, WendlandC2<2>, WendlandC2<3>, WendlandC4<1>,
               WendlandC4<2>, WendlandC4<3>, WendlandC6<1>, WendlandC6<2>, WendlandC6<3>>;

// Pieces are polynomials of degree 11 at most, so the quadrature is exact but for rounding.
constexpr double rounding = 1e-12;

/// Integral of f over R from `from` to the support, piece by piece.
template <class K, class F>
double integral_to_support(double from, F&& f) {
  double sum = 0;
  for (double a = from; a < K::support;) {
    const double b = std::floor(a) + 1;
    sum += test::integral(a, b, f);
    a = b;
  }
  return sum;
}

template <class K>
constexpr double sphere = K::dim == 1   ? 2
                          : K::dim == 2 ? 2 * sphmbs::math::pi
                                        : 4 * sphmbs::math::pi;

/// sum m W / rho - 1 of the quintic spline at a point of a lattice of unit spacing.
template <int Dim>
double lattice_sum(double h, const double (&place)[3]) {
  double sum = 0;
  const int y_reach = Dim > 1 ? 12 : 0;
  const int z_reach = Dim > 2 ? 12 : 0;
  for (int i = -12; i <= 12; ++i)
    for (int j = -y_reach; j <= y_reach; ++j)
      for (int k = -z_reach; k <= z_reach; ++k) {
        const double x = i + place[0];
        const double y = Dim > 1 ? j + place[1] : 0;
        const double z = Dim > 2 ? k + place[2] : 0;
        sum += value<QuinticSpline<Dim>>(std::sqrt(x * x + y * y + z * z), 1 / h);
      }
  return sum - 1;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("the integral of a smoothing function over space is 1", "[kernels]",
                        Kernels) {
  using K = TestType;
  for (const double h : {1.0, 0.037}) {
    const double integral = integral_to_support<K>(0, [h](double R) {
      return sphere<K> * std::pow(R * h, K::dim - 1) * h * value<K>(R * h, 1 / h);
    });
    CHECK(std::abs(integral - 1) < rounding);
  }
}

TEMPLATE_LIST_TEST_CASE("the slope is the derivative of the shape", "[kernels]", Kernels) {
  using K = TestType;
  for (double R = 0; R < K::support; R += 0.0625) {
    CAPTURE(R);
    const double integral = integral_to_support<K>(R, [](double x) { return K::slope(x); });
    CHECK(std::abs(integral + K::shape(R)) < rounding * K::shape(0.0));
  }
}

TEMPLATE_LIST_TEST_CASE("a smoothing function and its slope vanish from the support on",
                        "[kernels]", Kernels) {
  using K = TestType;
  for (const double R : {K::support, K::support * (1 + 1e-15), K::support + 1, 100.0}) {
    CHECK(K::shape(R) == 0);
    CHECK(K::slope(R) == 0);
  }
  CHECK(K::shape(K::support * (1 - 1e-3)) > 0);
}

TEMPLATE_LIST_TEST_CASE("a smoothing function falls from its peak to zero", "[kernels]", Kernels) {
  using K = TestType;
  CHECK(std::abs(K::slope(0.0)) < rounding * K::shape(0.0));
  const double last = 0.99 * K::support;
  for (double R = 0.01; R < last; R += 0.01) {
    REQUIRE(K::shape(R) > 0);
    REQUIRE(K::shape(R) < K::shape(R - 0.01));
    REQUIRE(K::slope(R) < 0);
  }
}

TEMPLATE_LIST_TEST_CASE("value and derivative scale with the smoothing length", "[kernels]",
                        Kernels) {
  using K = TestType;
  const double h = 0.3;
  for (const double R : {0.0, 0.4, 1.3, 1.9}) {
    CHECK(value<K>(R * h, 1 / h) ==
          Approx(K::normalisation * K::shape(R) / std::pow(h, K::dim)).epsilon(rounding));
    CHECK(derivative<K>(R * h, 1 / h) ==
          Approx(K::normalisation * K::slope(R) / std::pow(h, K::dim + 1)).epsilon(1e-11));
  }
}

TEMPLATE_LIST_TEST_CASE("packs of distances give what single distances give", "[kernels]",
                        Kernels) {
  using K = TestType;
  const auto check = []<class T, int W>(std::type_identity<sphmbs::Pack<T, W>>) {
    // Packs and plain numbers may be contracted to fused operations at different places.
    const T tolerance = 64 * std::numeric_limits<T>::epsilon() * K::shape(T(0));
    for (int begin = 0; begin < 64; begin += W) {
      sphmbs::Pack<T, W> R(T(0));
      for (int l = 0; l < W; ++l) R.v[l] = T(begin + l) * T(0.05);
      const auto shape = K::shape(R);
      const auto slope = K::slope(R);
      for (int l = 0; l < W; ++l) {
        CHECK(std::abs(shape.v[l] - K::shape(T(R.v[l]))) <= tolerance);
        CHECK(std::abs(slope.v[l] - K::slope(T(R.v[l]))) <= tolerance);
      }
    }
  };
  check(std::type_identity<sphmbs::Pack<double, 2>>{});
  check(std::type_identity<sphmbs::Pack<double, 4>>{});
  check(std::type_identity<sphmbs::Pack<double, 8>>{});
  check(std::type_identity<sphmbs::Pack<float, 4>>{});
  check(std::type_identity<sphmbs::Pack<float, 8>>{});
}

TEST_CASE("the quintic spline has the pieces of eq. 10", "[kernels]") {
  using K = QuinticSpline<2>;
  CHECK(K::shape(0.0) == 66);
  CHECK(K::shape(1.0) == 26);
  CHECK(K::shape(2.0) == 1);
  CHECK(K::shape(0.5) == Approx(std::pow(2.5, 5) - 6 * std::pow(1.5, 5) + 15 * std::pow(0.5, 5)));
  CHECK(K::shape(1.5) == Approx(std::pow(1.5, 5) - 6 * std::pow(0.5, 5)));
  CHECK(K::shape(2.5) == Approx(std::pow(0.5, 5)));
}

TEST_CASE("the quintic spline's second moments are those of its constants", "[kernels]") {
  const auto moment = []<int Dim>(std::integral_constant<int, Dim>) {
    using K = QuinticSpline<Dim>;
    return integral_to_support<K>(0,
                                  [](double R) {
                                    return sphere<K> * std::pow(R, Dim + 1) * K::normalisation *
                                           K::shape(R);
                                  }) /
           Dim;
  };
  CHECK(std::abs(moment(std::integral_constant<int, 1>{}) - 1.0 / 2) < rounding);
  CHECK(std::abs(moment(std::integral_constant<int, 2>{}) - 2771.0 / 5736) < rounding);
  CHECK(std::abs(moment(std::integral_constant<int, 3>{}) - 7.0 / 15) < rounding);
}

TEST_CASE("sums of the quintic spline over a lattice are known", "[kernels]") {
  // Reference values are printed to 12 digits after the point of a number near 1e-4.
  constexpr double printed = 1e-13;
  struct Row {
    double ratio;
    double node[3];
    double centre[3];
    double edge[3];
  };
  const Row rows[] = {{1.00,
                       {0, 6.322459462282e-05, -2.004033834768e-05},
                       {0, 1.451181181091e-04, -6.746071478092e-05},
                       {0, -1.057128969275e-04, -1.757479112108e-05}},
                      {1.25,
                       {7.68e-05, -7.568094783783e-05, -8.876358835896e-05},
                       {-5.973333333331e-05, 1.060703102329e-04, 1.425136791395e-04},
                       {-5.973333333331e-05, -3.963618766645e-06, -4.424815468029e-05}},
                      {1.50,
                       {1.828989483315e-04, 1.551239444118e-04, 7.671705133894e-05},
                       {-1.828989483316e-04, -1.589436248953e-04, -7.588900355648e-05},
                       {-1.828989483316e-04, 1.605373927571e-06, 2.083791061258e-05}},
                      {2.00,
                       {0, -7.707702804893e-07, 2.445815441288e-07},
                       {0, 8.656039949262e-07, 3.024340247126e-07},
                       {0, -4.796330621559e-08, -5.721926021884e-08}}};
  for (const Row& row : rows) {
    CAPTURE(row.ratio);
    const auto check = [&](const double(&expected)[3], const double(&place)[3]) {
      CHECK(std::abs(lattice_sum<1>(row.ratio, place) - expected[0]) < printed);
      CHECK(std::abs(lattice_sum<2>(row.ratio, place) - expected[1]) < printed);
      CHECK(std::abs(lattice_sum<3>(row.ratio, place) - expected[2]) < printed);
    };
    check(row.node, {0, 0, 0});
    check(row.centre, {0.5, 0.5, 0.5});
    check(row.edge, {0.5, 0, 0});
  }
}
