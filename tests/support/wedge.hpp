// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <sphmbs/core/vec.hpp>

#include "support/guarded_main.hpp"
#include "support/output_folder.hpp"

/// A program of the tests, "wedge", with parameters of every kind.
namespace test {

namespace fs = std::filesystem;
using sphmbs::Vec;
using sphmbs::examples::guarded_main;
using sphmbs::examples::Parameters;
using sphmbs::examples::Settings;

/// An empty directory that is removed at the end of the test.
class Scratch {
 public:
  Scratch()
      : path_(fs::temp_directory_path() /
              ("sphmbs_test_" + std::to_string(::getpid()) + "_" + std::to_string(number_++))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Scratch() { fs::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const fs::path& path() const { return path_; }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  inline static int number_ = 0;
  fs::path path_;
};

/// A program with one added option of each kind, and what came out of running it.
struct Run {
  Scratch scratch{};
  double mach = 3.0;
  int order = 2;
  std::string kernel = "quintic";
  bool viscous = false;
  double gamma = 1.4;
  Vec<2> corner{1, 2};
  Parameters line{{.name = "wedge",
                   .title = "flow over a wedge",
                   .backends = {"openmp", "serial"},
                   .defaults = {.spacing = 0.5,
                                .until = 2.0,
                                .cfl = 0.4,
                                .threads = 3,
                                .output = scratch / "new" / "folder"}}};
  std::optional<Settings> settings{};
  std::string out{};
  std::string err{};
  int code = -1;

  Run() {
    line.add_number("flow.mach", mach, {.above = 1.0, .below = 20.0}, "", "inflow Mach number",
                    "--mach");
    line.add_whole_number("scheme.order", order, {.at_least = 1.0}, "", "order of reconstruction",
                          "--order");
    line.add_choice("scheme.kernel", kernel, {"quintic", "wendland"}, "smoothing kernel",
                    "--kernel");
    line.add_flag("gas.viscous", viscous, "with viscosity", "--viscous");
    line.add_number("gas.gamma", gamma, {.above = 1.0}, "", "ratio of specific heats");
    line.add_vector("wedge.corner", corner, {.at_least = 0.0}, "m", "place of the wedge's corner");
  }

  /// Writes a parameter file, which no test leaves behind.
  std::string file(const std::string& text, const std::string& name = "case.toml") const {
    std::ofstream(scratch / name, std::ios::binary) << text;
    return (scratch / name).string();
  }

  /// Runs it with these words.
  Run& with(const std::vector<std::string>& words,
            const std::function<void(const Settings&)>& body = {}) {
    std::vector<const char*> argv{"wedge"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    std::ostringstream out_stream;
    std::ostringstream err_stream;
    const auto keep = [&](const Settings& given) {
      settings = given;
      if (body) body(given);
    };
    code = guarded_main(static_cast<int>(argv.size()), argv.data(), line, keep, out_stream,
                        err_stream);
    out = out_stream.str();
    err = err_stream.str();
    return *this;
  }
};

}  // namespace test
