// SPDX-License-Identifier: MIT
#include <vector>

#include <Eigen/LU>

#include <sphmbs/mbs/redundancy.hpp>

#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/mechanisms.hpp"
#include "support/random.hpp"

using namespace sphmbs::mbs;

namespace {

constexpr int block_rows = 10, block_columns = 8;  // so that two rows of each block are dependent

/// Blocks of random numbers along the diagonal.
SparseMatrix blocks(int count, test::Random& random) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int b = 0; b < count; ++b)
    for (int i = 0; i < block_rows; ++i)
      for (int j = 0; j < block_columns; ++j)
        entries.emplace_back(block_rows * b + i, block_columns * b + j, random.between(-1, 1));
  SparseMatrix A(block_rows * count, block_columns * count);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Chain of bars of 1 m between two pins, along the x axis but for a kink of some height.
test::PlanarMechanism chain(int bars, double kink) {
  test::PlanarMechanism mechanism;
  std::vector<Placed<ncf::Bar>> placed;
  const auto knot = [&](int i) { return Vector<2>(i, i > 0 && i < bars ? kink * (i % 2) : 0.0); };
  for (int i = 0; i < bars; ++i) {
    placed.push_back(mechanism.add(test::thin_bar(knot(i), knot(i + 1))));
    if (i > 0)
      mechanism.add(joints::revolute(placed[static_cast<std::size_t>(i) - 1].end(),
                                     placed.back().start(), "knot " + std::to_string(i)));
  }
  mechanism.add(joints::pinned(placed.front().start(), mechanism.q(), "left"));
  mechanism.add(joints::pinned(placed.back().end(), mechanism.q(), "right"));
  return mechanism;
}

}  // namespace

TEST_CASE("rows beyond the rank are found, in few and in many rows", "[mbs]") {
  test::Random random(11);
  for (const int count : {4, 60}) {
    const SparseMatrix A = blocks(count, random);
    const std::vector<unsigned char> none(static_cast<std::size_t>(A.rows()), 0);
    const std::vector<int> dependent = redundant_rows(A, none);
    CHECK(static_cast<int>(dependent.size()) == count * (block_rows - block_columns));
    // What is left of each block has its full rank.
    std::vector<bool> removed(none.size());
    for (const int i : dependent) removed[static_cast<std::size_t>(i)] = true;
    for (int b = 0; b < count; ++b) {
      MatrixXd kept(block_columns, block_columns);
      int k = 0;
      for (int i = block_rows * b; i < block_rows * (b + 1); ++i)
        if (!removed[static_cast<std::size_t>(i)] && k < block_columns)
          kept.row(k++) = MatrixXd(A.row(i)).middleCols(block_columns * b, block_columns);
      REQUIRE(k == block_columns);
      CHECK(std::abs(kept.determinant()) > 1e-6);
    }
  }
}

TEST_CASE("rows that are to be kept are kept", "[mbs]") {
  test::Random random(12);
  for (const int count : {4, 60}) {
    const SparseMatrix A = blocks(count, random);
    std::vector<unsigned char> first(static_cast<std::size_t>(A.rows()), 0);
    std::vector<int> others;
    for (int i = 0; i < A.rows(); ++i)
      if (i % block_rows == 3 || i % block_rows == 7)
        others.push_back(i);
      else
        first[static_cast<std::size_t>(i)] = 1;
    CHECK(redundant_rows(A, first) == others);
  }
}

TEST_CASE("a row that others almost explain counts as the tolerance says", "[mbs]") {
  for (const int n : {20, 500}) {
    constexpr double off = 1e-7;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) entries.emplace_back(i, i, 1.0);
    entries.emplace_back(n, 0, 0.6);
    entries.emplace_back(n, 1, 0.8);
    entries.emplace_back(n, n, off);
    SparseMatrix A(n + 1, n + 1);
    A.setFromTriplets(entries.begin(), entries.end());
    const std::vector<unsigned char> none(static_cast<std::size_t>(n) + 1, 0);
    CHECK(redundant_rows(A, none, 1e-9).empty());
    CHECK(redundant_rows(A, none, 1e-6).size() == 1);
  }
}

TEST_CASE("a straight chain between two pins has one condition too many, that of a joint",
          "[mbs][fault]") {
  for (const int bars : {20, 200}) {
    test::PlanarMechanism straight = chain(bars, 0);
    CHECK(test::mentions(test::refusal([&] {
                           Dynamics<test::PlanarMechanism> system(straight,
                                                                  {.redundant = Redundant::refuse});
                         }),
                         {"1 redundant condition(s)", "'"}));
    test::PlanarMechanism bent = chain(bars, 0.1);
    CHECK(Dynamics<test::PlanarMechanism>(bent).start().redundant.empty());
  }
}
