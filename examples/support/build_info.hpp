// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace sphmbs::examples {

/// How the program was compiled, in one line: the commit if it was built with git, compiler, the
/// macros of the flags that matter for speed and results, and the version of Eigen.
std::string build_info();

}  // namespace sphmbs::examples
