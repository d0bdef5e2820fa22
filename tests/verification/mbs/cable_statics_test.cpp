// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <type_traits>

#include "support/cable_cantilever.hpp"
#include "support/catch.hpp"

using namespace sphmbs::mbs;
using ancf::Cable, ancf::Engineering, ancf::Green;
using test::bend, test::Bent, test::displacement, test::Elastica, test::to_rounding, test::ExactRod,
    test::order, test::RodLoad, test::unit_rod;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double nine_digits = 1.5e-9, six_digits = 1.5e-6;
constexpr double some = 0.15;  // of an order

/// Displacement (x, y) of a cantilever's tip by an independent code with n elements [m].
struct Row {
  int n;
  double x, y;
};

template <class Measure, std::size_t rows>
void expect_displacements(const RodLoad& load, const std::array<Row, rows>& table,
                          double tolerance) {
  for (const Row& row : table) {
    const Vector<2> moved =
        displacement(bend<Cable<2, Measure>>(load, row.n, to_rounding).tip, load);
    CAPTURE(row.n, moved.transpose());
    CHECK((moved - Vector<2>(row.x, row.y)).cwiseAbs().maxCoeff() < tolerance);
  }
}

struct Hung {
  double sag;              // of the middle below the ends [m]
  double thrust;           // horizontal force of the pin at the start [N]
  double weight_at_start;  // vertical one [N]
  Equilibrium found;
};

/// Cable pinned at both ends, of unit weight per length.
template <class Measure>
Hung hang(ancf::LineSpec<Cable<2, Measure>> spec, double EA, double EI) {
  test::CableModel<2> cable;
  cable.gravity = {0, -1};
  spec.prototype = {.axial_stiffness = EA, .bending_stiffness = EI, .mass_per_length = 1};
  const auto line = ancf::line<Cable<2, Measure>>(cable, spec);
  cable.add(joints::pinned(line.start(), cable.q()));
  cable.add(joints::pinned(line.end(), cable.q()));
  Hung hung{
      .sag = 0,
      .thrust = 0,
      .weight_at_start = 0,
      .found = equilibrium<solvers::SparseLDLT, sphmbs::execution::Serial>(cable, to_rounding)};
  const auto& [q, lambda] = std::tie(hung.found.state.q, hung.found.state.lambda);
  hung.sag = -line.point(line.length / 2).at(q)[1];
  hung.thrust = lambda[0];
  hung.weight_at_start = -lambda[1];
  return hung;
}

/// Elastic cable of unit weight per unstretched length between two points of the same height, by
/// Simpson's rule on r' = l(T) (H, V)/T, V = length/2 - s, T = (H^2 + V^2)^(1/2).
template <class Measure>
struct Catenary {
  double thrust, sag;

  Catenary(double span, double length, double EA) {
    const auto half = [&](double H) {
      constexpr int intervals = 400;
      Vector<2> sum = Vector<2>::Zero();
      for (int k = 0; k <= intervals; ++k) {
        const double weight = k == 0 || k == intervals ? 1 : 2 + 2 * (k % 2);
        const double V = length / 2 * k / intervals, T = std::hypot(H, V);
        sum += weight * test::stretch<Measure>(T, 0, EA, 1) / T * Vector<2>(H, V);
      }
      return Vector<2>(sum * length / 2 / intervals / 3);
    };
    thrust = test::root(1e-3, EA, [&](double H) { return half(H)[0] - span / 2; });
    sag = half(thrust)[1];
  }
};

}  // namespace

TEMPLATE_TEST_CASE("a thin cantilever bends to the elastica under a tip force", "[mbs]", Green,
                   Engineering) {
  struct Row {
    double alpha, shortening, deflection, angle;
  };
  // Bisshopp and Drucker 1945.
  constexpr std::array<Row, 9> table{{{0.25, 0.004118, 0.082746, 0.124292},
                                      {0.5, 0.015919, 0.162144, 0.244534},
                                      {1, 0.056433, 0.301721, 0.461352},
                                      {2, 0.160642, 0.493457, 0.781750},
                                      {3, 0.254420, 0.603253, 0.986017},
                                      {4, 0.328941, 0.669964, 1.121239},
                                      {5, 0.387628, 0.713792, 1.215368},
                                      {7.5, 0.489574, 0.776702, 1.355927},
                                      {10, 0.554996, 0.810609, 1.430286}}};
  for (const Row& row : table) {
    const Elastica elastica(row.alpha);
    CHECK(std::abs(elastica.shortening - row.shortening) < 6e-7);
    CHECK(std::abs(elastica.deflection - row.deflection) < 6e-7);
    CHECK(std::abs(elastica.angle - row.angle) < 6e-7);

    RodLoad load = unit_rod(1e6);
    load.force = {0, row.alpha};
    const Bent bent = bend<Cable<2, TestType>>(load, 32);
    const int steps = bent.found.load_steps, iterations = bent.found.iterations;
    const double place =
        std::hypot(1 - bent.tip[0] - elastica.shortening, bent.tip[1] - elastica.deflection);
    const double angle = std::abs(bent.angle - elastica.angle);
    INFO("alpha " << row.alpha << ": error " << place << ", of the angle " << angle << "; " << steps
                  << " load steps, " << iterations << " iterations");
    CHECK(place < 2e-5);
    CHECK(angle < 2e-5);
  }
}

TEST_CASE("a very thin cantilever bends as an independent code says", "[mbs]") {
  struct Row {
    double alpha, x, w;
  };
  constexpr std::array<Row, 3> table{
      {{1, 0.943567, 0.301720}, {3, 0.745586, 0.603243}, {10, 0.445040, 0.810559}}};
  for (const Row& row : table) {
    RodLoad load = unit_rod(1e7);
    load.force = {0, row.alpha};
    const Bent bent = bend<Cable<2, Green>>(load, 32);
    const int steps = bent.found.load_steps, iterations = bent.found.iterations;
    CAPTURE(row.alpha, bent.tip.transpose(), steps, iterations);
    CHECK(std::abs(bent.tip[0] - row.x) < six_digits);
    CHECK(std::abs(bent.tip[1] - row.w) < six_digits);
    CHECK(iterations < 600);
  }
}

TEMPLATE_TEST_CASE("a cantilever under a tip force converges to the exact rod of its measure",
                   "[mbs]", Green, Engineering) {
  struct Case {
    double stiffness, alpha, place, angle;  // the errors allowed with 32 elements
  };
  constexpr std::array<Case, 4> cases{
      {{1e3, 1, 1e-9, 1e-9}, {1e3, 10, 3e-7, 1e-7}, {1e5, 1, 3e-8, 3e-8}, {1e5, 10, 2.5e-6, 5e-7}}};
  for (const Case& c : cases) {
    RodLoad load = unit_rod(c.stiffness);
    load.force = {0, c.alpha};
    const ExactRod<TestType> exact(load);
    std::array<double, 2> before{}, error{};
    for (const int n : {16, 32}) {
      const Bent bent = bend<Cable<2, TestType>>(load, n, to_rounding);
      before = error;
      error = {(bent.tip - exact.tip()).norm(), std::abs(bent.angle - exact.angle())};
    }
    const double place_order = order(before[0], error[0]), angle_order = order(before[1], error[1]);
    INFO("EA L^2/(EI) " << c.stiffness << ", alpha " << c.alpha << ": error " << error[0]
                        << ", order " << place_order << "; of the angle " << error[1] << ", order "
                        << angle_order);
    CHECK(error[0] < c.place);
    CHECK(error[1] < c.angle);
    CHECK(place_order > 4 - some);
    CHECK(angle_order > 4 - some);
  }
}

TEST_CASE("the cantilever of Gerstmayr and Irschik bends as two independent codes say", "[mbs]") {
  const RodLoad load = test::gerstmayr_irschik();
  SECTION("engineering strain") {
    constexpr std::array<Row, 6> table{{{1, -0.362244730, -0.994144759},
                                        {2, -0.488926309, -1.175222865},
                                        {4, -0.507428715, -1.205533703},
                                        {8, -0.508509237, -1.207197756},
                                        {16, -0.508536580, -1.207238895},
                                        {64, -0.508537303, -1.207239853}}};
    expect_displacements<Engineering>(load, table, nine_digits);
    const Vector<2> limit(-0.508537304326, -1.207239854550);
    CHECK((displacement(ExactRod<Engineering>(load).tip(), load) - limit).norm() < 1e-11);
  }
  SECTION("Green's strain") {
    constexpr std::array<Row, 6> table{{{1, -0.362584156, -0.995035058},
                                        {2, -0.489502210, -1.176419716},
                                        {4, -0.507822576, -1.206689544},
                                        {8, -0.508894944, -1.208355963},
                                        {16, -0.508922153, -1.208397175},
                                        {64, -0.508922869, -1.208398130}}};
    expect_displacements<Green>(load, table, nine_digits);
  }
}

TEST_CASE("a soft cantilever sags under its weight as two independent codes say", "[mbs]") {
  RodLoad load{.length = 2, .EA = 1e6, .EI = 833.3333333, .line_load = {0, -78 * 9.81}};
  SECTION("engineering strain") {
    constexpr std::array<Row, 6> table{{{2, -0.461729454, -1.170544631},
                                        {4, -0.498414437, -1.228140345},
                                        {8, -0.501231472, -1.232392904},
                                        {16, -0.501304330, -1.232507528},
                                        {32, -0.501305814, -1.232510003},
                                        {64, -0.501305846, -1.232510061}}};
    expect_displacements<Engineering>(load, table, nine_digits);
  }
  SECTION("Green's strain") {
    constexpr std::array<Row, 4> table{{{2, -0.462681, -1.172041},
                                        {4, -0.499359, -1.229983},
                                        {8, -0.502222, -1.234336},
                                        {16, -0.502296, -1.234454}}};
    expect_displacements<Green>(load, table, six_digits);
    constexpr std::array<Row, 1> fine{{{32, -0.502297303, -1.234456033}}};
    expect_displacements<Green>(load, fine, nine_digits);
  }
}

TEMPLATE_TEST_CASE("a moment 2 pi EI/L at its tip bends a cantilever to a full circle", "[mbs]",
                   Green, Engineering) {
  constexpr bool green = std::is_same_v<TestType, Green>;
  for (const double stiffness : {1e3, 1e5}) {
    RodLoad load = unit_rod(stiffness);
    load.moment = 2 * pi;
    const ExactRod<TestType> exact(load);
    // A moment alone stretches a rod of Green's strain, by l^2 = 1 + 2 M^2/(EA EI).
    const double turn = green ? 2 * pi * (1 + 8 * pi * pi / stiffness) : 2 * pi;
    CHECK(std::abs(exact.angle() - turn) < 1e-10);

    double before = 0, error = 0, gap = 0;
    int steps = 0, iterations = 0;
    for (const int n : {16, 32}) {
      const Bent bent = bend<Cable<2, TestType>>(load, n, {.first_step = 0.1});
      before = error;
      error = (bent.tip - exact.tip()).norm();
      gap = bent.tip.norm();
      steps = bent.found.load_steps;
      iterations = bent.found.iterations;
    }
    INFO("EA L^2/(EI) " << stiffness << ": error " << error << ", order " << order(before, error)
                        << ", gap " << gap << ", " << steps << " load steps, " << iterations
                        << " iterations");
    CHECK(error < 1.3e-5);
    CHECK(order(before, error) > 4 - some);
    if (!green) CHECK(gap < 1.3e-5);
    CHECK(iterations < 600);
  }
}

TEMPLATE_TEST_CASE("an elastic cable without bending stiffness hangs in an elastic catenary",
                   "[mbs]", Green, Engineering) {
  const double span = 1, length = 0.99;
  for (const double stiffness : {2.0, 50.0}) {
    const Catenary<TestType> exact(span, length, stiffness);
    if constexpr (std::is_same_v<TestType, Engineering>) {
      // Irvine 1981, Cable Structures.
      const double H = exact.thrust, half = length / 2;
      CHECK(std::abs(2 * (H * half / stiffness + H * std::asinh(half / H)) - span) < 1e-12);
      const double sag = half * half / (2 * stiffness) + std::hypot(H, half) - H;
      CHECK(std::abs(exact.sag - sag) < 1e-12);
    }
    std::array<double, 2> before{}, error{};
    for (const int n : {16, 32}) {
      const Hung hung =
          hang<TestType>({.to = {span, 0}, .elements = n, .length = length}, stiffness, 0);
      before = error;
      error = {std::abs(hung.sag - exact.sag), std::abs(hung.thrust / exact.thrust - 1)};
      CHECK(std::abs(hung.weight_at_start - length / 2) < 1e-12);
    }
    const double sag_order = order(before[0], error[0]), thrust_order = order(before[1], error[1]);
    INFO("EA " << stiffness << ": error of the sag " << error[0] << ", order " << sag_order
               << "; of the thrust " << error[1] << ", order " << thrust_order);
    CHECK(error[0] < 1.5e-7);
    CHECK(error[1] < 1.2e-9);
    CHECK(sag_order > 3.75);     // 4 as the mesh is refined
    CHECK(thrust_order > 5.75);  // 6
  }
}
