// SPDX-License-Identifier: MIT
// Any bytes are a checkpoint that can be read, or refused in a sentence: as a file, and as what
// sections of a whole file hold.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include <Eigen/Core>

#include <sphmbs/io/checkpoints.hpp>

namespace {

using namespace sphmbs;

struct State {
  std::vector<double> numbers;
  std::vector<std::string> words;
  std::map<int, std::string> map;
  Eigen::MatrixXd matrix;

  template <Archive A>
  void visit_state(A& archive) {
    archive("numbers", numbers);
    archive("words", words);
    archive("map", map);
    archive("matrix", matrix);
  }
};

void read(const std::filesystem::path& path) {
  try {
    io::CheckpointFile file(path);
    State state;
    io::StateReader reader(file);
    reader("state", state);
  } catch (const RefusedCheckpoint&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("sphmbs_fuzz_" + std::to_string(::getpid()));
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  read(path);

  io::CheckpointFileWriter file(path);
  auto rest = std::as_bytes(std::span(data, size));
  constexpr std::pair<const char*, const char*> sections[] = {
      {"numbers", "f64"},      {"words/size", "u64"},    {"words/0", "i8"},
      {"words/1", "i8"},       {"map/keys", "i32"},      {"map/0", "i8"},
      {"matrix/shape", "i64"}, {"matrix/entries", "f64"}};
  for (const auto& [name, type] : sections) {
    const std::size_t length =
        rest.empty() ? 0 : std::min(std::to_integer<std::size_t>(rest[0]) % 33, rest.size());
    file.add(std::string("state/") + name, type, rest.first(length));
    rest = rest.subspan(length);
  }
  file.close();
  file.finish();
  read(path);
  return 0;
}
