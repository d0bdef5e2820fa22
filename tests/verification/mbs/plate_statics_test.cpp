// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstddef>

#include <sphmbs/mbs/forces/point_force.hpp>

#include "support/catch.hpp"
#include "support/rods.hpp"
#include "support/square_plate.hpp"

using namespace sphmbs::mbs;
using ancf::Plate36, ancf::Plate48;
using test::Edges, test::order;

namespace {

using Model = Structure<Plate36, Plate48, joints::Joint<3>, forces::PointForce<3>>;

enum class Loading { uniform, centre };

/// w D/(q a^4) or w D/(P a^2) at the centre of a square plate of n x n elements, under a load so
/// small that deflections grow in proportion to it.
template <class P>
double deflection(int n, Edges edges, Loading load) {
  const double small = 1e-3;
  Model model;
  const auto plate = test::square_plate<P>(model, n, edges, 0.1);
  const auto centre = plate.point(0.5, 0.5);
  if (load == Loading::uniform)
    model.gravity = {0, 0, small};
  else
    model.add(forces::PointForce<3>{.at = centre, .value = {0, 0, small}});
  const Equilibrium found = equilibrium<solvers::SparseLDLT, sphmbs::execution::Serial>(model);
  return centre.at(found.state.q)[2] / small;
}

/// Kirchhoff's plate with nu = 0.3: the series of Navier and Levy for supported edges, a Ritz
/// solution for clamped ones (Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells,
/// articles 30, 34 and 44; Taylor and Govindjee 2004, Communications in Numerical Methods in
/// Engineering 20).
constexpr double exact(Edges edges, Loading load) {
  if (edges == Edges::supported) return load == Loading::uniform ? 0.0040623527 : 0.0116008398;
  return load == Loading::uniform ? 0.0012653191 : 0.0056120;
}

struct Case {
  Edges edges;
  Loading load;
  double error, order;  // largest one with 16 elements along an edge; smallest from 8 to 16
};

template <class P, std::size_t cases>
void expect_convergence(const std::array<Case, cases>& table) {
  for (const Case& c : table) {
    std::array<double, 3> error{};
    for (std::size_t k = 0; k < 3; ++k)
      error[k] = deflection<P>(4 << k, c.edges, c.load) / exact(c.edges, c.load) - 1;
    INFO((c.edges == Edges::supported ? "supported, " : "clamped, ")
         << (c.load == Loading::uniform ? "uniform load" : "load at the centre") << ": errors "
         << error[0] << ", " << error[1] << ", " << error[2] << ", orders "
         << order(error[0], error[1]) << ", " << order(error[1], error[2]));
    CHECK(std::abs(error[2]) < c.error);
    CHECK(order(error[1], error[2]) > c.order);
  }
}

}  // namespace

TEST_CASE("plates of 36 coordinates deflect under a uniform load as an independent code says",
          "[mbs]") {
  const auto supported = [](int n) {
    return deflection<Plate36>(n, Edges::supported, Loading::uniform);
  };
  const double eight_decimals = 0.6e-8;
  CHECK(std::abs(supported(4) - 0.00432820) < eight_decimals);
  CHECK(std::abs(supported(8) - 0.00412928) < eight_decimals);
  CHECK(std::abs(supported(10) - 0.00410521) < eight_decimals);
  CHECK(std::abs(supported(16) - 0.00407910) < eight_decimals);
}

TEST_CASE("plates of 48 coordinates deflect under a uniform load as an independent code says",
          "[mbs]") {
  const double eight_decimals = 0.6e-8;
  const auto w = [](int n, Edges edges) { return deflection<Plate48>(n, edges, Loading::uniform); };
  CHECK(std::abs(w(4, Edges::supported) - 0.00406533) < eight_decimals);
  CHECK(std::abs(w(8, Edges::supported) - 0.00406253) < eight_decimals);
  CHECK(std::abs(w(4, Edges::clamped) - 0.00126487) < eight_decimals);
  CHECK(std::abs(w(8, Edges::clamped) - 0.00126522) < eight_decimals);
}

// Under a force at a point the exact bending moments are infinite there: no element of these
// converges faster than with order 2.

TEST_CASE("plates of 36 coordinates converge to Kirchhoff's plate with order 2", "[mbs]") {
  expect_convergence<Plate36, 4>({{{Edges::supported, Loading::uniform, 0.006, 1.9},
                                   {Edges::supported, Loading::centre, 0.009, 1.6},
                                   {Edges::clamped, Loading::uniform, 0.012, 1.85},
                                   {Edges::clamped, Loading::centre, 0.016, 1.55}}});
}

TEST_CASE("plates of 48 coordinates converge with order 4, to a force with order 2", "[mbs]") {
  expect_convergence<Plate48, 4>({{{Edges::supported, Loading::uniform, 5e-6, 3.9},
                                   {Edges::supported, Loading::centre, 1.1e-3, 1.9},
                                   {Edges::clamped, Loading::uniform, 1.4e-5, 3.3},
                                   {Edges::clamped, Loading::centre, 2.2e-3, 1.9}}});
}
