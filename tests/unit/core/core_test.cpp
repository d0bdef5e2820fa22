// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/core/math.hpp>
#include <sphmbs/core/transpose.hpp>
#include <sphmbs/core/vec.hpp>

#include "support/bits.hpp"
#include "support/catch.hpp"
#include "support/errors.hpp"
#include "support/random.hpp"

namespace {

using sphmbs::Pack;
using sphmbs::Vec;
namespace math = sphmbs::math;

using Packs =
    std::tuple<Pack<double, 2>, Pack<double, 4>, Pack<double, 8>, Pack<float, 4>, Pack<float, 8>>;

/// Numbers that tell signs, zeros, order and special values apart.
template <class T>
std::vector<T> telling_numbers() {
  const T huge = std::numeric_limits<T>::max();
  const T infinity = std::numeric_limits<T>::infinity();
  std::vector<T> numbers{0,
                         T(-0.0),
                         1,
                         -1,
                         T(0.1),
                         T(-3.7),
                         huge,
                         -huge,
                         infinity,
                         -infinity,
                         T(2),
                         T(1e-30),
                         std::numeric_limits<T>::quiet_NaN()};
  test::Random random(1);
  while (numbers.size() < 40) numbers.push_back(static_cast<T>(random.between(-100, 100)));
  return numbers;
}

/// Calls check(a, b) for packs filled with many pairs of the telling numbers.
template <class P, class Check>
void for_pairs(Check&& check) {
  using T = typename P::Scalar;
  const std::vector<T> numbers = telling_numbers<T>();
  const std::size_t n = numbers.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      P a(T(0)), b(T(0));
      for (int l = 0; l < P::lanes; ++l) {
        const auto lane = static_cast<std::size_t>(l);
        a.v[l] = numbers[(i + lane) % n];
        b.v[l] = numbers[(j + 3 * lane) % n];
      }
      check(a, b);
    }
}

/// Equal to the last bit, or both not a number, of which there are many.
template <class T>
bool same(T a, T b) {
  return test::same_bits(a, b) || (a != a && b != b);
}

template <class P, class Expected>
bool lanes_are(P found, Expected&& expected) {
  for (int l = 0; l < P::lanes; ++l)
    if (!same<typename P::Scalar>(found.v[l], expected(l))) return false;
  return true;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("packs compute lane by lane what plain numbers compute", "[core]", Packs) {
  using P = TestType;
  using T = typename P::Scalar;
  for_pairs<P>([](P a, P b) {
    const auto plain = [&](auto f) { return [=](int l) { return f(T(a.v[l]), T(b.v[l])); }; };
    REQUIRE(lanes_are(a + b, plain([](T x, T y) { return x + y; })));
    REQUIRE(lanes_are(a - b, plain([](T x, T y) { return x - y; })));
    REQUIRE(lanes_are(a * b, plain([](T x, T y) { return x * y; })));
    REQUIRE(lanes_are(a / b, plain([](T x, T y) { return x / y; })));
    REQUIRE(lanes_are(-a, plain([](T x, T) { return -x; })));
    REQUIRE(lanes_are(math::max(a, b), plain([](T x, T y) { return math::max(x, y); })));
    REQUIRE(lanes_are(math::min(a, b), plain([](T x, T y) { return math::min(x, y); })));
    REQUIRE(lanes_are(math::sqrt(a), plain([](T x, T) { return math::sqrt(x); })));
    REQUIRE(lanes_are(math::abs(a), plain([](T x, T) { return math::abs(x); })));
    REQUIRE(lanes_are(math::power<3>(a), plain([](T x, T) { return math::power<3>(x); })));
    P sum = a, difference = a, product = a;
    sum += b;
    difference -= b;
    product *= b;
    REQUIRE(lanes_are(sum, plain([](T x, T y) { return x + y; })));
    REQUIRE(lanes_are(difference, plain([](T x, T y) { return x - y; })));
    REQUIRE(lanes_are(product, plain([](T x, T y) { return x * y; })));
  });
}

TEMPLATE_LIST_TEST_CASE("comparing packs gives one bit a lane, and select obeys it", "[core]",
                        Packs) {
  using P = TestType;
  for_pairs<P>([](P a, P b) {
    unsigned less = 0;
    unsigned more = 0;
    for (int l = 0; l < P::lanes; ++l) {
      const auto x = a.v[l];
      const auto y = b.v[l];
      if (x < y) less |= 1u << l;
      if (x > y) more |= 1u << l;
    }
    REQUIRE((a < b).bits() == less);
    REQUIRE((a > b).bits() == more);
    REQUIRE(((a < b) & (a > b)).bits() == 0);
    REQUIRE(((a < b) & (a < b)).bits() == less);
    REQUIRE(lanes_are(math::select(a < b, a, b),
                      [&](int l) { return (less >> l & 1u) != 0 ? a.v[l] : b.v[l]; }));
  });
}

TEMPLATE_LIST_TEST_CASE("a pack of one number holds it in every lane, sign and NaN too", "[core]",
                        Packs) {
  using P = TestType;
  for (const auto x : telling_numbers<typename P::Scalar>())
    CHECK(lanes_are(P(x), [x](int) { return x; }));
}

TEMPLATE_LIST_TEST_CASE("a pack is loaded from any address", "[core]", Packs) {
  using P = TestType;
  using T = typename P::Scalar;
  alignas(64) T memory[24];
  for (int i = 0; i < 24; ++i) memory[i] = static_cast<T>(i);
  for (int begin = 0; begin <= 16; ++begin)
    CHECK(lanes_are(P::load(memory + begin), [&](int l) { return static_cast<T>(begin + l); }));
}

TEMPLATE_LIST_TEST_CASE("the sum of the lanes has every lane once", "[core]", Packs) {
  using P = TestType;
  using T = typename P::Scalar;
  P a(T(0));
  T expected = 0;
  for (int l = 0; l < P::lanes; ++l) {
    a.v[l] = static_cast<T>(1 << 2 * l);
    expected += a.v[l];
  }
  CHECK(sphmbs::lane_sum(a) == expected);
  CHECK(sphmbs::lane_sum(T(3.5)) == T(3.5));
}

TEST_CASE("the widest pack of this build has some lanes", "[core]") {
  CHECK(sphmbs::native_lanes<double> >= 2);
  CHECK(sphmbs::native_lanes<float> >= sphmbs::native_lanes<double>);
  CHECK(std::is_same_v<sphmbs::Number<float, 1>, float>);
  CHECK(std::is_same_v<sphmbs::Number<float, 4>, Pack<float, 4>>);
  CHECK(std::is_same_v<sphmbs::Scalar<Pack<double, 4>>, double>);
  CHECK(std::is_same_v<sphmbs::Scalar<float>, float>);
}

TEST_CASE("set lanes are appended in order for every pattern of bits", "[core]") {
  const auto check = []<int W>(std::integral_constant<int, W>) {
    for (unsigned bits = 0; bits < (1u << W); ++bits) {
      std::vector<std::uint32_t> expected;
      for (unsigned l = 0; l < W; ++l)
        if ((bits >> l & 1u) != 0) expected.push_back(4000000000u + l);
      std::uint32_t out[W + 1];
      out[W] = 77;
      const int n = sphmbs::append_set_lanes<W>(bits, 4000000000u, out);
      REQUIRE(std::vector<std::uint32_t>(out, out + n) == expected);
      REQUIRE(out[W] == 77);
    }
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 4>{});
  check(std::integral_constant<int, 8>{});
}

TEMPLATE_LIST_TEST_CASE("transposed records are the records read one by one", "[core]", Packs) {
  using P = TestType;
  using T = typename P::Scalar;
  const auto check = []<int fields>(std::integral_constant<int, fields>) {
    constexpr std::uint32_t records = 50;
    std::vector<T> memory;
    for (std::uint32_t i = 0; i < records * fields; ++i) memory.push_back(static_cast<T>(i));
    test::Random random(2);
    for (int trial = 0; trial < 20; ++trial) {
      std::uint32_t index[P::lanes];
      for (auto& i : index) i = static_cast<std::uint32_t>(random.below(records));
      P out[fields];
      sphmbs::load_transposed(memory.data(), index, out);
      for (int f = 0; f < fields; ++f)
        REQUIRE(lanes_are(out[f], [&](int l) {
          return memory[index[l] * fields + static_cast<std::uint32_t>(f)];
        }));
    }
  };
  [&]<int... beyond>(std::integer_sequence<int, beyond...>) {
    (check(std::integral_constant<int, 4 + beyond>{}), ...);
  }
  (std::make_integer_sequence<int, 9>{});
}

TEST_CASE("vectors add, scale and multiply by components", "[core]") {
  const Vec<3> a{1, 2, 3};
  const Vec<3> b{-4, 5, 0.5};
  CHECK(a + b == Vec<3>{-3, 7, 3.5});
  CHECK(a - b == Vec<3>{5, -3, 2.5});
  CHECK(2 * a == Vec<3>{2, 4, 6});
  CHECK(dot(a, b) == 7.5);
  CHECK(norm2(a) == 14);
  CHECK(Vec<3>::all(4.0) == Vec<3>{4, 4, 4});
  Vec<3> c = a;
  c += b;
  CHECK(c == a + b);
  CHECK(a.to<float>() == Vec<3, float>{1, 2, 3});
  CHECK(Vec<1>{3.0} + Vec<1>{4.0} == Vec<1>{7.0});
  CHECK(dot(Vec<2>{3, 4}, Vec<2>{3, 4}) == 25);
  CHECK(Vec<2>{1, 2} != Vec<2>{1, 3});
}

TEST_CASE("a vector of numbers meets a vector of packs", "[core]") {
  using P = Pack<double, 4>;
  const Vec<2> a{1, 2};
  Vec<2, P> b{P(3.0), P(4.0)};
  b[0].v[2] = 30;
  const Vec<2, P> difference = b - a;
  const P product = dot(a, b);
  for (int l = 0; l < 4; ++l) {
    CHECK(difference[0].v[l] == (l == 2 ? 29 : 2));
    CHECK(difference[1].v[l] == 2);
    CHECK(product.v[l] == (l == 2 ? 38 : 11));
  }
}

TEST_CASE("whole powers are repeated products", "[core]") {
  CHECK(math::power<0>(7.0) == 1);
  CHECK(math::power<1>(7.0) == 7);
  CHECK(math::power<2>(-7.0) == 49);
  CHECK(math::power<5>(-2.0) == -32);
  CHECK(math::power<8>(3.0f) == 6561.0f);
  CHECK(math::power<11>(2.0) == 2048);
}

TEST_CASE("a broken precondition says parameter, value and what is allowed", "[core]") {
  CHECK_NOTHROW(sphmbs::expects(true, "spacing", 1.0, "positive"));
  CHECK_THROWS_AS(sphmbs::expects(false, "spacing", 1.0, "positive"), sphmbs::InvalidInput);
  CHECK(test::refusal([] { sphmbs::expects(false, "spacing", -0.5, "positive [m]"); }) ==
        "spacing = -0.5: must be positive [m]");
  CHECK(test::refusal([] { sphmbs::expects(false, "kind", "round", "flat"); }) ==
        "kind = round: must be flat");
}

TEST_CASE("every error of the library is a sphmbs Error", "[core]") {
  CHECK_THROWS_AS(throw sphmbs::InvalidInput("x"), sphmbs::Error);
  CHECK_THROWS_AS(throw sphmbs::NumericalFailure("x"), sphmbs::Error);
  CHECK_THROWS_AS(throw sphmbs::OutputError("x"), sphmbs::Error);
  CHECK_THROWS_AS(throw sphmbs::Error("x", "E100"), std::runtime_error);
}
