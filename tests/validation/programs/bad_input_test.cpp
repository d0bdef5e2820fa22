// SPDX-License-Identifier: MIT
// Bad input ends every program with exit code 2 and a line that says where it was given, the
// parameter, its value and what is allowed, before anything is written.
#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

#include "support/catch.hpp"
#include "support/program.hpp"

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Program {
  const char* path;
  const char* name;
  bool gas = true;
  bool bodies = false;
};

const Program programs[] = {{SPHMBS_GAS_CYLINDER, "gas_cylinder"},
                            {SPHMBS_SEALED_CAVITY, "sealed_cavity"},
                            {SPHMBS_SHOCK_TUBE, "shock_tube"},
                            {SPHMBS_SHOCK_TUBE_2D, "shock_tube_2d"},
                            {SPHMBS_SHOCK_TUBE_3D, "shock_tube_3d"},
                            {SPHMBS_PENDULUM_ON_CABLE, "pendulum_on_cable", true, true},
                            {SPHMBS_FALLING_PLATES, "falling_plates", true, true},
                            {SPHMBS_SHOCK_PANEL, "shock_panel", true, true},
                            {SPHMBS_FLEXIBLE_PENDULUM, "flexible_pendulum", false, true},
                            {SPHMBS_SLIDER_CRANK, "slider_crank", false, true},
                            {SPHMBS_SPINNING_TOP, "spinning_top", false, true}};

struct Row {
  Words words;
  Words said;  // each appears in the line
};

/// What must be refused by every program with gas, or by every one without.
std::vector<Row> rows(bool gas) {
  const std::string variable = gas ? "--cfl" : "--accuracy";
  Words numbers{"--until", "--step", variable, "--threads"};
  std::vector<Row> all = {
      {{"--treads", "2"}, {"--treads", "did you mean --threads?"}},
      {{"--nothing-like-it", "2"}, {"--nothing-like-it", "--help"}},
      {{"0.5"}, {"0.5: error E001 cannot read"}},
      {{variable, "0.2", "--step", "1e-3"}, {"--step 1e-3", "excludes " + variable}},
      {{"--backend", "cuda"}, {"--backend cuda", "openmp", "serial"}},
      {{"--backend", "serial", "--threads", "2"}, {"--threads 2", "serial"}},
      {{"--until", "0.01", "--until", "0.01"}, {"--until", "more than once"}},
      {{"--quiet=yes"}, {"--quiet", "takes no value"}}};
  if (gas) {
    numbers.push_back("--spacing");
    all.push_back({{"--spaceing", "0.5"}, {"--spaceing", "did you mean --spacing?"}});
    all.push_back({{"--cfl", "1.5"}, {"--cfl 1.5", "at most 1"}});
    all.push_back({{"--spacing", "1000"}, {"--spacing 1000", "must be"}});
  } else {
    all.push_back({{"--spacing", "0.5"}, {"--spacing", "is not an option"}});
    all.push_back({{"--spectral-radius", "1.5"}, {"--spectral-radius 1.5", "from 0 to 1"}});
    all.push_back({{"--spectral-radius", "nan"}, {"--spectral-radius nan", "from 0 to 1"}});
  }
  for (const std::string& option : numbers) {
    all.push_back({{option}, {option, "needs a value", "must be"}});
    for (const char* value : {"abc", "1x", "nan", "inf", "-inf", "0", "-1", "1e400", "-1e400"})
      all.push_back({{option, value}, {option + " " + value + ":", "must be", " number"}});
  }
  for (const char* option : {"--backend", "--output"})
    all.push_back({{option}, {option, "needs a value", "must be"}});
  for (const char* value : {"1.5", "99999", "99999999999999999999"})
    all.push_back({{"--threads", value}, {std::string("--threads ") + value, "whole number"}});
  return all;
}

/// One line on standard error with all that is to be said, how many there are, and nothing else
/// anywhere.
void check_refused(const test::Scratch& scratch, const Program& program, const Words& words,
                   const Words& said, const Words& on_disk = {}) {
  std::string typed = program.name;
  for (const std::string& word : words) typed += " " + word;
  CAPTURE(typed);
  const auto ended = test::start(scratch, program.path, words);
  CAPTURE(ended.err);
  CHECK(ended.code == 2);
  CHECK(ended.out.empty());
  CHECK(test::lines_of(ended.err).size() == 2);
  CHECK_THAT(ended.err,
             Catch::Contains(": error E0") && Catch::EndsWith("\n1 error; nothing was written\n"));
  for (const std::string& part : said) CHECK_THAT(ended.err, Catch::Contains(part));
  Words found = scratch.found();
  std::sort(found.begin(), found.end());
  CHECK(found == on_disk);
}

}  // namespace

TEST_CASE("the programs refuse bad options and write nothing", "[programs][fault]") {
  const test::Scratch scratch;
  for (const Program& program : programs)
    for (const Row& row : rows(program.gas)) check_refused(scratch, program, row.words, row.said);
}

TEST_CASE("the programs refuse what does not fit their case", "[programs][fault]") {
  const test::Scratch scratch;
  const Program& cylinder = programs[0];
  const Program& cavity = programs[1];
  check_refused(scratch, cylinder, {"--spacing", "0.3"}, {"spacing", "0.3", "must be", "100"});
  check_refused(scratch, cylinder, {"--spacing", "2.5"}, {"--spacing 2.5", "at most 2 m"});
  check_refused(scratch, cavity, {"--spacing", "0.03"}, {"--spacing 0.03", "whole fraction"});
  check_refused(scratch, cavity, {"--until", "1"}, {"--until 1", "at most 0.9 s"});
  for (const Program& tube : {programs[2], programs[3], programs[4]})
    check_refused(scratch, tube, {"--spacing", "0.1"}, {"--spacing 0.1", "at most 0.025 m"});
  for (const Program& flexible : {programs[5], programs[6], programs[7]})
    for (const char* elements : {"1", "-3", "2.5", "1000000"})
      check_refused(scratch, flexible, {"--elements", elements},
                    {std::string("--elements ") + elements, "whole number from 2 to"});
  check_refused(scratch, programs[5], {"--measure", "hencky"},
                {"--measure hencky", "green, engineering"});
}

TEST_CASE("the programs refuse a folder of results they cannot or may not fill",
          "[programs][fault]") {
  const test::Scratch scratch;
  std::ofstream(scratch.work() / "file") << "mine";
  fs::create_directory(scratch.work() / "full");
  std::ofstream(scratch.work() / "full" / "mine") << "mine";
  const Words before = {"file", "full", "full/mine"};
  for (const Program& program : programs) {
    const auto refused = [&](const std::string& folder, const Words& said) {
      Words all = said;
      all.push_back("--output " + folder + ":");
      all.push_back("must be");
      check_refused(scratch, program, {"--output", folder}, all, before);
    };
    refused("file", {"a file has this name"});
    refused("file/below", {"not a directory"});
    refused("full", {"new or empty", "--overwrite"});
    refused("/dev/null/below", {"not a directory"});
  }
  CHECK(test::text_of(scratch.work() / "file") == "mine");
  CHECK(test::text_of(scratch.work() / "full" / "mine") == "mine");

  // The superuser may write anywhere.
  if (::geteuid() == 0) return;
  fs::create_directory(scratch.work() / "locked");
  fs::permissions(scratch.work() / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  for (const Program& program : programs)
    for (const char* folder : {"locked", "locked/below"})
      check_refused(scratch, program, {"--output", folder},
                    {std::string("--output ") + folder, "must be"},
                    {"file", "full", "full/mine", "locked"});
}

TEST_CASE("a program says where in its parameter file every mistake is", "[programs][fault]") {
  const test::Scratch scratch;
  std::ofstream(scratch.work() / "case.toml") << "[run]\nspacing = -1\ncfll = 0.3\n\n[pipe]\n"
                                                 "size = [100, 50, 3]\n";
  const auto ended = test::start(scratch, programs[0].path, {"case.toml", "--untl", "3"});
  CHECK(ended.code == 2);
  CHECK(ended.out.empty());
  const Words lines = test::lines_of(ended.err);
  REQUIRE(lines.size() == 5);
  CHECK_THAT(lines[0], Catch::StartsWith("case.toml:2:11: error E022 run.spacing = -1: must be"));
  CHECK(lines[1] == "case.toml:3:1: error E021 run.cfll: unknown key; did you mean \"run.cfl\"?");
  CHECK_THAT(lines[2], Catch::StartsWith("case.toml:6:8: error E024 pipe.size = [100, 50, 3]:"));
  CHECK_THAT(lines[3], Catch::StartsWith("command line: error E010 --untl: is not an option"));
  CHECK(lines[4] == "4 errors; nothing was written");
  CHECK(scratch.found() == Words{"case.toml"});

  // What only the case can judge.
  std::ofstream(scratch.work() / "case.toml") << "[run]\nspacing = 0.3\n";
  const auto refused = test::start(scratch, programs[0].path, {"case.toml"});
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Catch::StartsWith("case.toml:2:11: error E023 run.spacing = 0.3: must"));
  CHECK(scratch.found() == Words{"case.toml"});
}

TEST_CASE("what --dump-params shows is a parameter file of the same program", "[programs]") {
  const test::Scratch scratch;
  for (const Program& program : programs) {
    CAPTURE(program.name);
    const auto first = test::start(scratch, program.path, {"--dump-params", "--until", "0.125"});
    REQUIRE(first.code == 0);
    std::ofstream(scratch.work() / "dump.toml") << first.out;
    const auto second = test::start(scratch, program.path, {"dump.toml", "--dump-params"});
    CHECK(second.err.empty());
    CHECK(second.out == first.out);
    CHECK(scratch.found() == Words{"dump.toml"});
  }
}

TEST_CASE("the programs answer --help and --version and write nothing", "[programs]") {
  const test::Scratch scratch;
  for (const Program& program : programs) {
    CAPTURE(program.name);
    const auto help = test::start(scratch, program.path, {"--help"});
    CHECK(help.code == 0);
    CHECK(help.err.empty());
    for (const char* option : {"--until", "--step", "--threads", "--backend", "--output",
                               "--overwrite", "--quiet", "Exit codes"})
      CHECK_THAT(help.out, Catch::Contains(option));
    const auto offers = [&](const char* option) {
      return help.out.find(option) != std::string::npos;
    };
    CHECK(offers("--spacing") == program.gas);
    CHECK(offers("--cfl") == program.gas);
    CHECK(offers("--accuracy") == !program.gas);
    CHECK(offers("--spectral-radius") == program.bodies);
    const auto version = test::start(scratch, program.path, {"--version"});
    CHECK(version.code == 0);
    CHECK(version.err.empty());
    CHECK(test::lines_of(version.out).size() == 1);
    CHECK_THAT(version.out,
               Catch::StartsWith(std::string(program.name) + " ") && Catch::Contains("sphmbs"));
    CHECK(scratch.found().empty());
  }
}
