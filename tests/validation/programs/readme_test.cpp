// SPDX-License-Identifier: MIT
// The programs accept the commands that the README shows.
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/bad_inputs.hpp"
#include "support/catch.hpp"
#include "support/program.hpp"

namespace {

using Words = std::vector<std::string>;

const std::map<std::string, std::string> programs{
    {"accelerated_cylinder", SPHMBS_ACCELERATED_CYLINDER},
    {"cylinder_wake", SPHMBS_CYLINDER_WAKE},
    {"falling_plates", SPHMBS_FALLING_PLATES},
    {"flexible_pendulum", SPHMBS_FLEXIBLE_PENDULUM},
    {"gas_cylinder", SPHMBS_GAS_CYLINDER},
    {"gas_spring", SPHMBS_GAS_SPRING},
    {"lagrange_gun", SPHMBS_LAGRANGE_GUN},
    {"lagrange_gun_2d", SPHMBS_LAGRANGE_GUN_2D},
    {"pendulum_on_cable", SPHMBS_PENDULUM_ON_CABLE},
    {"sealed_cavity", SPHMBS_SEALED_CAVITY},
    {"shock_panel", SPHMBS_SHOCK_PANEL},
    {"shock_tube", SPHMBS_SHOCK_TUBE},
    {"shock_tube_2d", SPHMBS_SHOCK_TUBE_2D},
    {"shock_tube_3d", SPHMBS_SHOCK_TUBE_3D},
    {"slider_crank", SPHMBS_SLIDER_CRANK},
    {"spinning_top", SPHMBS_SPINNING_TOP},
};

Words split(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Programs with their options: of `./scripts/run program ...`, of `program ...`, and of `--option
/// ...` in a row of a table whose first text in back quotes is a program.
std::vector<Words> commands() {
  std::vector<Words> all{{"pendulum_on_cable"}};  // of ./scripts/run alone
  for (const std::string& line : test::lines_of(test::text_of(SPHMBS_DOCS "/../README.md"))) {
    std::string row;
    for (const std::string& text : test::quoted(line)) {
      Words words = split(text);
      if (words.empty()) continue;
      if (words[0] == "./scripts/run") words.erase(words.begin());
      if (!words.empty() && programs.count(words[0]) == 1) {
        if (row.empty()) row = words[0];
        all.push_back(words);
      } else if (line.starts_with("|") && !row.empty() && text.starts_with("--")) {
        words.insert(words.begin(), row);
        all.push_back(words);
      }
    }
  }
  return all;
}

}  // namespace

TEST_CASE("the programs accept the commands of the README", "[programs]") {
  const std::vector<Words> all = commands();
  CHECK(all.size() > 20);
  for (const Words& command : all) {
    const test::Scratch scratch;
    Words options(command.begin() + 1, command.end());
    options.insert(options.end(), {"--check", "--no-plots"});
    const auto ended = test::start(scratch, programs.at(command[0]), options);
    std::string typed;
    for (const std::string& word : command) typed += word + " ";
    CAPTURE(typed, ended.err);
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
  }
}
