// SPDX-License-Identifier: MIT
#pragma once

/// Umbrella of the multibody room, which stands alone: a program without gas includes this, one
/// with both includes sphmbs.hpp too.
#include <sphmbs/core/error.hpp>
#include <sphmbs/mbs/dynamics.hpp>
#include <sphmbs/mbs/generalized_alpha.hpp>
#include <sphmbs/mbs/modes.hpp>
#include <sphmbs/mbs/solvers/sparse_ldlt.hpp>
#include <sphmbs/mbs/solvers/sparse_lu.hpp>
#include <sphmbs/mbs/statics.hpp>
#include <sphmbs/mbs/structure.hpp>
#include <sphmbs/run.hpp>
