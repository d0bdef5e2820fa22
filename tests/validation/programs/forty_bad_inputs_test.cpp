// SPDX-License-Identifier: MIT
// The bad inputs that docs/bad_inputs.md lists end as it says: each alone, all in one file, and
// anything like them.
#include <algorithm>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/bad_inputs.hpp"
#include "support/catch.hpp"
#include "support/program.hpp"

namespace {

using test::for_each_row;
using test::is_like;
using test::quoted;
using Lines = std::vector<std::string>;

const std::map<std::string, std::string> programs{
    {"gas_cylinder", SPHMBS_GAS_CYLINDER},         {"shape_in_flow", SPHMBS_SHAPE_IN_FLOW},
    {"shape_in_flow_3d", SPHMBS_SHAPE_IN_FLOW_3D}, {"shock_panel", SPHMBS_SHOCK_PANEL},
    {"slider_crank", SPHMBS_SLIDER_CRANK},         {"flexible_pendulum", SPHMBS_FLEXIBLE_PENDULUM},
};

/// A row of the first table of the page.
struct Input {
  std::string name;     // number and what it is
  Lines file;           // lines of case.toml
  Lines words;          // program and its arguments
  std::string message;  // on standard error, with … for what differs between computers; or "none"
};

std::vector<Input> inputs() {
  std::vector<Input> all;
  for_each_row([&](const Lines& cells) {
    if (cells.size() != 5) return;
    const Lines command = quoted(cells[3]), message = quoted(cells[4]);
    REQUIRE(command.size() == 1);
    REQUIRE(message.size() <= 1);
    std::istringstream stream(command.front());
    Input input{
        cells[0] + cells[1], quoted(cells[2]), {}, message.empty() ? "none" : message.front()};
    for (std::string word; stream >> word;) input.words.push_back(word);
    all.push_back(input);
  });
  return all;
}

/// A cube of 1, without its last triangles.
void write_cube(const std::filesystem::path& path, std::size_t missing) {
  const int corners[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  std::ofstream file(path);
  file << "solid cube\n";
  for (std::size_t k = 0; k + missing < 12; ++k) {
    file << "facet normal 0 0 0\nouter loop\n";
    for (const int c : corners[k])
      file << "vertex " << (c & 1) - 0.5 << ' ' << ((c >> 1) & 1) - 0.5 << ' ' << (c >> 2) - 0.5
           << '\n';
    file << "endloop\nendfacet\n";
  }
  file << "endsolid cube\n";
}

/// Writes the files that the page speaks of.
void prepare(const test::Scratch& scratch, const Lines& lines) {
  write_cube(scratch.work() / "cube.stl", 0);
  write_cube(scratch.work() / "open.stl", 2);
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  const std::size_t zero = text.find("\\0");
  if (zero != std::string::npos) text.replace(zero, 2, 1, '\0');
  std::ofstream(scratch.work() / "case.toml", std::ios::binary) << text;
}

test::Ended start(const test::Scratch& scratch, const Lines& words) {
  return test::start(scratch, programs.at(words.front()), {words.begin() + 1, words.end()});
}

/// Whether there is nothing but what prepare() wrote.
bool is_untouched(const test::Scratch& scratch) {
  Lines found = scratch.found();
  std::sort(found.begin(), found.end());
  return found == Lines{"case.toml", "cube.stl", "open.stl"};
}

}  // namespace

TEST_CASE("the page of bad inputs has all forty", "[programs][fault]") {
  std::set<int> numbers;
  for_each_row([&](const Lines& cells) { numbers.insert(std::stoi(cells[0])); });
  for (int k = 1; k <= 40; ++k) CHECK(numbers.count(k) == 1);
  CHECK(inputs().size() >= 40);
}

TEST_CASE("each bad input alone gives the line that its page says", "[programs][fault]") {
  for (const Input& input : inputs()) {
    CAPTURE(input.name);
    const test::Scratch scratch;
    prepare(scratch, input.file);
    const auto ended = start(scratch, input.words);
    CAPTURE(ended.err);
    const Lines said = test::lines_of(ended.err);
    if (input.message == "none") {
      CHECK(ended.code == 0);
      CHECK(said.empty());
    } else if (input.message.starts_with("warning: ")) {
      CHECK(ended.code == 0);
      REQUIRE(said.size() == 1);
      CHECK(is_like(said[0], input.message));
    } else {
      CHECK(ended.code == 2);
      CHECK(ended.out.empty());
      REQUIRE(said.size() == 2);
      CHECK(is_like(said[0], input.message));
      CHECK(said[1] == "1 error; nothing was written");
      CHECK(is_untouched(scratch));
    }
  }
}

TEST_CASE("bad inputs in one file are all listed at once", "[programs][fault]") {
  // Of one program, what is wrong with a single key or table, and no key twice.
  struct Line {
    std::string text;
    std::string message = "";  // "column: error ..."; empty if nothing is wrong with it
  };
  std::map<std::string, std::vector<Line>> tables;  // by head, which is the first line
  for (const Input& input : inputs()) {
    if (input.words != Lines{"gas_cylinder", "case.toml"} || input.file.size() != 2) continue;
    if (input.message.find("E003") < input.message.size() ||
        input.message.find("E023") < input.message.size())
      continue;
    std::vector<Line>& table = tables[input.file[0]];
    if (table.empty()) table.push_back({input.file[0]});
    const std::string& key_line = input.file[1];
    const auto same_key = [&](const Line& line) {
      return line.text.substr(0, line.text.find('=')) == key_line.substr(0, key_line.find('='));
    };
    if (std::any_of(table.begin(), table.end(), same_key)) continue;
    table.push_back({key_line});
    const std::string place = "case.toml:1:";
    Line& wrong = input.message.starts_with(place) ? table.front() : table.back();
    wrong.message = input.message.substr(place.size());
  }
  Lines file, expected;
  for (const auto& [head, table] : tables)
    for (const Line& line : table) {
      file.push_back(line.text);
      if (line.message.empty()) continue;
      expected.push_back("case.toml:" + std::to_string(file.size()) + ":" + line.message);
    }
  REQUIRE(expected.size() >= 12);
  expected.push_back(std::to_string(expected.size()) + " errors; nothing was written");

  const test::Scratch scratch;
  prepare(scratch, file);
  const auto ended = start(scratch, {"gas_cylinder", "case.toml"});
  CHECK(ended.code == 2);
  CHECK(ended.out.empty());
  CHECK(test::lines_of(ended.err) == expected);
  CHECK(is_untouched(scratch));
}

TEST_CASE("mutated parameter files of the programs are read or refused", "[programs][fault]") {
  std::mt19937 random(42);
  const auto any = [&random](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  const std::string letters = "[]{}=.,\"'#\n -+0123456789einfa";
  const test::Scratch scratch;
  int accepted = 0, refused = 0;
  for (const auto& [name, path] : programs) {
    const std::string whole = test::start(scratch, path, {"--dump-params"}).out;
    REQUIRE(whole.size() > 1000);
    for (int k = 0; k < 200; ++k) {
      std::string text = whole;
      for (std::size_t changes = 1 + any(4); changes > 0; --changes) {
        const std::size_t at = any(text.size());
        if (any(2) == 0)
          text[at] = letters[any(letters.size())];
        else
          text.erase(at, 1 + any(10));
      }
      prepare(scratch, {text});
      const auto ended = test::start(scratch, path, {"case.toml", "--dump-params"});
      CAPTURE(name, text, ended.err);
      REQUIRE((ended.code == 0 || ended.code == 2));
      REQUIRE(ended.err.empty() == (ended.code == 0));
      for (const std::string& line : test::lines_of(ended.err))
        REQUIRE_THAT(line,
                     Catch::StartsWith("case.toml:") || Catch::EndsWith("nothing was written"));
      REQUIRE(is_untouched(scratch));
      ++(ended.code == 0 ? accepted : refused);
    }
  }
  CHECK(accepted > 100);
  CHECK(refused > 300);
}
