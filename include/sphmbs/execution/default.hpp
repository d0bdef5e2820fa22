// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/execution/openmp.hpp>
#include <sphmbs/execution/serial.hpp>

namespace sphmbs::execution {

/// The policy taken where none is named.
using Default = OpenMP;

}  // namespace sphmbs::execution
