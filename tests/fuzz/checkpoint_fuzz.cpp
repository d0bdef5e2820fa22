// SPDX-License-Identifier: MIT
// Any bytes are a checkpoint that can be read, or refused in a sentence.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

#include <sphmbs/io/checkpoints.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("sphmbs_fuzz_" + std::to_string(::getpid()));
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    sphmbs::io::CheckpointFile file(path);
    sphmbs::io::Checkpoints::identity_of(file);
    std::vector<double> numbers;
    sphmbs::io::StateReader(file)("numbers", numbers);
  } catch (const sphmbs::RefusedCheckpoint&) {
  }
  return 0;
}
