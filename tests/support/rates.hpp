// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <sphmbs/eos/ideal_gas.hpp>
#include <sphmbs/execution/serial.hpp>
#include <sphmbs/kernels/quintic_spline.hpp>
#include <sphmbs/riemann/acoustic.hpp>
#include <sphmbs/sph/fluid.hpp>

namespace test {

/// The paper's gas.
template <int Dim, class Smoothing = sphmbs::sph::Xsph, class Stress = sphmbs::sph::Inviscid,
          class Wall = sphmbs::boundary::Evolved>
using Gas = sphmbs::sph::RiemannSph<sphmbs::kernels::QuinticSpline<Dim>, sphmbs::riemann::Acoustic,
                                    sphmbs::eos::IdealGas, Smoothing, Wall, Stress>;

/// A field, copied to the host, in the order of the initial cloud.
template <class Policy, class U>
std::vector<U> by_id(const U* field, const std::uint32_t* id, std::size_t n) {
  std::vector<U> values(n);
  std::vector<U> sorted(n);
  std::vector<std::uint32_t> place(n);
  Policy::download(values.data(), field, n * sizeof(U));
  Policy::download(place.data(), id, n * sizeof(std::uint32_t));
  for (std::size_t i = 0; i < n; ++i) sorted[place[i]] = values[i];
  return sorted;
}

/// Rates of change of every particle in the order of the initial cloud, in double precision.
template <int Dim>
struct Rates {
  std::vector<sphmbs::Vec<Dim>> r;
  std::vector<sphmbs::Vec<Dim>> v;
  std::vector<double> rho;
  std::vector<double> e;
  std::vector<double> h;
  std::vector<double> pairs;
  sphmbs::sph::Survey<Dim> survey;

  std::size_t size() const { return rho.size(); }
};

/// The rates that a fluid holds.
template <class Scheme, class Policy, class Motion, class T>
Rates<Scheme::dim> rates_by_id(sphmbs::sph::Fluid<Scheme, Policy, Motion, T>& fluid) {
  const auto rates = fluid.particles().rates();
  const std::uint32_t* id = fluid.particles().fields().id;
  const std::size_t n = fluid.size();
  const auto column = [&](const auto* field) {
    std::vector<double> values;
    for (const auto x : by_id<Policy>(field, id, n)) values.push_back(static_cast<double>(x));
    return values;
  };
  Rates<Scheme::dim> found{.r = std::vector<sphmbs::Vec<Scheme::dim>>(n),
                           .v = std::vector<sphmbs::Vec<Scheme::dim>>(n),
                           .rho = column(rates.rho),
                           .e = column(rates.e),
                           .h = column(rates.h),
                           .pairs = column(rates.pairs),
                           .survey = fluid.survey()};
  for (int k = 0; k < Scheme::dim; ++k) {
    const auto r = column(rates.r[k]);
    const auto v = column(rates.v[k]);
    for (std::size_t i = 0; i < n; ++i) {
      found.r[i][k] = r[i];
      found.v[i][k] = v[i];
    }
  }
  return found;
}

/// The rates of a cloud at time 0.
template <class Policy = sphmbs::execution::Serial, class T = double, class Scheme,
          class Motion = sphmbs::boundary::Fixed>
Rates<Scheme::dim> rates_of(const Scheme& scheme,
                            const sphmbs::geometry::Domain<Scheme::dim>& domain,
                            const sphmbs::particles::Cloud<Scheme::dim>& cloud,
                            const Motion& motion = {}) {
  sphmbs::sph::Fluid<Scheme, Policy, Motion, T> fluid(scheme, domain, cloud, motion);
  fluid.stage(0, 0);
  fluid.rates(0);
  return rates_by_id(fluid);
}

/// Length of a vector.
template <int Dim>
double length(const sphmbs::Vec<Dim>& a) {
  return std::sqrt(norm2(a));
}

/// A sum and the sum of its terms' sizes, which is what its rounding is measured by.
struct Sum {
  double value = 0;
  double size = 0;

  void add(double term) {
    value += term;
    size += std::abs(term);
  }
  /// The sum as a share of its terms' sizes.
  double share() const { return size > 0 ? std::abs(value) / size : 0; }
};

}  // namespace test
