// SPDX-License-Identifier: MIT
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <sphmbs/mbs/ancf/plate.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/quadrature.hpp"
#include "support/random.hpp"

using namespace sphmbs::mbs;
using namespace sphmbs::mbs::ancf;

namespace {

constexpr double rounding = 1e-12;    // share of what is computed
constexpr double derivative = 1e-11;  // share of the largest entry; complex steps are exact

using Complex = std::complex<double>;
constexpr double step = 1e-30;

template <class P>
P some_plate(double damping = 0) {
  return {.length = 0.3,
          .width = 0.2,
          .thickness = 0.01,
          .density = 1200,
          .youngs_modulus = 2e6,
          .poisson_ratio = 0.3,
          .damping = damping};
}

/// The coordinates of a surface r(x, y), given by its derivative (x, y, k, l) -> d^k+l r/dx^k dy^l.
template <class P, class Surface>
Vector<P::dofs> coordinates(const P& plate, Surface&& surface) {
  const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const int order[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  Vector<P::dofs> q;
  for (int k = 0; k < P::dofs / 3; ++k) {
    const auto [s, t] = corner[k / (P::node_dofs / 3)];
    const auto [i, j] = order[k % (P::node_dofs / 3)];
    q.template segment<3>(3 * k) = surface(s * plate.length, t * plate.width, i, j);
  }
  return q;
}

double monomial(double x, int power, int order) {
  if (order == 0) return std::pow(x, power);
  return power == 0 ? 0.0 : power * monomial(x, power - 1, order - 1);
}

/// c x^i y^j, with its derivatives.
auto polynomial(const Vector<3>& c, int i, int j) {
  return [=](double x, double y, int k, int l) -> Vector<3> {
    return c * monomial(x, i, k) * monomial(y, j, l);
  };
}

template <class P>
Vector<P::dofs> polynomial_state(const P& plate, const Vector<3>& c, int i, int j) {
  return coordinates(plate, polynomial(c, i, j));
}

/// r = A (x, y) + b.
template <class P>
Vector<P::dofs> affine_state(const P& plate, const Matrix<3, 2>& A, const Vector<3>& b) {
  return polynomial_state(plate, A.col(0), 1, 0) + polynomial_state(plate, A.col(1), 0, 1) +
         polynomial_state(plate, b, 0, 0);
}

template <class P>
Vector<P::dofs> flat_state(const P& plate) {
  return affine_state(plate, Matrix<3, 2>::Identity(), Vector<3>::Zero());
}

Vector<3> some_vector(test::Random& random, double size) {
  const auto x = random.vector<3>(size);
  return {x[0], x[1], x[2]};
}

Matrix<3, 3> some_rotation(test::Random& random) {
  const Vector<3> axis = some_vector(random, 1.0).normalized();
  return Eigen::AngleAxisd(random.between(1.0, 3.0), axis).toRotationMatrix();
}

template <class P>
Vector<P::dofs> some_rates(test::Random& random, double size) {
  Vector<P::dofs> v;
  for (int k = 0; k < P::dofs; ++k) v[k] = random.between(-size, size);
  return v;
}

/// Every 3-vector of the coordinates turned.
template <int dofs>
Vector<dofs> turned(const Matrix<3, 3>& R, const Vector<dofs>& q) {
  Vector<dofs> turned;
  for (int k = 0; k < dofs; k += 3) turned.template segment<3>(k) = R * q.template segment<3>(k);
  return turned;
}

/// Strained by tenths, bent, and turned in space.
template <class P>
Vector<P::dofs> some_state(const P& plate, test::Random& random) {
  const Vector<P::dofs> q = flat_state(plate) + some_rates<P>(random, 0.05);
  return turned<P::dofs>(some_rotation(random), q);
}

/// Derivative of f in its argument at x, by complex steps.
template <int n, class F>
MatrixXd complex_step(const Vector<n>& x, F&& f) {
  MatrixXd J(f(x.template cast<Complex>().eval()).size(), n);
  for (int k = 0; k < n; ++k) {
    Vector<n, Complex> z = x.template cast<Complex>();
    z[k] += Complex(0, step);
    J.col(k) = f(z).imag() / step;
  }
  return J;
}

double difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// Integral over the plate.
template <class P, class F>
double over_plate(const P& plate, F&& f) {
  return test::integral(0, plate.length, [&](double x) {
    return test::integral(0, plate.width, [&](double y) { return f(x, y); });
  });
}

template <class P>
double membrane_energy(const P& plate) {
  return plate.youngs_modulus * plate.thickness * plate.length * plate.width;
}

}  // namespace

TEMPLATE_TEST_CASE("A plate's functions reproduce their polynomials and slopes", "[mbs]", Plate36,
                   Plate48) {
  const auto plate = some_plate<TestType>();
  const bool bicubic = std::is_same_v<TestType, Plate48>;
  const Vector<3> c{1.0, -2.0, 0.5};
  test::Random random(1);
  int reproduced = 0;
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; j <= 3; ++j) {
      // Adini, Clough and Melosh: all up to the third degree, x^3 y and x y^3.
      if (!bicubic && i + j > 3 && !(i == 3 && j == 1) && !(i == 1 && j == 3)) continue;
      ++reproduced;
      INFO("x^" << i << " y^" << j);
      const auto surface = polynomial(c, i, j);
      const auto q = coordinates(plate, surface);
      for (int n = 0; n < 5; ++n) {
        const double x = plate.length * random.unit(), y = plate.width * random.unit();
        CHECK((plate.shape({x, y}) * q - surface(x, y, 0, 0)).norm() < rounding);
        CHECK((plate.shape_gradient({x, y}, 0) * q - surface(x, y, 1, 0)).norm() < rounding);
        CHECK((plate.shape_gradient({x, y}, 1) * q - surface(x, y, 0, 1)).norm() < rounding);
      }
    }
  CHECK(reproduced == TestType::dofs / 3);
}

TEMPLATE_TEST_CASE("A plate interpolates its nodes and moves as a whole with all of them", "[mbs]",
                   Plate36, Plate48) {
  const auto plate = some_plate<TestType>();
  test::Random random(2);
  const auto q = some_rates<TestType>(random, 1.0);
  const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) {
    const auto node = q.template segment<TestType::node_dofs>(i * TestType::node_dofs);
    const auto X = plate.outline(corner[i][0], corner[i][1]);
    CHECK((plate.shape(X) * q - node.template head<3>()).norm() < rounding);
    CHECK((plate.shape_gradient(X, 0) * q - node.template segment<3>(3)).norm() < rounding);
    CHECK((plate.shape_gradient(X, 1) * q - node.template segment<3>(6)).norm() < rounding);
  }
  for (int n = 0; n < 10; ++n) {
    const auto X = plate.outline(random.unit(), random.unit());
    const Matrix<3, 3> moved = plate.shape(X) * TestType::translation();
    CHECK((moved - Matrix<3, 3>::Identity()).norm() < rounding);
  }
}

TEMPLATE_TEST_CASE("A rigid motion strains no plate", "[mbs]", Plate36, Plate48) {
  const auto plate = some_plate<TestType>(0.1);
  test::Random random(3);
  for (int n = 0; n < 20; ++n) {
    const Matrix<3, 3> R = some_rotation(random);
    const Vector<3> b = some_vector(random, 10), omega = some_vector(random, 5);
    const auto q = affine_state<TestType>(plate, R.leftCols<2>(), b);
    Matrix<3, 2> rate;
    rate << omega.cross(R.col(0)), omega.cross(R.col(1));
    const auto v = affine_state<TestType>(plate, rate, some_vector(random, 10));
    CHECK(plate.strain_energy(q) >= 0);
    CHECK(plate.strain_energy(q) < rounding * membrane_energy(plate));
    CHECK(plate.internal_force(q, v).norm() < rounding * membrane_energy(plate) / plate.width);
    CHECK(plate.dissipation(q, v) < rounding * plate.damping * membrane_energy(plate));
  }
}

TEMPLATE_TEST_CASE("A plate's force is the gradient of its energy", "[mbs]", Plate36, Plate48) {
  const auto plate = some_plate<TestType>();
  test::Random random(4);
  for (int n = 0; n < 3; ++n) {
    const auto q = some_state(plate, random);
    const auto gradient = complex_step<TestType::dofs>(q, [&](const auto& z) {
      return Vector<1, Complex>(plate.template strain_energy<Complex>(z));
    });
    CHECK(plate.strain_energy(q) > 0);
    CHECK(difference(plate.elastic_force(q).transpose(), gradient) < derivative);
    CHECK(difference(plate.internal_force(q, q).transpose(), gradient) < derivative);
  }
}

TEMPLATE_TEST_CASE("A plate's tangent is the derivative of its force and symmetric", "[mbs]",
                   Plate36, Plate48) {
  const auto plate = some_plate<TestType>();
  test::Random random(5);
  for (int n = 0; n < 3; ++n) {
    const auto q = some_state(plate, random);
    const auto K = plate.tangent(q, some_rates<TestType>(random, 1.0), 0.7);
    const auto exact = complex_step<TestType::dofs>(
        q, [&](const auto& z) { return plate.template elastic_force<Complex>(z); });
    CHECK(difference(K, exact) < derivative);
    CHECK((K - K.transpose()).isZero(0));
  }
}

TEMPLATE_TEST_CASE("A damped plate's tangent is the derivative in place and rate", "[mbs]", Plate36,
                   Plate48) {
  const auto plate = some_plate<TestType>(0.3);
  test::Random random(6);
  for (int n = 0; n < 3; ++n) {
    const auto q = some_state(plate, random);
    const auto v = some_rates<TestType>(random, 1.0);
    const Vector<TestType::dofs, Complex> q_complex = q.template cast<Complex>();
    const Vector<TestType::dofs, Complex> v_complex = v.template cast<Complex>();
    const auto in_place = complex_step<TestType::dofs>(
        q, [&](const auto& z) { return plate.template internal_force<Complex>(z, v_complex); });
    const auto in_rate = complex_step<TestType::dofs>(
        v, [&](const auto& z) { return plate.template internal_force<Complex>(q_complex, z); });
    CHECK(difference(plate.tangent(q, v, 0), in_place) < derivative);
    CHECK(difference(plate.tangent(q, v, 2.5), in_place + 2.5 * in_rate) < derivative);
    CHECK(difference(plate.tangent(q, v, 1) - plate.tangent(q, v, 0), in_rate) < derivative);
  }
}

TEMPLATE_TEST_CASE("Damping of a plate takes the power that its force does", "[mbs]", Plate36,
                   Plate48) {
  const auto plate = some_plate<TestType>(0.3);
  const auto undamped = some_plate<TestType>();
  test::Random random(7);
  for (int n = 0; n < 5; ++n) {
    const auto q = some_state(plate, random);
    const auto v = some_rates<TestType>(random, 1.0);
    const double power = v.dot(plate.internal_force(q, v) - plate.elastic_force(q));
    CHECK(plate.dissipation(q, v) > 0);
    CHECK(plate.dissipation(q, v) == Approx(power).epsilon(1e-10));
    CHECK(undamped.dissipation(q, v) == 0);
  }
}

TEMPLATE_TEST_CASE("Turning a plate turns its forces and keeps its energy", "[mbs]", Plate36,
                   Plate48) {
  const auto plate = some_plate<TestType>(0.2);
  test::Random random(8);
  for (int n = 0; n < 5; ++n) {
    const auto q = some_state(plate, random);
    const auto v = some_rates<TestType>(random, 1.0);
    const Matrix<3, 3> R = some_rotation(random);
    const Vector<TestType::dofs> shifted =
        turned<TestType::dofs>(R, q) + TestType::translation() * some_vector(random, 1.0);
    const auto turned_v = turned<TestType::dofs>(R, v);
    CHECK(plate.strain_energy(shifted) == Approx(plate.strain_energy(q)).epsilon(rounding));
    CHECK(difference(plate.internal_force(shifted, turned_v),
                     turned<TestType::dofs>(R, plate.internal_force(q, v))) < derivative);
    CHECK(difference(plate.pressure_force(shifted),
                     turned<TestType::dofs>(R, plate.pressure_force(q))) < derivative);
  }
}

TEMPLATE_TEST_CASE("A plate's mass matrix is positive definite, with mass and moments", "[mbs]",
                   Plate36, Plate48) {
  const auto plate = some_plate<TestType>();
  const auto M = plate.mass_matrix();
  const double a = plate.length, b = plate.width;
  const double mass = plate.density * plate.thickness * a * b;
  CHECK((M - M.transpose()).isZero(0));
  CHECK(Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues().minCoeff() > 0);
  const auto T = TestType::translation();
  const Matrix<3, 3> total = T.transpose() * M * T;
  CHECK((total - mass * Matrix<3, 3>::Identity()).norm() < rounding * mass);

  const auto field = [&](int i, int j) {
    return polynomial_state(plate, Vector<3>::UnitZ(), i, j);
  };
  const auto product = [&](const auto& p, const auto& q) { return p.dot(M * q) / mass; };
  CHECK(product(field(0, 0), field(1, 0)) == Approx(a / 2).epsilon(rounding));
  CHECK(product(field(0, 0), field(0, 1)) == Approx(b / 2).epsilon(rounding));
  CHECK(product(field(1, 0), field(1, 0)) == Approx(a * a / 3).epsilon(rounding));
  CHECK(product(field(0, 1), field(0, 1)) == Approx(b * b / 3).epsilon(rounding));
  CHECK(product(field(1, 0), field(0, 1)) == Approx(a * b / 4).epsilon(rounding));
  CHECK(product(field(3, 1), field(1, 3)) == Approx(std::pow(a * b, 4) / 25).epsilon(rounding));
}

TEMPLATE_TEST_CASE("A plate's loads are integrals over its surface", "[mbs]", Plate36, Plate48) {
  const auto plate = some_plate<TestType>();
  test::Random random(9);
  const Vector<3> f = some_vector(random, 1.0);
  const auto q = some_state(plate, random);
  const auto load = plate.surface_load(f);
  const auto pressure = plate.pressure_force(q);
  for (int k = 0; k < TestType::dofs; ++k) {
    INFO("coordinate " << k);
    const double exact_load = over_plate(plate, [&](double x, double y) {
      return plate.shape({x, y}).col(k).dot(f);
    });
    CHECK(std::abs(load[k] - exact_load) < rounding * load.norm());
    const double exact_pressure = over_plate(plate, [&](double x, double y) {
      const Vector<3> r_x = plate.shape_gradient({x, y}, 0) * q;
      const Vector<3> r_y = plate.shape_gradient({x, y}, 1) * q;
      return plate.shape({x, y}).col(k).dot(r_x.cross(r_y));
    });
    CHECK(std::abs(pressure[k] - exact_pressure) < rounding * pressure.norm());
  }
  const auto exact = complex_step<TestType::dofs>(
      q, [&](const auto& z) { return plate.template pressure_force<Complex>(z); });
  CHECK(difference(plate.pressure_tangent(q), exact) < derivative);
}

TEMPLATE_TEST_CASE("A stretched and sheared plate has the energy of its Green strains", "[mbs]",
                   Plate36, Plate48) {
  const auto plate = some_plate<TestType>();
  const double nu = plate.poisson_ratio;
  Matrix<3, 2> A = Matrix<3, 2>::Zero();
  A.topRows<2>() << 1.2, 0.15, -0.05, 0.9;
  const Matrix<2, 2> green = (A.transpose() * A - Matrix<2, 2>::Identity()) / 2;
  const double e11 = green(0, 0), e22 = green(1, 1), g12 = 2 * green(0, 1);
  const double energy = membrane_energy(plate) / (2 * (1 - nu * nu)) *
                        (e11 * e11 + e22 * e22 + 2 * nu * e11 * e22 + (1 - nu) / 2 * g12 * g12);
  const auto q = affine_state<TestType>(plate, A, Vector<3>::Zero());
  CHECK(plate.strain_energy(q) == Approx(energy).epsilon(rounding));
}

TEMPLATE_TEST_CASE("A plate bent to a parabola and a twisted plate have their exact energies",
                   "[mbs]", Plate36, Plate48) {
  const auto plate = some_plate<TestType>();
  const double nu = plate.poisson_ratio, t = plate.thickness;
  const double C = plate.youngs_modulus * t / (1 - nu * nu), D = C * t * t / 12;
  constexpr double curvature = 0.3;            // [1/m]
  constexpr double four_points_enough = 1e-9;  // the bending energy is not a polynomial
  const auto exact = [&](auto&& strains) {
    return over_plate(plate, [&](double x, double y) {
      const auto [e11, e22, g12, k11, k22, k12] = strains(x, y);
      const auto square = [nu](double s, double p, double g) {
        return s * s + p * p + 2 * nu * s * p + (1 - nu) / 2 * g * g;
      };
      return (C * square(e11, e22, g12) + D * square(k11, k22, k12)) / 2;
    });
  };
  const auto energy = [&](double c, int i, int j) {
    return plate.strain_energy(flat_state(plate) +
                               polynomial_state(plate, Vector<3>{0, 0, c}, i, j));
  };
  using Strains = std::array<double, 6>;
  const double along_x = exact([](double x, double) {
    const double slope = curvature * x;
    return Strains{slope * slope / 2, 0, 0, curvature * std::pow(1 + slope * slope, -1.5), 0, 0};
  });
  const double along_y = exact([](double, double y) {
    const double slope = curvature * y;
    return Strains{0, slope * slope / 2, 0, 0, curvature * std::pow(1 + slope * slope, -1.5), 0};
  });
  const double twist = exact([](double x, double y) {
    const double r_x = curvature * y, r_y = curvature * x;
    const double n = std::sqrt(1 + r_x * r_x + r_y * r_y);
    return Strains{r_x * r_x / 2, r_y * r_y / 2, r_x * r_y, 0, 0, 2 * curvature / (n * n * n)};
  });
  // Strains at a point of the twisted plate.
  const Vector<TestType::dofs> q =
      flat_state(plate) + polynomial_state(plate, Vector<3>{0, 0, curvature}, 1, 1);
  const double r_x = curvature * 0.15, r_y = curvature * 0.25;
  const double n = std::sqrt(1 + r_x * r_x + r_y * r_y);
  Vector<6> at_point;
  at_point << r_x * r_x / 2, r_y * r_y / 2, r_x * r_y, 0, 0, 2 * curvature / (n * n * n);
  CHECK((plate.strains(q, {0.25, 0.15}) - at_point).norm() < rounding);
  CHECK(energy(curvature / 2, 2, 0) == Approx(along_x).epsilon(four_points_enough));
  CHECK(energy(curvature / 2, 0, 2) == Approx(along_y).epsilon(four_points_enough));
  CHECK(energy(curvature, 1, 1) == Approx(twist).epsilon(four_points_enough));
}

namespace {

enum class Edges { simply_supported, clamped, free, cantilever };

/// A flat square plate of side 1 by n x n elements whose deflection w is small: the transverse
/// coordinates of the tangent, the mass and a uniform load.
template <class P>
struct LinearPlate {
  static constexpr int functions = P::node_dofs / 3;
  MatrixXd K, M;
  VectorXd Q;
  std::vector<int> held_free;  // coordinates that are not fixed
  int centre;
  double D, mass_per_area;

  LinearPlate(int n, Edges edges) {
    const P plate{.length = 1.0 / n,
                  .width = 1.0 / n,
                  .thickness = 0.01,
                  .density = 1000,
                  .youngs_modulus = 1e7,
                  .poisson_ratio = 0.3};
    D = plate.youngs_modulus * std::pow(plate.thickness, 3) / 12 / (1 - 0.09);
    mass_per_area = plate.density * plate.thickness;
    const auto q = flat_state(plate);
    const auto tangent = plate.tangent(q, q, 0), mass = plate.mass_matrix();
    const auto load = plate.surface_load({0, 0, 1});
    const int size = (n + 1) * (n + 1) * functions;
    K = M = MatrixXd::Zero(size, size);
    Q = VectorXd::Zero(size);
    const auto node = [n](int i, int j) { return (j * (n + 1) + i) * functions; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int corner[4] = {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
        const auto place = [&](int k) { return corner[k / functions] + k % functions; };
        for (int k = 0; k < 4 * functions; ++k) {
          Q[place(k)] += load[3 * k + 2];
          for (int l = 0; l < 4 * functions; ++l) {
            K(place(k), place(l)) += tangent(3 * k + 2, 3 * l + 2);
            M(place(k), place(l)) += mass(3 * k + 2, 3 * l + 2);
          }
        }
      }
    centre = node(n / 2, n / 2);
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        for (int f = 0; f < functions; ++f)
          if (!fixed(edges, i == 0, i == n, j == 0 || j == n, f))
            held_free.push_back(node(i, j) + f);
  }

  // f: w, w_x, w_y, w_xy.
  static bool fixed(Edges edges, bool left, bool right, bool along_x, int f) {
    const bool along_y = left || right;
    if (edges == Edges::clamped) return along_x || along_y;
    if (edges == Edges::cantilever) return left;
    if (edges == Edges::free) return false;
    return (along_x && f <= 1) || (along_y && (f == 0 || f == 2));
  }

  /// omega a^2 sqrt(rho t/D), ascending.
  VectorXd frequencies() const {
    const MatrixXd k = K(held_free, held_free), m = M(held_free, held_free);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(k, m, Eigen::EigenvaluesOnly);
    return (solver.eigenvalues().cwiseMax(0) * mass_per_area / D).cwiseSqrt();
  }

  /// w D/(q a^4) at the centre.
  double deflection() const {
    const MatrixXd k = K(held_free, held_free);
    const VectorXd load = Q(held_free);
    VectorXd w = VectorXd::Zero(Q.size());
    w(held_free) = k.ldlt().solve(load).eval();
    return w[centre] * D;
  }
};

/// As many digits as the tables give.
void check_digits(const VectorXd& found, const std::vector<double>& table, int decimals,
                  int first = 0) {
  for (std::size_t i = 0; i < table.size(); ++i)
    CHECK(std::abs(found[first + static_cast<int>(i)] - table[i]) <
          0.501 * std::pow(10.0, -decimals));
}

}  // namespace

TEST_CASE("About its flat state a plate of 36 coordinates is Adini, Clough and Melosh's", "[mbs]") {
  const LinearPlate<Plate36> supported(4, Edges::simply_supported);
  check_digits(supported.frequencies(), {19.1498, 47.4047, 47.4047, 72.0851, 96.2182}, 4);
  CHECK(std::abs(supported.deflection() - 0.00432820) < 0.501e-8);
  CHECK(std::abs(LinearPlate<Plate36>(8, Edges::simply_supported).deflection() - 0.00412928) <
        0.501e-8);
  const LinearPlate<Plate36> cantilever(4, Edges::cantilever);
  check_digits(cantilever.frequencies(), {3.46942, 8.52037}, 5);
  const LinearPlate<Plate36> free(4, Edges::free);
  check_digits(free.frequencies(), {13.5213, 19.6622, 24.4188}, 4, 3);
  CHECK(free.frequencies()[2] < 1e-3);
}

TEST_CASE("About its flat state a plate of 48 coordinates is the bicubic one", "[mbs]") {
  const LinearPlate<Plate48> supported(4, Edges::simply_supported);
  check_digits(supported.frequencies(), {19.7418, 49.4763, 49.4763, 79.1271}, 4);
  CHECK(std::abs(supported.deflection() - 0.00406533) < 0.501e-8);
  const LinearPlate<Plate48> clamped(4, Edges::clamped);
  check_digits(clamped.frequencies(), {36.0573}, 4);
  CHECK(std::abs(clamped.deflection() - 0.00126487) < 0.501e-8);
  const LinearPlate<Plate48> cantilever(4, Edges::cantilever);
  check_digits(cantilever.frequencies(), {3.47505, 8.51764}, 5);
  const LinearPlate<Plate48> free(4, Edges::free);
  check_digits(free.frequencies(), {13.4773, 19.6134, 24.3053}, 4, 3);
  CHECK(free.frequencies()[2] < 1e-3);
}

TEST_CASE("A plate refuses sizes, materials and damping out of range", "[mbs][fault]") {
  const auto complaint = [](auto&& change) {
    auto plate = some_plate<Plate36>();
    change(plate);
    return test::refusal([&] { plate.check(); });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  CHECK(complaint([](auto&) {}).empty());
  CHECK(complaint([](auto& p) { p.length = 0; }) == "length = 0: must be positive [m]");
  CHECK(complaint([](auto& p) { p.width = -1; }) == "width = -1: must be positive [m]");
  CHECK(complaint([](auto& p) { p.thickness = -0.1; }) == "thickness = -0.1: must be positive [m]");
  CHECK(complaint([](auto& p) { p.density = -1; }) == "density = -1: must be positive [kg/m^3]");
  CHECK(complaint([](auto& p) { p.youngs_modulus = -5; }) ==
        "youngs_modulus = -5: must be positive [Pa]");
  for (const double nu : {-1.0, 0.5, 0.7, nan}) {
    CHECK_THAT(
        complaint([nu](auto& p) { p.poisson_ratio = nu; }),
        Catch::Contains("poisson_ratio = ") && Catch::Contains(": must be between -1 and 0.5"));
  }
  CHECK(complaint([](auto& p) { p.damping = -1; }) == "damping = -1: must be zero or positive [s]");
  for (const double bad : {nan, infinite}) {
    CHECK(!complaint([bad](auto& p) { p.length = bad; }).empty());
    CHECK(!complaint([bad](auto& p) { p.width = bad; }).empty());
    CHECK(!complaint([bad](auto& p) { p.thickness = bad; }).empty());
    CHECK(!complaint([bad](auto& p) { p.density = bad; }).empty());
    CHECK(!complaint([bad](auto& p) { p.youngs_modulus = bad; }).empty());
    CHECK(!complaint([bad](auto& p) { p.damping = bad; }).empty());
  }
}
