// SPDX-License-Identifier: MIT
// What fragments of the pages are compiled with: every room, and the names that pages leave out.
#pragma once

#include <sphmbs/coupling.hpp>
#include <sphmbs/geometry/advice.hpp>
#include <sphmbs/geometry/faceted.hpp>
#include <sphmbs/geometry/samples.hpp>
#include <sphmbs/io/checkpoints.hpp>
#include <sphmbs/io/state_archive.hpp>
#include <sphmbs/io/stl.hpp>
#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/ancf/cable.hpp>
#include <sphmbs/mbs/ancf/line.hpp>
#include <sphmbs/mbs/ncf/planar_body.hpp>
#include <sphmbs/sph/probe.hpp>
#include <sphmbs/sph/probe_fields.hpp>
#include <sphmbs/sphmbs.hpp>

#if __has_include(<hdf5.h>)
#include <sphmbs/io/hdf5.hpp>
#endif

using namespace sphmbs;  // NOLINT: as the pages do
