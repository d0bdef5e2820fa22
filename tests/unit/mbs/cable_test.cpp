// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <sphmbs/mbs/ancf/cable.hpp>

#include "support/catch.hpp"
#include "support/element_laws.hpp"
#include "support/errors.hpp"
#include "support/quadrature.hpp"

using namespace sphmbs::mbs;
using namespace sphmbs::mbs::ancf;

// Not in the header: there every program with a planar cable would compile the spatial one too.
static_assert(Element<Cable<2>> && Element<Cable<3>>);
static_assert(Element<Cable<2, Engineering>> && Element<Cable<3, Engineering>>);

namespace {

constexpr double rounding = 1e-12;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

template <class C>
C sample() {
  return {.length = 0.7,
          .axial_stiffness = 40,
          .bending_stiffness = 0.3,
          .mass_per_length = 1.6,
          .damping = 0.05};
}

// Straight along the first axis.
template <class C>
Vector<C::dofs> straight(const C& cable, double stretch = 1) {
  Vector<C::dofs> q = Vector<C::dofs>::Zero();
  q[C::dim] = q[3 * C::dim] = stretch;
  q[2 * C::dim] = stretch * cable.length;
  return q;
}

// Strongly bent and stretched.
template <class C>
Vector<C::dofs> bent(const C& cable, test::Random& random) {
  return straight(cable) + test::random_vector<C::dofs>(random, 0.2);
}

// On a circle in the plane of the first two axes, from x at the start.
template <class C>
Vector<C::dofs> on_circle(const C& cable, double radius) {
  Vector<C::dofs> q = Vector<C::dofs>::Zero();
  for (int i = 0; i < 2; ++i) {
    const double angle = i * cable.length / radius;
    q.template segment<2>(2 * i * C::dim) << radius * std::sin(angle),
        radius * (1 - std::cos(angle));
    q.template segment<2>((2 * i + 1) * C::dim) << std::cos(angle), std::sin(angle);
  }
  return q;
}

}  // namespace

TEMPLATE_TEST_CASE("a cable that is moved and turned, however far, is not strained", "[mbs]",
                   Cable<2>, Cable<3>, (Cable<2, Engineering>), (Cable<3, Engineering>)) {
  const auto cable = sample<TestType>();
  test::Random random(1);
  for (int k = 0; k < 20; ++k) {
    const auto R = test::random_rotation<TestType::dim>(random);
    const auto shift = test::random_vector<TestType::dim>(random, 10);
    const Vector<TestType::dofs> q =
        test::rotated<TestType::dim>(R, straight(cable)) + TestType::translation() * shift;
    CHECK(std::abs(cable.strain_energy(q)) < rounding * cable.axial_stiffness * cable.length);
    CHECK(cable.elastic_force(q).norm() < rounding * cable.axial_stiffness);
  }
}

TEMPLATE_TEST_CASE("the elastic force of a cable is the gradient of its energy", "[mbs]", Cable<2>,
                   Cable<3>, (Cable<2, Engineering>), (Cable<3, Engineering>)) {
  const auto cable = sample<TestType>();
  test::Random random(2);
  for (int k = 0; k < 10; ++k) {
    const auto q = k == 0 ? straight(cable, 1.1) : bent(cable, random);
    const auto force = cable.elastic_force(q);
    CHECK(test::difference(force, test::energy_gradient(cable, q)) < rounding);
    CHECK(test::difference(force, cable.internal_force(q, Vector<TestType::dofs>::Zero())) == 0);
  }
}

TEMPLATE_TEST_CASE("the tangent of a cable is the derivative of its force, damping included",
                   "[mbs]", Cable<2>, Cable<3>, (Cable<2, Engineering>), (Cable<3, Engineering>)) {
  const auto cable = sample<TestType>();
  test::Random random(3);
  for (int k = 0; k < 10; ++k) {
    const auto q = bent(cable, random);
    const auto v = test::random_vector<TestType::dofs>(random, 3);
    for (const double w : {0.0, 2.5})
      CHECK(test::difference(cable.tangent(q, v, w), test::force_jacobian(cable, q, v, w)) <
            rounding);
    const auto K = cable.tangent(q, Vector<TestType::dofs>::Zero(), 0);
    CHECK(test::difference(K, K.transpose()) < rounding);
  }
}

TEMPLATE_TEST_CASE("damping of a cable takes the power that its force does, and never gives any",
                   "[mbs]", Cable<2>, Cable<3>, (Cable<2, Engineering>), (Cable<3, Engineering>)) {
  const auto cable = sample<TestType>();
  auto elastic = cable;
  elastic.damping = 0;
  test::Random random(4);
  for (int k = 0; k < 10; ++k) {
    const auto q = bent(cable, random);
    const auto v = test::random_vector<TestType::dofs>(random, 3);
    const double power = v.dot(cable.internal_force(q, v) - elastic.internal_force(q, v));
    CHECK(power > 0);
    CHECK(cable.dissipation(q, v) == Approx(power).epsilon(rounding));
    CHECK(elastic.dissipation(q, v) == 0);
  }
}

TEMPLATE_TEST_CASE("damping does not slow a bent cable that moves as a rigid body", "[mbs]",
                   Cable<2>, Cable<3>, (Cable<2, Engineering>), (Cable<3, Engineering>)) {
  constexpr int dim = TestType::dim;
  const auto cable = sample<TestType>();
  test::Random random(5);
  for (int k = 0; k < 10; ++k) {
    const auto q = bent(cable, random);
    Matrix<dim, dim> spin;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j <= i; ++j) {
        spin(i, j) = i == j ? 0.0 : random.between(-5, 5);
        spin(j, i) = -spin(i, j);
      }
    const Vector<TestType::dofs> v = test::rotated<dim>(spin, q) +
                                     TestType::translation() * test::random_vector<dim>(random, 10);
    CHECK(test::difference(cable.internal_force(q, v), cable.elastic_force(q)) < 1e-10);
  }
}

TEMPLATE_TEST_CASE("a turned cable has the same energy and the turned force", "[mbs]", Cable<2>,
                   Cable<3>, (Cable<2, Engineering>), (Cable<3, Engineering>)) {
  constexpr int dim = TestType::dim;
  const auto cable = sample<TestType>();
  test::Random random(6);
  for (int k = 0; k < 10; ++k) {
    const auto q = bent(cable, random);
    const auto v = test::random_vector<TestType::dofs>(random, 3);
    const auto R = test::random_rotation<dim>(random);
    const auto Rq = test::rotated<dim>(R, q), Rv = test::rotated<dim>(R, v);
    CHECK(cable.strain_energy(Rq) == Approx(cable.strain_energy(q)).epsilon(rounding));
    CHECK(test::difference(cable.internal_force(Rq, Rv),
                           test::rotated<dim>(R, cable.internal_force(q, v))) < rounding);
  }
}

TEMPLATE_TEST_CASE("the mass matrix of a cable is the integral of N^T N", "[mbs]", Cable<2>,
                   Cable<3>) {
  constexpr int dim = TestType::dim, dofs = TestType::dofs;
  const auto cable = sample<TestType>();
  const auto M = cable.mass_matrix();
  Matrix<dofs, dofs> integral;
  for (int i = 0; i < dofs; ++i)
    for (int j = 0; j < dofs; ++j)
      integral(i, j) = test::integral(0, cable.length, [&](double x) {
        const auto N = cable.shape(cable.on_axis(x));
        return cable.mass_per_length * N.col(i).dot(N.col(j));
      });
  CHECK(test::difference(M, integral) < rounding);
  CHECK(test::difference(M, M.transpose()) == 0);
  CHECK(Eigen::SelfAdjointEigenSolver<Matrix<dofs, dofs>>(M).eigenvalues().minCoeff() > 0);

  // Mass, centre of mass and moment of inertia of the straight cable about its start.
  const auto T = TestType::translation();
  const auto q = straight(cable);
  const double mass = cable.mass_per_length * cable.length;
  const Vector<dim> moment = T.transpose() * M * q;
  CHECK(test::difference(Matrix<dim, dim>(T.transpose() * M * T),
                         Matrix<dim, dim>(mass * Matrix<dim, dim>::Identity())) < rounding);
  CHECK(moment[0] == Approx(mass * cable.length / 2).epsilon(rounding));
  CHECK(q.dot(M * q) == Approx(mass * cable.length * cable.length / 3).epsilon(rounding));
}

TEMPLATE_TEST_CASE("shape functions of a cable carry translations and are each other's derivatives",
                   "[mbs]", Cable<2>, Cable<3>) {
  constexpr int dim = TestType::dim;
  const auto cable = sample<TestType>();
  test::Random random(7);
  const auto q = bent(cable, random);
  for (const double x : {0.0, 0.2, 0.55, cable.length}) {
    const auto X = cable.on_axis(x);
    CHECK(test::difference(Matrix<dim, dim>(cable.shape(X) * TestType::translation()),
                           Matrix<dim, dim>(Matrix<dim, dim>::Identity())) < rounding);
    // A cubic: r(x) and its derivatives at 0 decide on it.
    const auto zero = cable.start();
    const Vector<dim> r0 = cable.shape(zero) * q, r1 = cable.shape_gradient(zero, 0) * q;
    const Vector<dim> r2 = cable.shape_curvature(zero) * q;
    const Vector<dim> r3 = (cable.shape_curvature(cable.end()) * q - r2) / cable.length;
    CHECK((cable.shape(X) * q - (r0 + x * r1 + x * x / 2 * r2 + x * x * x / 6 * r3)).norm() <
          rounding);
    CHECK((cable.shape_gradient(X, 0) * q - (r1 + x * r2 + x * x / 2 * r3)).norm() < rounding);
    CHECK((cable.shape_curvature(X) * q - (r2 + x * r3)).norm() < 10 * rounding);
  }
  CHECK(cable.shape(cable.end()) * q == q.template segment<dim>(2 * dim));
  CHECK(cable.shape_gradient(cable.end(), 0) * q == q.template segment<dim>(3 * dim));
  CHECK(cable.outline(0.25)[0] == 0.25 * cable.length);
}

TEMPLATE_TEST_CASE("a line load acts as the integral of N^T f", "[mbs]", Cable<2>, Cable<3>) {
  const auto cable = sample<TestType>();
  test::Random random(8);
  const auto f = test::random_vector<TestType::dim>(random, 2);
  const auto Q = cable.line_load(f);
  for (int k = 0; k < TestType::dofs; ++k) {
    const double integral = test::integral(
        0, cable.length, [&](double x) { return cable.shape(cable.on_axis(x)).col(k).dot(f); });
    CHECK(Q[k] == Approx(integral).margin(rounding));
  }
}

TEST_CASE("a stretched cable stores what its strain measure says", "[mbs]") {
  const double stretch = 1.3, e = 0.3, E = (stretch * stretch - 1) / 2;
  const auto energy = [&](const auto& cable, double strain) {
    const auto q = straight(cable, stretch);
    CHECK(cable.axial_strain(q, cable.on_axis(0.2)) == Approx(strain).epsilon(rounding));
    CHECK(cable.strain_energy(q) ==
          Approx(0.5 * cable.axial_stiffness * strain * strain * cable.length).epsilon(rounding));
  };
  energy(sample<Cable<2>>(), E);
  energy(sample<Cable<3>>(), E);
  energy(sample<Cable<2, Engineering>>(), e);
  energy(sample<Cable<3, Engineering>>(), e);
}

TEMPLATE_TEST_CASE("elements on a circle store EI L/(2 R^2), the closer the shorter they are",
                   "[mbs]", Cable<2>, Cable<3>, (Cable<2, Engineering>), (Cable<3, Engineering>)) {
  const double radius = 2, total = 2;  // [m]
  const auto error = [&](int n) {
    auto cable = sample<TestType>();
    cable.length = total / n;
    const double exact = cable.bending_stiffness * total / (2 * radius * radius);
    const auto q = on_circle(cable, radius);
    CHECK(cable.curvature(q, cable.on_axis(cable.length / 2)) ==
          Approx(1 / radius).epsilon(0.1 / n / n));
    return std::abs(n * cable.strain_energy(q) / exact - 1);
  };
  CHECK(error(4) < 1e-4);
  CHECK(std::log2(error(4) / error(8)) > 3.9);
}

TEST_CASE("a planar and a spatial cable in a plane are the same", "[mbs]") {
  const auto planar = sample<Cable<2>>();
  const auto spatial = sample<Cable<3>>();
  test::Random random(9);
  const auto q = bent(planar, random);
  const auto v = test::random_vector<8>(random, 2);
  Vector<12> q3 = Vector<12>::Zero(), v3 = Vector<12>::Zero();
  for (int i = 0; i < 4; ++i) {
    q3.segment<2>(3 * i) = q.segment<2>(2 * i);
    v3.segment<2>(3 * i) = v.segment<2>(2 * i);
  }
  const auto force = planar.internal_force(q, v);
  const auto force3 = spatial.internal_force(q3, v3);
  // Smoothing of the curvature makes up the difference: (1e-6)^2 EA/EI against the curvature
  // squared.
  for (int i = 0; i < 4; ++i)
    CHECK((force3.segment<2>(3 * i) - force.segment<2>(2 * i)).norm() < 1e-8 * force.norm());
  CHECK(spatial.strain_energy(q3) == Approx(planar.strain_energy(q)).epsilon(rounding));
}

TEST_CASE("a cable without bending stiffness bends freely", "[mbs]") {
  auto rope = sample<Cable<3>>();
  rope.bending_stiffness = 0;
  rope.check();
  auto fine = rope;
  fine.length = 0.01;
  CHECK(fine.strain_energy(on_circle(fine, 1.0)) < 1e-12 * fine.axial_stiffness * fine.length);
  test::Random random(10);
  const auto q = bent(rope, random);
  const auto v = test::random_vector<12>(random, 1);
  CHECK(test::difference(rope.internal_force(q, Vector<12>::Zero()),
                         test::energy_gradient(rope, q)) < rounding);
  CHECK(rope.tangent(q, v, 1).allFinite());
}

TEST_CASE("a cable of circular section has the stiffness and mass of a rod", "[mbs]") {
  const auto cable =
      Cable<2>::of(0.1675, {.radius = 0.0015, .density = 5208.39, .youngs_modulus = 2.0e11}, 1e-4);
  CHECK(cable.length == 0.1675);
  CHECK(cable.axial_stiffness == Approx(1.41371669e6).epsilon(1e-8));
  CHECK(cable.bending_stiffness == Approx(0.79521564).epsilon(1e-8));
  CHECK(cable.mass_per_length == Approx(0.036815939).epsilon(2e-8));
  CHECK(cable.damping == 1e-4);
}

namespace {

// Tip displacement of a cantilever under a dead tip force of 3 EI/L^2 downwards. The tangent of the
// clamped end keeps its direction, its length is free.
template <class Measure>
Vector<2> cantilever(int n) {
  constexpr double length = 2, EI = 1.725e6;
  const Cable<2, Measure> cable{.length = length / n,
                                .axial_stiffness = 2.07e9,
                                .bending_stiffness = EI,
                                .mass_per_length = 1};
  const int dofs = 4 * (n + 1), steps = 10;
  VectorXd q = VectorXd::Zero(dofs);
  for (int i = 0; i <= n; ++i) {
    q[4 * i] = i * cable.length;
    q[4 * i + 2] = 1;
  }
  for (int step = 1; step <= steps; ++step)
    for (int newton = 0; newton < 12; ++newton) {
      VectorXd residual = VectorXd::Zero(dofs);
      MatrixXd K = MatrixXd::Zero(dofs, dofs);
      for (int e = 0; e < n; ++e) {
        const Vector<8> own = q.segment<8>(4 * e);
        residual.segment<8>(4 * e) += cable.elastic_force(own);
        K.block<8, 8>(4 * e, 4 * e) += cable.tangent(own, Vector<8>::Zero(), 0);
      }
      residual[dofs - 3] += 3 * EI / (length * length) * step / steps;
      for (const int fixed : {0, 1, 3}) {
        residual[fixed] = 0;
        K.row(fixed).setZero();
        K(fixed, fixed) = 1;
      }
      q -= K.partialPivLu().solve(residual);
    }
  return {q[dofs - 4] - length, q[dofs - 3]};
}

struct Known {
  int elements;
  double x, y;  // [m]
};

template <class Measure>
void check_cantilever(const std::array<Known, 4>& table) {
  constexpr double digits = 1.5e-9;
  for (const Known& known : table) {
    INFO("elements: " << known.elements);
    const Vector<2> tip = cantilever<Measure>(known.elements);
    CHECK(std::abs(tip[0] - known.x) < digits);
    CHECK(std::abs(tip[1] - known.y) < digits);
  }
}

}  // namespace

TEST_CASE("the cantilever of Gerstmayr and Irschik bends as an independent code says, Green",
          "[mbs]") {
  check_cantilever<Green>({{{1, -0.362584156, -0.995035058},
                            {2, -0.489502210, -1.176419716},
                            {4, -0.507822576, -1.206689544},
                            {8, -0.508894944, -1.208355963}}});
}

TEST_CASE("the cantilever of Gerstmayr and Irschik bends as Exudyn says, Engineering", "[mbs]") {
  check_cantilever<Engineering>({{{1, -0.362244730, -0.994144759},
                                  {2, -0.488926309, -1.175222865},
                                  {4, -0.507428715, -1.205533703},
                                  {8, -0.508509237, -1.207197756}}});
}

TEST_CASE("a cable refuses parameters out of range and names them", "[mbs][fault]") {
  const auto refusal = [](auto change) {
    auto cable = sample<Cable<2>>();
    change(cable);
    return test::refusal([&] { cable.check(); });
  };
  using Catch::Matchers::Contains;
  CHECK(refusal([](auto&) {}).empty());
  for (const double bad : {0.0, -1.0, undefined, infinite}) {
    CHECK_THAT(refusal([&](auto& c) { c.length = bad; }), Contains("length = "));
    CHECK_THAT(refusal([&](auto& c) { c.axial_stiffness = bad; }), Contains("axial_stiffness = "));
    CHECK_THAT(refusal([&](auto& c) { c.mass_per_length = bad; }), Contains("mass_per_length = "));
  }
  for (const double bad : {-1.0, undefined, infinite}) {
    CHECK_THAT(refusal([&](auto& c) { c.bending_stiffness = bad; }),
               Contains("bending_stiffness = "));
    CHECK_THAT(refusal([&](auto& c) { c.damping = bad; }), Contains("damping = "));
  }
  CHECK(refusal([](auto& c) { c.length = 0; }) == "length = 0: must be positive [m]");
}
