// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/joints/clamped.hpp>
#include <sphmbs/mbs/joints/pinned.hpp>

#include "support/catch.hpp"
#include "support/rods.hpp"

using namespace sphmbs::mbs;
using ancf::Cable;
using sphmbs::execution::Serial;
using test::order;

namespace {

using Planar = Structure<Cable<2>, joints::Joint<2>>;
using Spatial = Structure<Cable<3>, joints::Joint<3>>;

/// Cables of unit length, mass and bending stiffness along x, with EA L^2/(EI) = 1e6.
template <int Dim, class Model>
ancf::Line<Cable<Dim>> unit_cables(Model& model, int n) {
  return ancf::line<Cable<Dim>>(
      model, {.to = Vector<Dim>::Unit(0),
              .elements = n,
              .prototype = Cable<Dim>{
                  .axial_stiffness = 1e6, .bending_stiffness = 1, .mass_per_length = 1}});
}

/// Frequencies of a cantilever made of n cables.
template <int Dim>
Modes cantilever(int n) {
  std::conditional_t<Dim == 2, Planar, Spatial> model;
  const auto line = unit_cables<Dim>(model, n);
  model.add(joints::clamped(line.start(), {line.gradient(0)}, model.q()));
  return eigenmodes<Serial>(model);
}

/// beta L of the bending modes of Euler's beam.
constexpr std::array<double, 4> clamped_free{1.87510407, 4.69409113, 7.85475744, 10.99554073};
constexpr std::array<double, 3> free_free{4.73004074, 7.85320462, 10.99560784};

/// Largest relative error of the first frequencies omega/beta^2 of pairs or single modes.
template <std::size_t modes>
double error(const Modes& found, const std::array<double, modes>& beta, int first, int each) {
  double largest = 0;
  for (std::size_t k = 0; k < modes; ++k)
    for (int twin = 0; twin < each; ++twin) {
      const int mode = first + each * static_cast<int>(k) + twin;
      largest = std::max(largest, std::abs(found.frequency(mode) / (beta[k] * beta[k]) - 1));
    }
  return largest;
}

}  // namespace

TEST_CASE("cantilevers of cables vibrate as Euler's beam with order 4", "[mbs]") {
  const double coarse = error(cantilever<2>(8), clamped_free, 0, 1),
               fine = error(cantilever<2>(16), clamped_free, 0, 1);
  CAPTURE(coarse, fine, order(coarse, fine));
  CHECK(fine < 3e-4);
  CHECK(order(coarse, fine) > 3.8);
  // In space each mode comes twice.
  CHECK(error(cantilever<3>(16), clamped_free, 0, 2) == Approx(fine).epsilon(1e-3));
}

TEST_CASE("a free cable has three rigid motions in the plane, and vibrates as Euler's beam",
          "[mbs]") {
  std::array<double, 2> errors{};
  for (std::size_t k = 0; k < 2; ++k) {
    Planar model;
    unit_cables<2>(model, 8 << k);
    const Modes found = eigenmodes<Serial>(model);
    for (int rigid = 0; rigid < 3; ++rigid) CHECK(std::abs(found.squares[rigid]) < 1e-5);
    errors[k] = error(found, free_free, 3, 1);
  }
  CAPTURE(errors[0], errors[1], order(errors[0], errors[1]));
  CHECK(errors[1] < 3e-4);
  CHECK(order(errors[0], errors[1]) > 3.7);
}

TEST_CASE("a chain swings about its equilibrium at the zeros of Bessel's function", "[mbs]") {
  // omega = j/2 (g/L)^(1/2), J_0(j) = 0.
  constexpr std::array<double, 3> zeros{2.404825557695773, 5.520078110286311, 8.653727912911012};
  std::array<std::array<double, 3>, 2> errors{};
  for (std::size_t mesh = 0; mesh < 2; ++mesh) {
    Planar model;
    model.gravity = {0, -1};
    const auto line = ancf::line(
        model, {.to = {0, -1},
                .elements = 8 << mesh,
                .prototype = Cable<2>{
                    .axial_stiffness = 1e6, .bending_stiffness = 1e-10, .mass_per_length = 1}});
    model.add(joints::pinned(line.start(), model.q()));
    const Equilibrium hanging = equilibrium<solvers::SparseLDLT, Serial>(model);
    const Modes found = eigenmodes<Serial>(model, hanging.state);
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      errors[mesh][i] = std::abs(2 * found.frequency(k) / zeros[i] - 1);
    }
  }
  CAPTURE(errors);
  CHECK(*std::max_element(errors[1].begin(), errors[1].end()) < 1e-6);
  CHECK(errors[0][2] > 20 * errors[1][2]);
}
