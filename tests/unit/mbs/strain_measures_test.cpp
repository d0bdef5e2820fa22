// SPDX-License-Identifier: MIT
#include <cmath>

#include <sphmbs/mbs/ancf/strain_measures.hpp>

#include "support/catch.hpp"
#include "support/element_laws.hpp"

using namespace sphmbs::mbs;
using namespace sphmbs::mbs::ancf;
using test::Complex;

namespace {

constexpr double rounding = 1e-13;
constexpr double smoothing = 0.01;  // [1/m]

template <class Measure, int Dim>
double axial(const Vector<Dim>& g) {
  return axial_strain<Measure, Dim, double>(g).value;
}

// r' and r'' of a random line with no stretch beyond a factor of 2.
template <int Dim>
Vector<2 * Dim> random_line(test::Random& random) {
  Vector<2 * Dim> g = test::random_vector<2 * Dim>(random, 0.5);
  g[0] += 1;
  return g;
}

template <class Measure, int Dim>
void check_axial_derivatives() {
  test::Random random(1);
  for (int k = 0; k < 10; ++k) {
    const Vector<Dim> g = random_line<Dim>(random).template head<Dim>();
    const auto gradient = test::complex_jacobian<1, Dim>(g, [](const auto& x) {
      return Vector<1, Complex>(axial_strain<Measure, Dim, Complex>(x).value);
    });
    const auto hessian = test::complex_jacobian<Dim, Dim>(
        g, [](const auto& x) { return axial_strain<Measure, Dim, Complex>(x).gradient; });
    CHECK(test::difference(axial_strain<Measure, Dim, double>(g).gradient, gradient.transpose()) <
          rounding);
    CHECK(test::difference(axial_strain_hessian<Measure, Dim>(g), hessian) < rounding);
  }
}

template <class Measure, int Dim>
void check_bending_derivatives() {
  test::Random random(2);
  for (int k = 0; k < 10; ++k) {
    Vector<2 * Dim> g = random_line<Dim>(random);
    if (k == 0) g.template tail<Dim>().setZero();  // straight
    const auto gradient = test::complex_jacobian<1, 2 * Dim>(g, [](const auto& x) {
      return Vector<1, Complex>(bending_strain<Measure>(x, smoothing).value);
    });
    const auto hessian = test::complex_jacobian<2 * Dim, 2 * Dim>(
        g, [](const auto& x) { return bending_strain<Measure>(x, smoothing).gradient; });
    CHECK(test::difference(bending_strain<Measure>(g, smoothing).gradient, gradient.transpose()) <
          rounding);
    CHECK(test::difference(bending_strain_hessian<Measure>(g, smoothing), hessian) < rounding);
  }
}

}  // namespace

TEST_CASE("axial strains of a line stretched by 1.2 are (1.44 - 1)/2 and 0.2", "[mbs]") {
  const Vector<2> planar(0.72, 0.96);
  const Vector<3> spatial(0.72, 0, 0.96);
  CHECK(axial<Green>(planar) == Approx(0.22).epsilon(rounding));
  CHECK(axial<Green>(spatial) == Approx(0.22).epsilon(rounding));
  CHECK(axial<Engineering>(planar) == Approx(0.2).epsilon(rounding));
  CHECK(axial<Engineering>(spatial) == Approx(0.2).epsilon(rounding));
}

TEST_CASE("on a stretched circle one measure sees the curvature, the other the turn of the tangent",
          "[mbs]") {
  // r(x) = R (sin(w x), 1 - cos(w x)): |r'| = R w, curvature 1/R, turn of the tangent per x: w.
  const double R = 2, w = 0.7, x = 0.9;
  const Vector<2> r1 = R * w * Vector<2>(std::cos(w * x), std::sin(w * x));
  const Vector<2> r2 = R * w * w * Vector<2>(-std::sin(w * x), std::cos(w * x));
  const Vector<4> left(r1[0], r1[1], r2[0], r2[1]), right(r1[0], -r1[1], r2[0], -r2[1]);
  Vector<6> spatial;
  spatial << 0, r1, 0, r2;

  CHECK(bending_strain<Green>(left, 0).value == Approx(1 / R).epsilon(rounding));
  CHECK(bending_strain<Green>(right, 0).value == Approx(-1 / R).epsilon(rounding));
  CHECK(bending_strain<Green>(spatial, 0).value == Approx(1 / R).epsilon(rounding));
  CHECK(bending_strain<Engineering>(left, 0).value == Approx(w).epsilon(rounding));
  CHECK(bending_strain<Engineering>(right, 0).value == Approx(-w).epsilon(rounding));
  CHECK(bending_strain<Engineering>(spatial, 0).value == Approx(w).epsilon(rounding));
}

TEST_CASE("first and second derivatives of the strains are those by a complex step", "[mbs]") {
  check_axial_derivatives<Green, 2>();
  check_axial_derivatives<Green, 3>();
  check_axial_derivatives<Engineering, 2>();
  check_axial_derivatives<Engineering, 3>();
  check_bending_derivatives<Green, 2>();
  check_bending_derivatives<Green, 3>();
  check_bending_derivatives<Engineering, 2>();
  check_bending_derivatives<Engineering, 3>();
}

TEST_CASE("smoothing leaves the gradient of half the squared curvature as it is", "[mbs]") {
  test::Random random(3);
  for (int k = 0; k < 10; ++k) {
    const Vector<6> g = random_line<3>(random);
    const auto sharp = bending_strain<Green>(g, 0), smooth = bending_strain<Green>(g, smoothing);
    CHECK(test::difference(Vector<6>(sharp.value * sharp.gradient),
                           Vector<6>(smooth.value * smooth.gradient)) < rounding);
    CHECK(smooth.value * smooth.value - smoothing * smoothing ==
          Approx(sharp.value * sharp.value).epsilon(1e-11));
  }
}

TEST_CASE("strains do not change when a line is turned", "[mbs]") {
  test::Random random(4);
  for (int k = 0; k < 10; ++k) {
    const Vector<6> g = random_line<3>(random);
    const Vector<6> turned = test::rotated<3>(test::random_rotation<3>(random), g);
    CHECK(axial<Green, 3>(turned.head<3>()) ==
          Approx(axial<Green, 3>(g.head<3>())).margin(rounding));
    CHECK(bending_strain<Green>(turned, 0).value ==
          Approx(bending_strain<Green>(g, 0).value).epsilon(rounding));
    const Vector<4> planar = random_line<2>(random);
    const Vector<4> spun = test::rotated<2>(test::random_rotation<2>(random), planar);
    CHECK(bending_strain<Engineering>(spun, 0).value ==
          Approx(bending_strain<Engineering>(planar, 0).value).margin(rounding));
  }
}
