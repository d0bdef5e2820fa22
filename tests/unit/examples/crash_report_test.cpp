// SPDX-License-Identifier: MIT
#include "support/crash_report.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "support/ball_in_gas.hpp"
#include "support/catch.hpp"

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a crash report has the culprit with those around it, and the bodies",
          "[examples][fault]") {
  using Ball = test::BallInGas<sphmbs::sph::PaperScheme<2>>;
  Ball ball({.spacing = 0.2, .side = 4});
  ball.system.evaluate();
  const auto folder = std::filesystem::temp_directory_path() / "sphmbs_crash_report_test";
  std::filesystem::remove_all(folder);
  const sphmbs::NumericalFailure failure("gone", "E302", {0});
  const auto files = sphmbs::examples::write_crash_report(folder / "crash", ball.system, failure);
  REQUIRE(files.size() == 2);
  const std::string culprits = text_of(folder / "crash" / "culprits.vtp");
  for (const char* part : {"culprit", "energy [J/kg]", "rate of density", "neighbours", "id"})
    CHECK(culprits.find(part) != std::string::npos);
  // Three supports around a corner of the box, not all of it.
  const auto count = [&] {
    const auto at = culprits.find("NumberOfPoints=\"") + 16;
    return std::stoul(culprits.substr(at));
  }();
  CHECK(count > 20);
  CHECK(count < ball.fluid.size() / 2);
  CHECK(text_of(folder / "crash" / "bodies.vtp").find("NumberOfPoints") != std::string::npos);
  // Without a culprit there is none to be shown.
  CHECK(sphmbs::examples::write_crash_report(folder / "other", ball.bodies,
                                             sphmbs::NumericalFailure("gone"))
            .size() == 1);
  CHECK(sphmbs::examples::write_crash_report(folder / "third", ball.fluid,
                                             sphmbs::NumericalFailure("gone"))
            .empty());
  std::filesystem::remove_all(folder);
}
