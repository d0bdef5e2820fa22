// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/execution/scan.hpp>

#include "support/bits.hpp"
#include "support/catch.hpp"
#include "support/policies.hpp"
#include "support/random.hpp"

namespace {

namespace execution = sphmbs::execution;
using execution::Field;
using execution::Serial;

struct Visit {
  std::uint32_t* visits;
  SPHMBS_INLINE void operator()(std::size_t i) const { ++visits[i]; }
};

struct DoubleSum {
  double value = 0;
  SPHMBS_INLINE void combine(const DoubleSum& other) { value += other.value; }
};

struct Term {
  const double* terms;
  SPHMBS_INLINE DoubleSum operator()(std::size_t i) const { return {terms[i]}; }
};

/// Joins numbers in their order, so that any other order shows.
struct Chain {
  std::uint64_t hash = 1469598103934665603u;
  std::uint64_t length = 0;
  SPHMBS_INLINE void combine(const Chain& other) {
    if (other.length == 0) return;
    hash = (hash ^ other.hash) * 1099511628211u;
    length += other.length;
  }
};

struct Link {
  SPHMBS_INLINE Chain operator()(std::size_t i) const { return {i + 1, 1}; }
};

/// Numbers whose sum depends on the order of summation in many bits.
std::vector<double> varied_terms(std::size_t n) {
  test::Random random(1);
  std::vector<double> terms(n);
  for (double& x : terms) x = random.between(-1, 1) * std::pow(10, random.between(-12, 12));
  return terms;
}

template <class Policy>
double sum_of(const std::vector<double>& terms) {
  const Field<double, Policy> field{std::span<const double>(terms)};
  return sphmbs::execution::reduce<Policy>(terms.size(), DoubleSum{}, Term{field.data()}).value;
}

// Around the borders of blocks, chunks and nothing.
constexpr std::size_t sizes[] = {1,    2,    3,    15,   16,   17,   1023, 1024, 1025,
                                 2048, 4095, 4096, 4097, 8191, 8192, 8193, 50001};

}  // namespace

TEMPLATE_LIST_TEST_CASE("a loop visits every index once", "[execution]", test::Policies) {
  for (const int count : {1, 2, 3, 4}) {
    const test::Threads threads(count);
    for (const std::size_t n : sizes) {
      const std::vector<std::uint32_t> none(n + 1);
      Field<std::uint32_t, TestType> visits{std::span<const std::uint32_t>(none)};
      TestType::for_each(n, Visit{visits.data()});
      std::vector<std::uint32_t> expected(n, 1);
      expected.push_back(0);
      REQUIRE(visits.download() == expected);
    }
  }
  TestType::for_each(0, Visit{nullptr});
}

TEMPLATE_LIST_TEST_CASE("a policy tells its name and how much runs at once", "[execution]",
                        test::Policies) {
  const test::Threads three(3);
  if constexpr (std::is_same_v<TestType, Serial>) {
    CHECK(TestType::name == "serial");
    CHECK(TestType::concurrency() == 1);
  }
#if defined(_OPENMP)
  if constexpr (std::is_same_v<TestType, execution::OpenMP>) {
    CHECK(TestType::name == "openmp");
    CHECK(TestType::concurrency() == 3);
  }
#endif
  const int lanes = TestType::template lanes<double>;
  CHECK(lanes == (execution::on_host<TestType> ? sphmbs::native_lanes<double> : 1));
}

TEST_CASE("the policies of a build are found by their names", "[execution]") {
  std::size_t count = 0;
  execution::for_compiled([&](auto policy) {
    ++count;
    int runs = 0;
    CHECK(execution::with_policy(policy.name, [&](auto chosen) {
      ++runs;
      CHECK(chosen.name == policy.name);
    }));
    CHECK(runs == 1);
  });
  CHECK(count == std::tuple_size_v<execution::Compiled>);
  CHECK_FALSE(execution::with_policy("fpga", [](auto) {}));
}

TEMPLATE_LIST_TEST_CASE("a reduction has the same bits again and for any number of threads",
                        "[execution]", test::Policies) {
  for (const std::size_t n : sizes) {
    const auto terms = varied_terms(n);
    const double expected = sum_of<TestType>(terms);
    // All policies of the host fold in the same order.
    if (execution::on_host<TestType>) CHECK(test::same_bits(expected, sum_of<Serial>(terms)));
    for (const int count : {1, 2, 3, 4}) {
      const test::Threads threads(count);
      CAPTURE(n, count);
      CHECK(test::same_bits(sum_of<TestType>(terms), expected));
    }
  }
  // The terms do tell orders apart: from the last to the first the sum is another one.
  auto terms = varied_terms(50001);
  const double forwards = sum_of<Serial>(terms);
  std::reverse(terms.begin(), terms.end());
  CHECK_FALSE(test::same_bits(sum_of<Serial>(terms), forwards));
}

TEMPLATE_LIST_TEST_CASE("a reduction folds every index once and in order", "[execution]",
                        test::Policies) {
  for (const std::size_t n : sizes) {
    const Chain found = sphmbs::execution::reduce<TestType>(n, Chain{}, Link{});
    CHECK(found.length == n);
    // A device folds the partial results too, until one is left.
    std::vector<Chain> expected(n);
    for (std::size_t k = 0; k < n; ++k) expected[k] = Link{}(k);
    do {
      std::vector<Chain> chunks((expected.size() + TestType::chunk - 1) / TestType::chunk);
      for (std::size_t k = 0; k < expected.size(); ++k)
        chunks[k / TestType::chunk].combine(expected[k]);
      expected = chunks;
    } while (!execution::on_host<TestType> && expected.size() > 1);
    Chain whole;
    for (const Chain& chunk : expected) whole.combine(chunk);
    CHECK(found.hash == whole.hash);
  }
}

TEMPLATE_LIST_TEST_CASE("a reduction of nothing is its identity", "[execution]", test::Policies) {
  CHECK(sphmbs::execution::reduce<TestType>(0, DoubleSum{2.5}, Term{nullptr}).value == 2.5);
}

TEMPLATE_LIST_TEST_CASE("a prefix sum is that of the standard library", "[execution]",
                        test::Policies) {
  for (const int threads_count : {1, 3}) {
    const test::Threads threads(threads_count);
    for (const std::size_t n : sizes) {
      test::Random random(n);
      std::vector<std::uint32_t> count(n);
      for (auto& c : count) c = static_cast<std::uint32_t>(random.below(500));
      std::vector<std::uint64_t> expected(n + 1);
      std::exclusive_scan(count.begin(), count.end(), expected.begin(), std::uint64_t{0});
      expected[n] = expected[n - 1] + count[n - 1];
      const Field<std::uint32_t, TestType> counts{std::span<const std::uint32_t>(count)};
      Field<std::uint64_t, TestType> first(n + 1);
      const std::uint64_t total =
          sphmbs::execution::exclusive_scan<TestType>(n, counts.data(), first.data());
      CHECK(total == expected[n]);
      REQUIRE(first.download() == expected);
    }
  }
}

TEMPLATE_LIST_TEST_CASE("prefix sums beyond 32 bits are not cut off", "[execution]",
                        test::Policies) {
  const std::vector<std::uint32_t> count(5000, 4000000000u);
  const Field<std::uint32_t, TestType> counts{std::span<const std::uint32_t>(count)};
  Field<std::uint64_t, TestType> first(5001);
  const auto total = sphmbs::execution::exclusive_scan<TestType>(5000, counts.data(), first.data());
  CHECK(total == 20000000000000u);
  CHECK(first.download()[4999] == 4999 * std::uint64_t{4000000000u});
}

TEMPLATE_LIST_TEST_CASE("a field gives back what was uploaded", "[execution]", test::Policies) {
  using Numbers = Field<int, TestType>;
  const std::vector<int> values{3, 1, 4, 1, 5};
  Numbers a{std::span<const int>(values)};
  CHECK(a.size() == 5);
  CHECK(a.bytes() == 5 * sizeof(int));
  CHECK(a.download() == values);
  const std::vector<int> others{2, 7, 1, 8, 2};
  a.upload(others);
  CHECK(a.download() == others);
}

TEMPLATE_LIST_TEST_CASE("a field moves without copying and cannot be copied", "[execution]",
                        test::Policies) {
  using Numbers = Field<int, TestType>;
  CHECK_FALSE(std::is_copy_constructible_v<Numbers>);
  CHECK_FALSE(std::is_copy_assignable_v<Numbers>);
  const std::vector<int> values{1, 2, 3};
  Numbers a{std::span<const int>(values)};
  const int* const data = a.data();
  Numbers b(std::move(a));
  CHECK(b.data() == data);
  CHECK(b.download() == values);
  Numbers c(7);
  c = std::move(b);
  CHECK(c.data() == data);
  CHECK(c.size() == 3);
  Numbers d(2);
  c.swap(d);
  CHECK(d.data() == data);
  CHECK(c.size() == 2);
}

TEMPLATE_LIST_TEST_CASE("a field may be empty or change its size", "[execution]", test::Policies) {
  using Numbers = Field<double, TestType>;
  Numbers a;
  CHECK(a.size() == 0);
  CHECK(a.data() == nullptr);
  CHECK(a.download().empty());
  a.resize_discarding(10);
  CHECK(a.size() == 10);
  const double* const data = a.data();
  a.resize_discarding(10);
  CHECK(a.data() == data);  // nothing to do
  a.resize_discarding(0);
  CHECK(a.size() == 0);
  CHECK(a.data() == nullptr);
}

TEMPLATE_LIST_TEST_CASE("memory of the host is aligned to cache lines, any for whole words",
                        "[execution]", test::Policies) {
  for (const std::size_t n : {1u, 3u, 100u}) {
    const Field<char, TestType> field(n);
    const std::size_t alignment = execution::on_host<TestType> ? 64 : 16;
    CHECK(reinterpret_cast<std::uintptr_t>(field.data()) % alignment == 0);
  }
}
