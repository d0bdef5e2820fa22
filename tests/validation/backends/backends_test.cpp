// SPDX-License-Identifier: MIT
// The paper's cases with every back end of a build: what one thread of the host gives, up to
// rounding; and no back end that falls back to another one in silence.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/policies.hpp"
#include "support/program.hpp"

namespace {

using Words = std::vector<std::string>;

test::Table run(const test::Scratch& scratch, const std::string& program, Words words,
                const std::string& backend, const std::string& table) {
  words.insert(words.end(), {"--backend", backend, "--quiet", "--output", backend});
  const test::Ended ended = test::start(scratch, program, words);
  INFO(backend << ": " << ended.err);
  REQUIRE(ended.code == 0);
  CHECK(test::summary_of(scratch.work() / backend)["backend"] == backend);
  return test::table_of(scratch.work() / backend / table);
}

void check(const std::string& program, const Words& words, const std::string& table) {
  const test::Scratch scratch;
  const test::Table expected = run(scratch, program, words, "serial", table);
  REQUIRE(expected.rows.size() > 2);
  sphmbs::execution::for_compiled([&](auto policy) {
    const std::string backend(policy.name);
    if (backend == "serial") return;
    const test::Table found = run(scratch, program, words, backend, table);
    REQUIRE(found.head == expected.head);
    REQUIRE(found.rows.size() == expected.rows.size());
    for (const std::string& name : expected.head) {
      const auto here = found.column(name), there = expected.column(name);
      double size = 0, apart = 0;
      for (std::size_t k = 0; k < there.size(); ++k) {
        if (std::isnan(here[k]) && std::isnan(there[k])) continue;  // nothing there to sample
        REQUIRE(std::isfinite(here[k]));
        size = std::max(size, std::abs(there[k]));
        apart = std::max(apart, std::abs(here[k] - there[k]));
      }
      CAPTURE(backend, name, apart, size);
      CHECK(apart <= 1e-7 * size + 1e-12);
    }
  });
}

}  // namespace

TEST_CASE("case 1, gas around a cylinder, on every back end", "[backends]") {
  check(SPHMBS_GAS_CYLINDER, {"--spacing", "2", "--until", "1"}, "history.csv");
  check(SPHMBS_GAS_CYLINDER, {"--spacing", "2", "--until", "0.5", "--scheme", "best"},
        "history.csv");
}

TEST_CASE("case 2, a cavity that closes in, on every back end", "[backends]") {
  check(SPHMBS_SEALED_CAVITY, {"--spacing", "0.05", "--until", "0.05"}, "history.csv");
}

#if defined(SPHMBS_PENDULUM_ON_CABLE)
TEST_CASE("case 3, a pendulum on a cable in air, on every back end", "[backends]") {
  check(SPHMBS_PENDULUM_ON_CABLE, {"--spacing", "0.1", "--until", "0.05"}, "trajectories.csv");
}
#endif

TEST_CASE("case 4, falling plates in air, on every back end", "[backends]") {
  check(SPHMBS_FALLING_PLATES, {"--elements", "3", "--until", "0.01"}, "trajectories.csv");
}

TEST_CASE("a device that is not there is an error with a hint", "[backends]") {
  const test::Scratch scratch;
  // Whatever the tests run on: without devices and without leave to do without.
  ::setenv("CUDA_VISIBLE_DEVICES", "", 1);
  ::unsetenv("ACC_DEVICE_TYPE");
  ::unsetenv("OMP_TARGET_OFFLOAD");
  sphmbs::execution::for_compiled([&]<class Policy>(Policy policy) {
    if (sphmbs::execution::on_host<Policy>) return;
    const std::string backend(policy.name);
    const test::Ended ended = test::start(
        scratch, SPHMBS_GAS_CYLINDER, {"--spacing", "2", "--until", "0.01", "--backend", backend});
    if (SPHMBS_VIRTUAL_DEVICES) CHECK(ended.code == 0);
    // A device beyond the last one is the host by OpenMP's rules.
    ::setenv("OMP_DEFAULT_DEVICE", "4", 1);
    const test::Ended beyond = test::start(
        scratch, SPHMBS_GAS_CYLINDER,
        {"--spacing", "2", "--until", "0.01", "--backend", backend, "--output", "beyond"});
    ::unsetenv("OMP_DEFAULT_DEVICE");
    CHECK(beyond.code == 2);
    if (SPHMBS_VIRTUAL_DEVICES) {
      // And devices that are not to be used are not named.
      ::setenv("OMP_TARGET_OFFLOAD", "DISABLED", 1);
      const test::Ended disabled = test::start(
          scratch, SPHMBS_GAS_CYLINDER,
          {"--spacing", "2", "--until", "0.01", "--backend", backend, "--output", "disabled"});
      ::unsetenv("OMP_TARGET_OFFLOAD");
      CHECK(disabled.code == 0);
      CHECK_THAT(disabled.out, Catch::Contains("on the host (OMP_TARGET_OFFLOAD=DISABLED)"));
      return;
    }
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err,
               Catch::Contains("error E100 execution policy " + backend + ": no device was found"));
    CHECK(scratch.found().empty());
  });
}
