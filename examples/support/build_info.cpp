// SPDX-License-Identifier: MIT
#include "support/build_info.hpp"

#include <string_view>

#include <Eigen/Core>

#include "git_id.hpp"

namespace sphmbs::examples {
namespace {

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown compiler";
#endif
}

std::string flags() {
  std::string text;
  const auto add = [&text](std::string_view flag) { text.append(" ").append(flag); };
#if defined(__OPTIMIZE__)
  add("optimised");
#endif
#if defined(NDEBUG)
  add("NDEBUG");
#endif
#if defined(__AVX512F__)
  add("AVX-512");
#elif defined(__AVX2__)
  add("AVX2");
#endif
#if defined(__FMA__)
  add("FMA");
#endif
#if defined(__NO_MATH_ERRNO__)
  add("no-math-errno");
#endif
#if defined(__SANITIZE_ADDRESS__)
  add("address-sanitizer");
#endif
#if defined(_OPENACC)
  add("OpenACC");
  text.append(" ").append(std::to_string(_OPENACC));
#endif
#if defined(_OPENMP)
  add("OpenMP");
  text.append(" ").append(std::to_string(_OPENMP));
#endif
  return text;
}

}  // namespace

std::string build_info() {
  const std::string commit = SPHMBS_GIT_ID;
  return (commit.empty() ? "" : "commit " + commit + " | ") + compiler() + flags() + " | Eigen " +
         std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace sphmbs::examples
