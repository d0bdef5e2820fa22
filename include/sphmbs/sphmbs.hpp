// SPDX-License-Identifier: MIT
#pragma once

/// Umbrella: every room of sphmbs.
#include <sphmbs/boundary/evolved.hpp>
#include <sphmbs/boundary/motion.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/core/vec.hpp>
#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/eos/stiffened_gas.hpp>
#include <sphmbs/execution/default.hpp>
#include <sphmbs/execution/openmp.hpp>
#include <sphmbs/execution/serial.hpp>
#include <sphmbs/geometry/ball.hpp>
#include <sphmbs/geometry/box.hpp>
#include <sphmbs/geometry/capsule.hpp>
#include <sphmbs/geometry/domain.hpp>
#include <sphmbs/geometry/lattice.hpp>
#include <sphmbs/geometry/polygon.hpp>
#include <sphmbs/io/csv.hpp>
#include <sphmbs/io/pvd.hpp>
#include <sphmbs/io/vtp.hpp>
#include <sphmbs/kernels/cubic_spline.hpp>
#include <sphmbs/kernels/quintic_spline.hpp>
#include <sphmbs/kernels/wendland.hpp>
#include <sphmbs/neighbours/brute_force.hpp>
#include <sphmbs/neighbours/cell_list.hpp>
#include <sphmbs/particles/cloud.hpp>
#include <sphmbs/particles/particles.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/run.hpp>
#include <sphmbs/sph/fluid.hpp>
#include <sphmbs/sph/scheme.hpp>
#include <sphmbs/time/heun.hpp>
#include <sphmbs/time/predictor_corrector.hpp>
#include <sphmbs/time/shu_osher.hpp>
#include <sphmbs/version.hpp>
