// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <vector>

#include "support/catch.hpp"
#include "support/rods.hpp"
#include "support/square_plate.hpp"

using namespace sphmbs::mbs;
using ancf::Plate36, ancf::Plate48;
using test::Edges, test::order;

namespace {

using Model = Structure<Plate36, Plate48, joints::Joint<3>>;

constexpr double pi = std::numbers::pi;
constexpr double thickness = 0.01;  // small enough that membrane vibrations come far above
constexpr int rigid_motions = 6;

/// Vibrations of a square plate of n x n elements: lambda = omega a^2 sqrt(rho h/D).
template <class P>
Modes modes(int n, Edges edges) {
  Model model;
  test::square_plate<P>(model, n, edges, thickness);
  return eigenmodes<sphmbs::execution::Serial>(model);
}

/// All the decimals that an independent code gives.
void expect_table(const Modes& found, const std::vector<double>& table, int decimals,
                  int first = 0) {
  for (const double lambda : table) {
    CAPTURE(first);
    CHECK(std::abs(found.frequency(first++) - lambda) < 0.6 * std::pow(10, -decimals));
  }
}

void expect_rigid_motions(const Modes& found) {
  for (int k = 0; k < rigid_motions; ++k) CHECK(std::abs(found.squares[k]) < 1e-6);
  CHECK(found.squares[rigid_motions] > 100);
}

}  // namespace

TEST_CASE("plates of 36 coordinates vibrate as an independent code says", "[mbs]") {
  expect_table(modes<Plate36>(4, Edges::supported), {19.1498, 47.4047, 47.4047, 72.0851, 96.2182},
               4);
  const Modes cantilever = modes<Plate36>(4, Edges::cantilever);
  expect_table(cantilever, {3.46942, 8.52037}, 5);
  expect_table(cantilever, {21.5381}, 4, 2);
  const Modes free = modes<Plate36>(4, Edges::free);
  expect_rigid_motions(free);
  expect_table(free, {13.5213, 19.6622, 24.4188}, 4, rigid_motions);
}

TEST_CASE("plates of 48 coordinates vibrate as an independent code says", "[mbs]") {
  expect_table(modes<Plate48>(4, Edges::supported), {19.7418, 49.4763, 49.4763, 79.1271}, 4);
  expect_table(modes<Plate48>(4, Edges::clamped), {36.0573}, 4);
  expect_table(modes<Plate48>(4, Edges::cantilever), {3.47505, 8.51764}, 5);
  const Modes free = modes<Plate48>(4, Edges::free);
  expect_rigid_motions(free);
  expect_table(free, {13.4773, 19.6134, 24.3053}, 4, rigid_motions);
}

TEST_CASE("a supported plate vibrates at 2 pi^2, with order 2 and with order 4", "[mbs]") {
  const auto error = [](const Modes& found) {
    return std::abs(found.frequency(0) / (2 * pi * pi) - 1);
  };
  const double e36[] = {error(modes<Plate36>(4, Edges::supported)),
                        error(modes<Plate36>(8, Edges::supported))};
  const double e48[] = {error(modes<Plate48>(2, Edges::supported)),
                        error(modes<Plate48>(4, Edges::supported))};
  CAPTURE(e36[0], e36[1], order(e36[0], e36[1]), e48[0], e48[1], order(e48[0], e48[1]));
  CHECK(e36[1] < 0.016);
  CHECK(order(e36[0], e36[1]) > 1.8);
  CHECK(e48[1] < 2.7e-4);
  CHECK(order(e48[0], e48[1]) > 3.9);
}

TEST_CASE("plates vibrate as Leissa's tables say", "[mbs]") {
  // Leissa 1973, Journal of Sound and Vibration 31.
  const auto expect = [](const Modes& found, const std::vector<double>& table, int first = 0) {
    for (const double lambda : table) {
      CAPTURE(first);
      CHECK(found.frequency(first++) == Approx(lambda).epsilon(0.02));
    }
  };
  expect(modes<Plate48>(4, Edges::supported), {19.7392, 49.3480, 49.3480, 78.9568, 98.6960});
  expect(modes<Plate48>(4, Edges::clamped), {35.985, 73.394, 73.394, 108.21});
  expect(modes<Plate48>(4, Edges::cantilever), {3.471, 8.507, 21.285, 27.20, 30.96});
  expect(modes<Plate48>(4, Edges::free), {13.468, 19.596, 24.271, 34.801, 34.801}, rigid_motions);
}
