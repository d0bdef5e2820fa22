// SPDX-License-Identifier: MIT
#pragma once

/// Umbrella of the coupling room: gas and bodies together, beside sphmbs.hpp and mbs.hpp.
#include <sphmbs/coupling/immersed.hpp>
#include <sphmbs/coupling/leaks.hpp>
#include <sphmbs/coupling/riding.hpp>
#include <sphmbs/coupling/staggered.hpp>
#include <sphmbs/coupling/strong.hpp>
#include <sphmbs/coupling/wetted_grid.hpp>
#include <sphmbs/coupling/wetted_line.hpp>
#include <sphmbs/coupling/wetted_point.hpp>
#include <sphmbs/coupling/wetted_surface.hpp>
