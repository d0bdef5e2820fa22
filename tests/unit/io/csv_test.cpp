// SPDX-License-Identifier: MIT
#include "sphmbs/io/csv.hpp"

#include <bit>
#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphmbs/core/error.hpp"
#include "support/catch.hpp"

namespace {

struct Directory {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("sphmbs_csv_" + std::to_string(std::random_device{}()));
  Directory() { std::filesystem::create_directories(path); }
  ~Directory() { std::filesystem::remove_all(path); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
};

std::vector<std::string> lines(const std::filesystem::path& path) {
  std::ifstream stream(path);
  REQUIRE(stream.is_open());
  std::vector<std::string> found;
  for (std::string line; std::getline(stream, line);) found.push_back(line);
  return found;
}

std::vector<double> numbers(const std::string& line) {
  std::vector<double> values;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (at < end) {
    double value = 0.0;
    const auto result = std::from_chars(at, end, value);
    REQUIRE(result.ec == std::errc{});
    values.push_back(value);
    at = result.ptr;
    if (at < end) {
      REQUIRE(*at == ',');
      ++at;
    }
  }
  return values;
}

}  // namespace

TEST_CASE("a csv file starts with comment and header", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "probes.csv";
  sphmbs::io::CsvWriter csv(path, "two probes", {{"t", "s"}, {"speed_A", "m/s"}, {"steps", ""}});
  CHECK(lines(path) == std::vector<std::string>{"# two probes", "t[s],speed_A[m/s],steps"});
  csv.row({0.0, 0.5, 3.0});
  csv.flush();
  CHECK(lines(path).at(2) == "0,0.5,3");
}

TEST_CASE("csv numbers are read back as the same doubles", "[io]") {
  using limits = std::numeric_limits<double>;
  std::vector<double> values{0.0,
                             -0.0,
                             0.1,
                             -1.0 / 3.0,
                             limits::max(),
                             limits::lowest(),
                             limits::min(),
                             limits::denorm_min(),
                             1.0 + limits::epsilon(),
                             -limits::infinity(),
                             123456789012345678.0};
  std::mt19937_64 random(1);
  while (values.size() < 1000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }

  const Directory directory;
  const std::filesystem::path path = directory.path / "extreme.csv";
  sphmbs::io::CsvWriter csv(path, "", {{"a", "1"}, {"b", "1"}});
  for (const double value : values) csv.row(std::vector<double>{value, -value});
  csv.flush();

  const std::vector<std::string> rows = lines(path);
  REQUIRE(rows.size() == values.size() + 2);
  std::size_t different = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::vector<double> read = numbers(rows[i + 2]);
    REQUIRE(read.size() == 2);
    if (std::bit_cast<std::uint64_t>(read[0]) != std::bit_cast<std::uint64_t>(values[i]) ||
        std::bit_cast<std::uint64_t>(read[1]) != std::bit_cast<std::uint64_t>(-values[i])) {
      ++different;
    }
  }
  CHECK(different == 0);
  CHECK(rows[4] == "0.10000000000000001,-0.10000000000000001");
}

TEST_CASE("csv writes nan without sign, in every locale a point", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "nan.csv";
  // Absent locales leave the classic one, and the test then only covers NaN.
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  sphmbs::io::CsvWriter csv(path, "", {{"a", "s"}, {"b", "s"}, {"c", "s"}});
  csv.row({std::nan(""), -std::nan(""), 0.5});
  csv.flush();
  std::setlocale(LC_NUMERIC, "C");
  CHECK(lines(path).at(2) == "nan,nan,0.5");
}

TEST_CASE("csv refuses rows of the wrong length and ambiguous heads", "[io]") {
  const Directory directory;
  const std::filesystem::path path = directory.path / "wrong.csv";
  sphmbs::io::CsvWriter csv(path, "", {{"a", "s"}, {"b", "s"}});
  CHECK_THROWS_AS(csv.row({1.0}), std::invalid_argument);
  CHECK_THROWS_AS(csv.row({1.0, 2.0, 3.0}), std::invalid_argument);
  csv.flush();
  CHECK(lines(path).size() == 2);

  using Columns = std::vector<sphmbs::io::CsvWriter::Column>;
  const std::filesystem::path other = directory.path / "other.csv";
  CHECK_THROWS_AS(sphmbs::io::CsvWriter(other, "", Columns{}), std::invalid_argument);
  CHECK_THROWS_AS(sphmbs::io::CsvWriter(other, "a\nb", Columns{{"a", "s"}}), std::invalid_argument);
  CHECK_THROWS_AS(sphmbs::io::CsvWriter(other, "", Columns{{"a,b", "s"}}), std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(other));
}

TEST_CASE("csv reports a missing directory and a full device", "[io]") {
  using Columns = std::vector<sphmbs::io::CsvWriter::Column>;
  const Directory directory;
  CHECK_THROWS_AS(
      sphmbs::io::CsvWriter(directory.path / "missing" / "a.csv", "", Columns{{"a", "s"}}),
      sphmbs::OutputError);
  if (!std::filesystem::exists("/dev/full")) return;
  CHECK_THROWS_AS(sphmbs::io::CsvWriter("/dev/full", "", Columns{{"a", "s"}}), sphmbs::OutputError);
}

TEST_CASE("a table goes on where it was cut off", "[io]") {
  const Directory directory;
  const auto path = directory.path / "a.csv";
  std::uintmax_t kept = 0;
  {
    sphmbs::io::CsvWriter csv(path, "c", {{"t", "s"}, {"x", "m"}});
    csv.row({0, 1});
    kept = csv.bytes();
    csv.row({1, 2});
  }
  {
    sphmbs::io::CsvWriter csv(path, 2, kept);
    csv.row({1, 3});
    CHECK_THROWS_AS(csv.row({1, 3, 4}), std::invalid_argument);
    csv.flush();
    CHECK(csv.bytes() == std::filesystem::file_size(path));
  }
  CHECK(lines(path) == std::vector<std::string>{"# c", "t[s],x[m]", "0,1", "1,3"});
  CHECK_THROWS_AS(sphmbs::io::CsvWriter(path, 2, 1000), sphmbs::OutputError);
  CHECK_THROWS_AS(sphmbs::io::CsvWriter(directory.path / "b.csv", 2, 0), sphmbs::OutputError);
  CHECK(lines(path).size() == 4);
}
