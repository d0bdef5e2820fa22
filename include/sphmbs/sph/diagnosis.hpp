// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/particles/particles.hpp>

namespace sphmbs::sph {

/// When a state was found that cannot be gone on with.
struct Moment {
  std::uint64_t step;  ///< counted from 1
  double time;         ///< [s]
  double dt;           ///< length of the step, or the part of it up to the stage [s]
};

/// The moment of a stage at time + dt after so many steps, the last of length last_dt: at the
/// beginning of a step the state is the work of the step before.
inline Moment moment_of_stage(std::uint64_t steps, double time, double dt, double last_dt) {
  const bool begins = dt == 0 && steps > 0;
  return {steps + (begins ? 0 : 1), time + dt, begins ? last_dt : dt};
}

/// One sentence on what went wrong, on the particle with the given id at this stage, and on what to
/// try.
template <class Policy, int Dim, class T, class Eos>
std::string describe_culprit(particles::Particles<Dim, T, Policy>& particles, const Eos& eos,
                             std::string_view what, std::uint32_t id, const Moment& moment) {
  const auto read = [&]<class U>(const U* field, std::size_t n) {
    std::vector<U> value(n);
    Policy::download(value.data(), field, n * sizeof(U));
    return value;
  };
  const auto fields = particles.fields();
  const auto ids = read(fields.id, particles.size());
  const auto i = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
  constexpr auto size = static_cast<std::size_t>(particles::record_size<Dim, T>);
  const std::vector<T> numbers = read(particles.records() + i * size, size);
  const auto s = particles::load_record<Dim>(numbers.data(), 0);
  const int set = read(fields.set + i, 1)[0];
  const int neighbours = read(particles.rates().pairs + i, 1)[0];

  std::ostringstream text;
  text.precision(6);
  const auto vector = [&](const Vec<Dim, T>& x) {
    text << "(";
    for (int k = 0; k < Dim; ++k) text << (k > 0 ? ", " : "") << x[k];
    text << ")";
  };
  text << what << " at step " << moment.step << ", t = " << moment.time << " s (dt = " << moment.dt
       << " s): ";
  if (set == particles::gas)
    text << "gas particle #" << id;
  else if (particles::is_opening(static_cast<std::uint8_t>(set)))
    text << "particle #" << id << " of opening "
         << particles::opening_of(static_cast<std::uint8_t>(set));
  else
    text << "virtual particle #" << id << " of set " << set;
  text << " at ";
  vector(s.r);
  text << " m, v = ";
  vector(s.v);
  text << " m/s, rho = " << s.rho << " kg/m^3, e = " << eos.internal_energy(s.rho, s.p)
       << " J/kg, p = " << s.p << " Pa, h = " << s.h << " m, " << neighbours
       << " neighbours; try a smaller step (--cfl or --step), or a finer or smoother initial state";
  return text.str();
}

}  // namespace sphmbs::sph
