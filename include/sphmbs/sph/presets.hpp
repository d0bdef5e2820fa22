// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/boundary/extrapolated.hpp>
#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/kernels/quintic_spline.hpp>
#include <sphmbs/reconstruction/muscl.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/riemann/hllc.hpp>
#include <sphmbs/sph/scheme.hpp>

/// Schemes put together for a purpose; docs/choosing.md has their measured errors and speeds.
namespace sphmbs::sph {

/// The paper's own.
template <int Dim>
using PaperScheme = RiemannSph<kernels::QuinticSpline<Dim>, riemann::Acoustic, eos::IdealGas>;

/// For smooth flow, from rest to about the speed of sound, with forces on walls and bodies that are
/// to be trusted; set `background` to the ambient pressure where the flow is slow. Virtual
/// particles must be added with their solid.
template <int Dim, class... More>
using SmoothScheme =
    RiemannSph<kernels::QuinticSpline<Dim>, riemann::Acoustic, eos::IdealGas, More...,
               reconstruction::Muscl<>, VolumeForm, Shifting, boundary::FreeSlip>;

/// For shocks and strong expansions. Virtual particles must be added with their solid.
template <int Dim, class... More>
using ShockScheme =
    RiemannSph<kernels::QuinticSpline<Dim>, riemann::Hllc, eos::IdealGas, More...,
               reconstruction::Muscl<>, VolumeForm, Relaxed, NoXsph, boundary::FreeSlip>;

}  // namespace sphmbs::sph
