// SPDX-License-Identifier: MIT
#pragma once

#if defined(_OPENMP)
#include <sphmbs/execution/openmp.hpp>
#else
#include <sphmbs/execution/serial.hpp>
#endif

namespace sphmbs::execution {

/// The policy taken where none is named: the host's threads where the compiler has OpenMP.
#if defined(_OPENMP)
using Default = OpenMP;
#else
using Default = Serial;
#endif

}  // namespace sphmbs::execution
