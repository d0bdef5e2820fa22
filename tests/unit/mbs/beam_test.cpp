// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <sphmbs/mbs/ancf/beam.hpp>

#include "support/catch.hpp"
#include "support/element_laws.hpp"
#include "support/errors.hpp"
#include "support/quadrature.hpp"

using namespace sphmbs::mbs;
using namespace sphmbs::mbs::ancf;

namespace {

constexpr double rounding = 1e-12;
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
const Vector<24> still = Vector<24>::Zero();

Beam sample() {
  return {.length = 0.7,
          .width = 0.2,
          .height = 0.3,
          .density = 900,
          .youngs_modulus = 2e3,
          .poisson_ratio = 0.3,
          .damping = 0.05};
}

double axial_stiffness(const Beam& beam) { return beam.youngs_modulus * beam.area(); }

// n elements in a row along x, free of stress.
VectorXd straight(const Beam& beam, int n = 1) {
  VectorXd q = VectorXd::Zero(12 * (n + 1));
  for (int i = 0; i <= n; ++i) {
    q[12 * i] = i * beam.length;
    q[12 * i + 3] = q[12 * i + 7] = q[12 * i + 11] = 1;
  }
  return q;
}

Vector<24> deformed(const Beam& beam, test::Random& random) {
  return straight(beam) + test::random_vector<24>(random, 0.2);
}

VectorXd chain_force(const Beam& beam, const VectorXd& q) {
  VectorXd force = VectorXd::Zero(q.size());
  for (Eigen::Index i = 0; i + 24 <= q.size(); i += 12)
    force.segment<24>(i) += beam.elastic_force(q.segment<24>(i));
  return force;
}

MatrixXd chain_stiffness(const Beam& beam, const VectorXd& q) {
  MatrixXd K = MatrixXd::Zero(q.size(), q.size());
  for (Eigen::Index i = 0; i + 24 <= q.size(); i += 12)
    K.block<24, 24>(i, i) += beam.tangent(q.segment<24>(i), still, 0);
  return K;
}

MatrixXd chain_mass(const Beam& beam, int n) {
  MatrixXd M = MatrixXd::Zero(12 * (n + 1), 12 * (n + 1));
  for (int i = 0; i < n; ++i) M.block<24, 24>(12 * i, 12 * i) += beam.mass_matrix();
  return M;
}

// Equilibrium under the dead force Q, the coordinates `fixed` held.
VectorXd equilibrium(const Beam& beam, VectorXd q, const VectorXd& Q, std::vector<int> fixed,
                     int steps) {
  for (int step = 1; step <= steps; ++step)
    for (int newton = 0; newton < 20; ++newton) {
      VectorXd residual = chain_force(beam, q) - Q * step / steps;
      MatrixXd K = chain_stiffness(beam, q);
      for (const int k : fixed) {
        residual[k] = 0;
        K.row(k).setZero();
        K(k, k) = 1;
      }
      const VectorXd change = K.partialPivLu().solve(residual);
      q -= change;
      if (change.norm() < 1e-12 * q.norm()) break;
    }
  return q;
}

// Position and section of the first node held, its r_x free.
const std::vector<int> clamp{0, 1, 2, 6, 7, 8, 9, 10, 11};

// Deflection of a cantilever under a small tip force along y or z, as a share of Timoshenko's.
double small_deflection(Beam beam, double total, int n, int axis, const std::vector<int>& fixed) {
  beam.length = total / n;
  const double moment = axis == 1 ? beam.second_moment_z() : beam.second_moment_y();
  const double EI = beam.youngs_modulus * moment;
  const double shear = beam.shear_correction * beam.shear_modulus() * beam.area();
  const double force = 1e-7 * EI / (total * total);
  const int tip = 12 * n + axis;
  VectorXd Q = VectorXd::Zero(12 * (n + 1));
  Q[tip] = force;
  const VectorXd q = equilibrium(beam, straight(beam, n), Q, fixed, 1);
  return q[tip] / (force * (total * total * total / (3 * EI) + total / shear));
}

}  // namespace

TEST_CASE("a beam that is moved and turned, however far, is not strained", "[mbs]") {
  const Beam beam = sample();
  test::Random random(1);
  for (int k = 0; k < 20; ++k) {
    const Vector<24> q = test::rotated<3, 24>(test::random_rotation<3>(random), straight(beam)) +
                         Beam::translation() * test::random_vector<3>(random, 10);
    CHECK(std::abs(beam.strain_energy(q)) < rounding * axial_stiffness(beam) * beam.length);
    CHECK(beam.elastic_force(q).norm() < rounding * axial_stiffness(beam));
  }
}

TEST_CASE("the elastic force of a beam is the gradient of its energy", "[mbs]") {
  const Beam beam = sample();
  test::Random random(2);
  for (int k = 0; k < 10; ++k) {
    const Vector<24> q = deformed(beam, random);
    CHECK(test::difference(beam.elastic_force(q), test::energy_gradient(beam, q)) < rounding);
    CHECK(beam.elastic_force(q) == beam.internal_force(q, still));
  }
}

TEST_CASE("the tangent of a beam is the derivative of its force, damping included", "[mbs]") {
  const Beam beam = sample();
  Beam elastic = beam;
  elastic.damping = 0;
  test::Random random(3);
  for (int k = 0; k < 10; ++k) {
    const Vector<24> q = deformed(beam, random), v = test::random_vector<24>(random, 3);
    for (const double w : {0.0, 2.5})
      CHECK(test::difference(beam.tangent(q, v, w), test::force_jacobian(beam, q, v, w)) <
            rounding);
    const auto K = elastic.tangent(q, v, 2.5);
    CHECK(test::difference(K, test::force_jacobian(elastic, q, v, 2.5)) < rounding);
    CHECK(test::difference(K, K.transpose()) < rounding);
  }
}

TEST_CASE("damping of a beam takes the power that its force does, and never gives any", "[mbs]") {
  const Beam beam = sample();
  Beam elastic = beam;
  elastic.damping = 0;
  test::Random random(4);
  for (int k = 0; k < 10; ++k) {
    const Vector<24> q = deformed(beam, random), v = test::random_vector<24>(random, 3);
    const double power = v.dot(beam.internal_force(q, v) - elastic.internal_force(q, v));
    CHECK(power > 0);
    CHECK(beam.dissipation(q, v) == Approx(power).epsilon(rounding));
    CHECK(elastic.dissipation(q, v) == 0);
    const Vector<3> omega = test::random_vector<3>(random, 4);
    Matrix<3, 3> spin;
    spin << 0, -omega[2], omega[1], omega[2], 0, -omega[0], -omega[1], omega[0], 0;
    const Vector<24> rigid = test::rotated<3, 24>(spin, q) + Beam::translation() * omega;
    CHECK(test::difference(beam.internal_force(q, rigid), beam.elastic_force(q)) < rounding);
  }
}

TEST_CASE("a turned beam has the same energy and the turned force", "[mbs]") {
  const Beam beam = sample();
  test::Random random(5);
  for (int k = 0; k < 10; ++k) {
    const Vector<24> q = deformed(beam, random), v = test::random_vector<24>(random, 3);
    const auto R = test::random_rotation<3>(random);
    const Vector<24> Rq = test::rotated<3>(R, q), Rv = test::rotated<3>(R, v);
    CHECK(beam.strain_energy(Rq) == Approx(beam.strain_energy(q)).epsilon(rounding));
    CHECK(test::difference(beam.internal_force(Rq, Rv),
                           test::rotated<3>(R, beam.internal_force(q, v))) < rounding);
  }
}

TEST_CASE("the mass matrix of a beam is the integral of N^T N over its volume", "[mbs]") {
  const Beam beam = sample();
  const auto M = beam.mass_matrix();
  // N is of first degree in y and z: 2 x 2 Gauss points are exact for N^T N.
  Matrix<24, 24> integral = Matrix<24, 24>::Zero();
  const double y = beam.width / std::sqrt(12.0), z = beam.height / std::sqrt(12.0);
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j)
      for (const double sy : {-1.0, 1.0})
        for (const double sz : {-1.0, 1.0})
          integral(i, j) += test::integral(0, beam.length, [&](double x) {
            const auto N = beam.shape({x, sy * y, sz * z});
            return beam.density * beam.area() / 4 * N.col(i).dot(N.col(j));
          });
  CHECK(test::difference(M, integral) < rounding);
  CHECK(test::difference(M, M.transpose()) == 0);
  CHECK(Eigen::SelfAdjointEigenSolver<Matrix<24, 24>>(M).eigenvalues().minCoeff() > 0);

  // Mass, centre of mass, and polar moment of inertia about the start, of a straight cuboid.
  const auto T = Beam::translation();
  const Vector<24> q = straight(beam);
  const double mass = beam.density * beam.area() * beam.length;
  CHECK(test::difference(Matrix<3, 3>(T.transpose() * M * T),
                         Matrix<3, 3>(mass * Matrix<3, 3>::Identity())) < rounding);
  CHECK((T.transpose() * M * q - Vector<3>(mass * beam.length / 2, 0, 0)).norm() < rounding * mass);
  CHECK(q.dot(M * q) ==
        Approx(mass * (beam.length * beam.length / 3 + beam.width * beam.width / 12 +
                       beam.height * beam.height / 12))
            .epsilon(rounding));
}

TEST_CASE("shape functions of a beam carry translations and its gradients", "[mbs]") {
  const Beam beam = sample();
  test::Random random(6);
  const Vector<24> q = deformed(beam, random);
  const Vector<3> f = test::random_vector<3>(random, 1);
  for (const double x : {0.0, 0.25, 0.7}) {
    const Vector<3> X(x, 0.05, -0.11);
    CHECK(test::difference(Matrix<3, 3>(beam.shape(X) * Beam::translation()),
                           Matrix<3, 3>(Matrix<3, 3>::Identity())) < rounding);
    // r is linear in y and z, cubic in x: central differences over h are off by h^2/6 r_xxx.
    for (int k = 0; k < 3; ++k) {
      const double h = 1e-3;
      const Vector<3> step = h * Vector<3>::Unit(k);
      const Vector<3> slope = (beam.shape(X + step) * q - beam.shape(X - step) * q) / (2 * h);
      CHECK((beam.shape_gradient(X, k) * q - slope).norm() < 1e-5);
      const Vector<3> bend =
          (beam.shape_gradient(X + step, 0) * q - beam.shape_gradient(X - step, 0) * q) / (2 * h);
      if (k == 0) CHECK((beam.shape_curvature(X) * q - bend).norm() < 1e-10);
    }
  }
  CHECK(beam.shape(beam.end()) * q == q.segment<3>(12));
  for (int k = 0; k < 3; ++k)
    CHECK(beam.shape_gradient(beam.end(), k) * q == q.segment<3>(15 + 3 * k));
  for (int i = 0; i < 24; ++i) {
    const double integral = test::integral(
        0, beam.length, [&](double x) { return beam.shape(beam.on_axis(x)).col(i).dot(f); });
    CHECK(beam.line_load(f)[i] == Approx(integral).margin(rounding));
  }
}

TEST_CASE("a beam pulled along its axis gets thinner and stores E A e^2 L/2", "[mbs]") {
  const Beam beam = sample();
  const double stretch = 1.1, e = (stretch * stretch - 1) / 2;
  const double thin = std::sqrt(1 - 2 * beam.poisson_ratio * e);
  Vector<24> q = straight(beam);
  q[3] = q[15] = stretch;
  q[12] *= stretch;
  q[7] = q[11] = q[19] = q[23] = thin;
  CHECK(beam.strain_energy(q) ==
        Approx(0.5 * axial_stiffness(beam) * e * e * beam.length).epsilon(rounding));
  // Nothing but the pull at the ends is left.
  const Vector<24> force = beam.elastic_force(q);
  CHECK(force[12] == Approx(axial_stiffness(beam) * e * stretch).epsilon(rounding));
  CHECK(Vector<12>(force.tail<12>() - force[12] * Vector<12>::Unit(0)).norm() <
        rounding * axial_stiffness(beam));
}

TEST_CASE("a twisted beam stores G J (twist)^2 L/2, the closer the shorter it is", "[mbs]") {
  const auto error = [](double length) {
    Beam beam = sample();
    beam.length = length;
    Vector<24> q = straight(beam);
    const double rate = 0.5;  // [rad/m]
    const double c = std::cos(rate * length), s = std::sin(rate * length);
    q.segment<3>(18) << 0, c, s;
    q.segment<3>(21) << 0, -s, c;
    const double exact = 0.5 * beam.shear_modulus() * torsion_constant(beam.width, beam.height) *
                         rate * rate * length;
    return std::abs(beam.strain_energy(q) / exact - 1);
  };
  CHECK(error(0.1) < 1e-3);
  CHECK(std::log2(error(0.2) / error(0.1)) == Approx(2).epsilon(0.01));
}

TEST_CASE("torsion constants of rectangles are those of the tables", "[mbs]") {
  // Timoshenko and Goodier: J = k a b^3.
  CHECK(torsion_constant(1, 1) == Approx(0.1406).margin(5e-5));
  CHECK(torsion_constant(2, 1) == Approx(0.229 * 2).margin(1e-3));
  CHECK(torsion_constant(1, 10) == Approx(0.312 * 10).margin(5e-3));
  CHECK(torsion_constant(3, 0.5) == torsion_constant(0.5, 3));
}

TEST_CASE("a cantilever of beams bends as Timoshenko says, thick or thin, with any number of them",
          "[mbs]") {
  for (const double thickness : {0.5, 0.1, 0.01, 0.001})
    for (const int n : {1, 2, 3, 8})
      for (const int axis : {1, 2}) {
        INFO("thickness " << thickness << ", elements " << n << ", axis " << axis);
        Beam beam = sample();
        beam.width = thickness;
        beam.height = 0.7 * thickness;
        CHECK(std::abs(small_deflection(beam, 1, n, axis, clamp) - 1) < 1e-8);
      }
}

TEST_CASE("a clamp that also holds r_x is too stiff, and less so with more elements", "[mbs]") {
  std::vector<int> all;
  for (int k = 0; k < 12; ++k) all.push_back(k);
  Beam thin = sample();
  thin.width = thin.height = 0.001;
  const auto error = [&](int n) { return 1 - small_deflection(thin, 1, n, 1, all); };
  CHECK(error(2) == Approx(3.7e-3).epsilon(0.01));
  CHECK(std::log2(error(2) / error(4)) == Approx(3).epsilon(0.01));
  Beam thick = sample();
  thick.width = thick.height = 0.5;
  CHECK(1 - small_deflection(thick, 1, 16, 1, all) < 1.3e-3);
}

TEST_CASE("a thin cantilever of beams converges to the elastica with order 2", "[mbs]") {
  // Tip force 3 EI/L^2 (Bisshopp and Drucker 1945).
  const auto error = [](int n) {
    Beam beam{
        .length = 1.0 / n, .width = 0.001, .height = 0.001, .density = 1000, .youngs_modulus = 1e9};
    VectorXd Q = VectorXd::Zero(12 * (n + 1));
    Q[12 * n + 1] = 3 * beam.youngs_modulus * beam.second_moment_z();
    const VectorXd q = equilibrium(beam, straight(beam, n), Q, clamp, 20);
    return std::hypot(1 - q[12 * n] - 0.254420, q[12 * n + 1] - 0.603253);
  };
  const double coarse = error(8), fine = error(16);
  CHECK(coarse < 3e-3);
  CHECK(std::log2(coarse / fine) == Approx(2).epsilon(0.05));
}

TEST_CASE("a free beam has six modes without stiffness, and bends and stretches at known rates",
          "[mbs]") {
  const int n = 8;
  Beam beam{
      .length = 1.0 / n, .width = 0.01, .height = 0.01, .density = 1000, .youngs_modulus = 1e9};
  const MatrixXd K = chain_stiffness(beam, straight(beam, n));
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(K, chain_mass(beam, n));
  const double scale =
      std::sqrt(beam.youngs_modulus * beam.second_moment_y() / (beam.density * beam.area()));
  const auto frequency = [&](int k) {
    return std::sqrt(std::abs(modes.eigenvalues()[k])) / scale;  // (beta L)^2
  };
  for (int k = 0; k < 6; ++k) CHECK(frequency(k) < 0.02);
  CHECK(frequency(6) == Approx(4.73004074 * 4.73004074).epsilon(2e-3));
  CHECK(frequency(7) == Approx(4.73004074 * 4.73004074).epsilon(2e-3));
  CHECK(frequency(8) == Approx(7.85320462 * 7.85320462).epsilon(6e-3));
}

TEST_CASE("a beam refuses parameters out of range and names them", "[mbs][fault]") {
  const auto refusal = [](auto change) {
    Beam beam = sample();
    change(beam);
    return test::refusal([&] { beam.check(); });
  };
  using Catch::Matchers::Contains;
  CHECK(refusal([](Beam&) {}).empty());
  for (const double bad : {0.0, -1.0, undefined, infinite}) {
    CHECK_THAT(refusal([&](Beam& b) { b.length = bad; }), Contains("length = "));
    CHECK_THAT(refusal([&](Beam& b) { b.width = bad; }), Contains("width = "));
    CHECK_THAT(refusal([&](Beam& b) { b.height = bad; }), Contains("height = "));
    CHECK_THAT(refusal([&](Beam& b) { b.density = bad; }), Contains("density = "));
    CHECK_THAT(refusal([&](Beam& b) { b.youngs_modulus = bad; }), Contains("youngs_modulus = "));
    CHECK_THAT(refusal([&](Beam& b) { b.shear_correction = bad; }),
               Contains("shear_correction = "));
  }
  for (const double bad : {-1.0, 0.5, undefined})
    CHECK_THAT(refusal([&](Beam& b) { b.poisson_ratio = bad; }), Contains("poisson_ratio = "));
  for (const double bad : {-1.0, undefined, infinite})
    CHECK_THAT(refusal([&](Beam& b) { b.damping = bad; }), Contains("damping = "));
}
