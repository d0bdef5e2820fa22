// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/beam.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/forces/couple.hpp>
#include <sphmbs/mbs/forces/point_force.hpp>
#include <sphmbs/mbs/joints/clamped.hpp>

#include "support/catch.hpp"
#include "support/rods.hpp"

using namespace sphmbs::mbs;
using ancf::Beam;
using sphmbs::execution::Serial;
using test::order;

namespace {

constexpr double pi = std::numbers::pi;

using Model = Structure<Beam, joints::Joint<3>, forces::PointForce<3>, forces::Couple>;

/// Cantilever of n beams along x. The clamp holds r, r_y and r_z of its root.
struct Cantilever {
  Model model;
  ancf::Line<Beam> line;

  Cantilever(const Beam& beam, double length, int n)
      : line(ancf::line(model, {.to = {length, 0, 0}, .elements = n, .prototype = beam})) {
    const auto& root = line.elements.front();
    const auto held = [&](int k) { return root.gradient(root.part.start(), k); };
    model.add(joints::clamped(line.start(), {held(1), held(2)}, model.q()));
  }
  /// r_y and r_z at the tip for k = 1, 2.
  Marker<3> director(int k) const {
    const auto& last = line.elements.back();
    return last.gradient(last.part.end(), k);
  }
  void push(const Vector<3>& force) {
    model.add(forces::PointForce<3>{.at = line.end(), .value = force});
  }
  /// Both directors of the end take half of the moment: it does not distort the section.
  void twist(const Vector<3>& moment) {
    model.add(forces::Couple{.u = director(1), .w = director(2), .value = 0.5 * moment});
    model.add(forces::Couple{.u = director(2), .w = director(1), .value = 0.5 * moment});
  }
};

struct Bent {
  Vector<3> tip, turn;  // turn: mean of the directors', where it is small
};
Bent bend(Cantilever& beam, const StaticsOptions& options = {}) {
  const VectorXd q = equilibrium<solvers::SparseLDLT, Serial>(beam.model, options).state.q;
  const Vector<3> y = beam.director(1).at(q), z = beam.director(2).at(q);
  return {beam.line.end().at(q), {0.5 * (y[2] - z[1]), z[0], -y[0]}};
}

/// Stiffnesses of Timoshenko's beam: bending about y and z, torsion, and shear.
struct Stiffness {
  double EIy, EIz, GJ, kGA;

  explicit Stiffness(const Beam& b)
      : EIy(b.youngs_modulus * b.second_moment_y()),
        EIz(b.youngs_modulus * b.second_moment_z()),
        GJ(b.shear_modulus() * ancf::torsion_constant(b.width, b.height)),
        kGA(b.shear_correction * b.shear_modulus() * b.area()) {}
};

/// Square beam with sides h, of unit mass per length and unit bending stiffness.
Beam square(double h) {
  return {.width = h,
          .height = h,
          .density = 1 / (h * h),
          .youngs_modulus = 12 / std::pow(h, 4),
          .poisson_ratio = 0.3};
}

/// Cantilever of Timoshenko's beam of unit length: the frequency next to beta^2 of Euler's beam
/// (Huang 1961, Journal of Applied Mechanics 28).
double timoshenko(const Beam& beam, double beta) {
  const double r2 = beam.second_moment_y() / beam.area(), s2 = 1 / Stiffness(beam).kGA;
  const auto characteristic = [&](double b) {
    const double mean = 0.5 * (r2 + s2);
    const double half = std::sqrt(0.25 * (r2 - s2) * (r2 - s2) + 1 / (b * b));
    const double outer = b * std::sqrt(half - mean), inner = b * std::sqrt(half + mean);
    return 2 + (b * b * (r2 - s2) * (r2 - s2) + 2) * std::cosh(outer) * std::cos(inner) -
           b * (r2 + s2) / std::sqrt(1 - b * b * r2 * s2) * std::sinh(outer) * std::sin(inner);
  };
  return test::root(0.8 * beta * beta, 1.02 * beta * beta, characteristic);
}

/// beta L of Euler's cantilever.
constexpr std::array<double, 3> clamped_free{1.87510407, 4.69409113, 7.85475744};

Modes modes(const Beam& beam, int n) {
  Cantilever cantilever(beam, 1, n);
  return eigenmodes<Serial>(cantilever.model);
}

double error(const Modes& found, int mode, double exact) {
  return std::abs(found.frequency(mode) / exact - 1);
}

}  // namespace

TEST_CASE("small deflections are those of Timoshenko's beam for any number of elements", "[mbs]") {
  const double small = 1e-6, same = 3e-7;
  for (const double poisson_ratio : {0.0, 0.3, 0.49})
    for (const double L : {0.4, 1.0})
      for (const int n : {1, 2, 8}) {
        const Beam beam{.width = 0.1,
                        .height = 0.2,
                        .density = 1,
                        .youngs_modulus = 1e6,
                        .poisson_ratio = poisson_ratio};
        const Stiffness k(beam);
        Cantilever pushed(beam, L, n), twisted(beam, L, n);
        pushed.push({0, small, small});
        twisted.twist({small, small, small});
        const Vector<3> w = bend(pushed).tip / small;
        const Bent bent = bend(twisted);
        const Vector<3> u = bent.tip / small, turn = bent.turn / small;
        CAPTURE(poisson_ratio, L, n);
        CHECK(w[1] == Approx(L * L * L / (3 * k.EIz) + L / k.kGA).epsilon(same));
        CHECK(w[2] == Approx(L * L * L / (3 * k.EIy) + L / k.kGA).epsilon(same));
        CHECK(u[1] == Approx(L * L / (2 * k.EIz)).epsilon(same));
        CHECK(u[2] == Approx(-L * L / (2 * k.EIy)).epsilon(same));
        CHECK(turn[0] == Approx(L / k.GJ).epsilon(same));
        CHECK(turn[1] == Approx(L / k.EIy).epsilon(same));
        CHECK(turn[2] == Approx(L / k.EIz).epsilon(same));
      }
}

TEST_CASE("a section that a clamp keeps from contracting stiffens the element beside it", "[mbs]") {
  const double strain = 1e-3;
  const auto stretch = [&](double poisson_ratio, int n) {
    Beam beam = square(0.1);
    beam.poisson_ratio = poisson_ratio;
    Cantilever pulled(beam, 1, n);
    pulled.push({strain * beam.youngs_modulus * beam.area(), 0, 0});
    return (bend(pulled).tip[0] - 1) / strain;
  };
  const double free_of_it = stretch(0, 4), green = 1 - 1.5 * strain;
  CHECK(free_of_it == Approx(green).epsilon(3e-4));
  for (const int n : {2, 16}) {
    const double lost = free_of_it - stretch(0.3, n);
    CAPTURE(n, lost);
    CHECK(lost == Approx(0.07 / n).epsilon(0.05));  // 7 % of an element
  }
}

TEST_CASE("a thin beam bends to the elastica with order 2", "[mbs]") {
  const auto error = [](double h, double alpha, int n) {
    const test::Elastica elastica(alpha);
    Cantilever beam(square(h), 1, n);
    beam.push({0, alpha, 0});
    const Vector<3> tip = bend(beam).tip;
    return std::hypot(1 - tip[0] - elastica.shortening, tip[1] - elastica.deflection);
  };
  const double coarse = error(5e-4, 1, 8), fine = error(5e-4, 1, 16), far = error(5e-3, 10, 16);
  CAPTURE(coarse, fine, order(coarse, fine), far);
  CHECK(fine < 2e-4);
  CHECK(order(coarse, fine) > 1.9);
  CHECK(far < 3.5e-3);
}

TEST_CASE("a moment 2 pi EI/L at its tip bends a thin beam to a full circle with order 2",
          "[mbs]") {
  const auto gap = [](int n) {
    Cantilever beam(square(5e-3), 1, n);
    beam.twist({0, 0, 2 * pi});
    return bend(beam, {.first_step = 0.1}).tip.norm();
  };
  const double coarse = gap(8), fine = gap(16);
  CAPTURE(coarse, fine, order(coarse, fine));
  CHECK(fine < 0.055);
  CHECK(order(coarse, fine) > 1.9);
}

TEST_CASE("a beam as thick as a twentieth of its length bends far within 0.2 % of Reissner's",
          "[mbs]") {
  test::RodLoad load{.length = 1, .EA = square(0.05).youngs_modulus * 0.0025, .EI = 1};
  load.force = {0, 3};
  load.shear_compliance = 1 / Stiffness(square(0.05)).kGA;
  const test::ExactRod<ancf::Engineering> exact(load);
  const auto error = [&](int n) {
    Cantilever beam(square(0.05), 1, n);
    beam.push({0, 3, 0});
    const Vector<3> tip = bend(beam).tip;
    CHECK(std::abs(tip[2]) < 1e-9);
    return (tip.head<2>() - exact.tip()).norm();
  };
  const std::array<double, 2> errors{error(4), error(32)};
  CAPTURE(errors);
  CHECK(errors[0] < 0.025);
  CHECK(errors[1] < 3e-3);  // what the energy leaves out of a section of this size
}

TEST_CASE("a thin cantilever vibrates as Timoshenko's beam with order 4", "[mbs]") {
  const Beam beam = square(0.02);
  const Modes coarse = modes(beam, 4), fine = modes(beam, 8);
  constexpr std::array<double, 3> allowed{8e-6, 3e-4, 2.2e-3};
  for (int k = 0; k < 3; ++k) {
    const double exact = timoshenko(beam, clamped_free[static_cast<std::size_t>(k)]);
    const double before = error(coarse, 2 * k, exact), now = error(fine, 2 * k, exact);
    CAPTURE(k, before, now, order(before, now));
    CHECK(now < allowed[static_cast<std::size_t>(k)]);
    CHECK(order(before, now) > 3.6);
    CHECK(fine.frequency(2 * k + 1) == Approx(fine.frequency(2 * k)).epsilon(1e-6));
  }
}

TEST_CASE("a thick cantilever vibrates in bending, torsion and stretch", "[mbs]") {
  const Beam beam = square(0.1);
  const Modes coarse = modes(beam, 8), fine = modes(beam, 16);
  const double polar = beam.second_moment_y() + beam.second_moment_z();
  struct Vibration {
    int mode;
    double exact, error, order;
  };
  for (const Vibration& v :
       {Vibration{0, timoshenko(beam, clamped_free[0]), 7e-6, 1.4},
        Vibration{2, timoshenko(beam, clamped_free[1]), 2.5e-4, 1.4},
        Vibration{6, timoshenko(beam, clamped_free[2]), 1.5e-3, 1.3},
        Vibration{4, pi / 2 * std::sqrt(Stiffness(beam).GJ / (beam.density * polar)), 1e-3, 1.9},
        // The clamped section does not contract.
        Vibration{5, pi / 2 * std::sqrt(beam.youngs_modulus / beam.density), 0.01, 0.95}}) {
    const double before = error(coarse, v.mode, v.exact), now = error(fine, v.mode, v.exact);
    CAPTURE(v.mode, before, now, order(before, now));
    CHECK(now < v.error);
    CHECK(order(before, now) > v.order);
  }
}
