// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>

#include <sphmbs/particles/particles.hpp>
#include <sphmbs/sph/stages.hpp>

namespace sphmbs::sph {

/// One sentence on a particle whose state went wrong, and what to try.
template <class Policy, int Dim, class T>
std::string describe_culprit(particles::Particles<Dim, T, Policy>& particles,
                             const Culprit& culprit, double time, double dt, std::uint64_t step) {
  const auto fields = particles.fields();
  const auto rates = particles.rates();
  const auto read = [&]<class U>(const U* field) {
    U value{};
    Policy::download(&value, field + culprit.index, sizeof value);
    return value;
  };
  std::ostringstream text;
  text.precision(6);
  const int set = read(fields.set);
  text << "state not finite or not physical at step " << step << ", t = " << time
       << " s (dt = " << dt << " s): ";
  if (set == particles::gas) text << "gas particle #" << culprit.id;
  else text << "virtual particle #" << culprit.id << " of set " << set;
  const auto vector = [&](T* const(&field)[Dim]) {
    text << "(";
    for (int k = 0; k < Dim; ++k) text << (k > 0 ? ", " : "") << read(field[k]);
    text << ")";
  };
  text << " at ";
  vector(fields.r);
  text << " m, v = ";
  vector(fields.v);
  text << " m/s, rho = " << read(fields.rho) << " kg/m^3, e = " << read(fields.e)
       << " J/kg, h = " << read(fields.h) << " m, " << read(rates.pairs)
       << " neighbours; try a smaller step (--cfl or --step), or a finer or smoother initial state";
  return text.str();
}

}  // namespace sphmbs::sph
