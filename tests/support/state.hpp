// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <sphmbs/sph/fluid.hpp>

#include "support/bits.hpp"
#include "support/rates.hpp"

namespace test {

/// What a fluid's particles carry, in the order of the initial cloud and in double precision.
template <int Dim>
struct State {
  std::vector<sphmbs::Vec<Dim>> r;
  std::vector<sphmbs::Vec<Dim>> v;
  std::vector<double> rho;
  std::vector<double> e;
  std::vector<double> h;
  std::vector<double> m;

  std::size_t size() const { return rho.size(); }

  friend bool same_bits(const State& a, const State& b) {
    return test::same_bits(a.r, b.r) && test::same_bits(a.v, b.v) &&
           test::same_bits(a.rho, b.rho) && test::same_bits(a.e, b.e) &&
           test::same_bits(a.h, b.h) && test::same_bits(a.m, b.m);
  }
};

template <class Scheme, class Policy, class Motion, class T>
State<Scheme::dim> state_of(sphmbs::sph::Fluid<Scheme, Policy, Motion, T>& fluid) {
  constexpr int dim = Scheme::dim;
  const auto fields = fluid.particles().fields();
  const std::size_t n = fluid.size();
  const auto column = [&](const T* field) {
    const std::vector<T> values = by_id<Policy>(field, fields.id, n);
    return std::vector<double>(values.begin(), values.end());
  };
  State<dim> state{.r = std::vector<sphmbs::Vec<dim>>(n),
                   .v = std::vector<sphmbs::Vec<dim>>(n),
                   .rho = column(fields.rho),
                   .e = column(fields.e),
                   .h = column(fields.h),
                   .m = column(fields.m)};
  for (int k = 0; k < dim; ++k) {
    const std::vector<double> r = column(fields.r[k]);
    const std::vector<double> v = column(fields.v[k]);
    for (std::size_t i = 0; i < n; ++i) {
      state.r[i][k] = r[i];
      state.v[i][k] = v[i];
    }
  }
  return state;
}

/// Takes so many steps of equal length.
template <class Fluid, class Integrator>
void take_steps(Fluid& fluid, const Integrator& integrator, int count, double dt) {
  for (int step = 0; step < count; ++step) integrator.step(fluid, [dt] { return dt; });
}

}  // namespace test
