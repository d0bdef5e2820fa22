// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <sphmbs/particles/fields.hpp>
#include <sphmbs/particles/record.hpp>
#include <sphmbs/sph/scheme.hpp>

namespace sphmbs::sph {

/// Smallest value of a limit on the step, and the particle that sets it.
struct Limit {
  double dt = std::numeric_limits<double>::infinity();  ///< [s]
  std::uint32_t id = 0;                                 ///< of the particle

  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Limit& other) {
    const bool sooner = other.dt < dt || (other.dt == dt && other.id < id);
    dt = sooner ? other.dt : dt;
    id = sooner ? other.id : id;
  }
};

/// What is learnt from one evaluation of the rates.
template <int Dim>
struct Survey {
  /// Smallest components of any particle's velocity [m/s].
  Vec<Dim> slowest = Vec<Dim>::all(std::numeric_limits<double>::infinity());
  /// Largest components of any particle's velocity [m/s].
  Vec<Dim> fastest = Vec<Dim>::all(-std::numeric_limits<double>::infinity());
  double h_rate = 0;         ///< largest rate of change of h [m/s]
  std::uint64_t pairs = 0;   ///< ordered pairs inside the support
  std::uint64_t falls = 0;   ///< of them those whose reconstruction was refused
  Vec<Dim> wall_force = {};  ///< of the gas on all virtual particles and openings [N]
  double wall_power = 0;     ///< of the gas on virtual particles and openings, sum f.v [W]
  double layer_power = 0;    ///< see RatesView; of openings heating too [W]
  Vec<Dim> momentum = {};    ///< of the gas at this stage [kg m/s]
  Limit courant;             ///< h / (c + h |div v|)
  Limit acceleration;        ///< sqrt(h / |a|)
  Limit diffusion;           ///< h^2 / (2 nu)
  /// Lowest id among particles with a rate that is not finite; the extremes above pass over a NaN.
  std::uint32_t sick = std::numeric_limits<std::uint32_t>::max();

  /// Whether there is such a particle.
  bool is_sick() const { return sick != std::numeric_limits<std::uint32_t>::max(); }

  /// Takes another one in, as `execution::reduce` asks.
  SPHMBS_INLINE void combine(const Survey& o) {
    sick = o.sick < sick ? o.sick : sick;
    for (int k = 0; k < Dim; ++k) {
      slowest[k] = math::min(slowest[k], o.slowest[k]);
      fastest[k] = math::max(fastest[k], o.fastest[k]);
    }
    h_rate = math::max(h_rate, o.h_rate);
    pairs += o.pairs;
    falls += o.falls;
    wall_force += o.wall_force;
    wall_power += o.wall_power;
    layer_power += o.layer_power;
    momentum += o.momentum;
    courant.combine(o.courant);
    acceleration.combine(o.acceleration);
    diffusion.combine(o.diffusion);
  }

  /// No two particles approach each other faster than this [m/s].
  double approach() const { return std::sqrt(norm2(fastest - slowest)); }
  /// No particle moves faster than this [m/s].
  double fastest_move() const {
    double v2 = 0;
    for (int k = 0; k < Dim; ++k) v2 += std::max(slowest[k] * slowest[k], fastest[k] * fastest[k]);
    return std::sqrt(v2);
  }
};

/// What a particle contributes to the survey.
template <class Scheme, class T>
struct SurveyParticle {
  static constexpr int dim = Scheme::dim;  ///< dimension of space
  Scheme scheme;                           ///< with the numbers of its policies
  particles::FieldsView<dim, T> fields;    ///< of all particles
  particles::RatesView<dim, T> rates;      ///< of all particles
  const T* records;                        ///< of all particles, see `particles::Record`
  double share;  ///< of one evaluation in the rates, which are a weighted sum of several [-]

  /// For particle i: the body of a loop.
  SPHMBS_INLINE Survey<dim> operator()(std::size_t i) const {
    const particles::Record<dim, T> s = particles::load_record<dim>(records, i);
    const std::uint32_t id = fields.id[i];
    const double h = static_cast<double>(s.h);
    const double rho = static_cast<double>(s.rho);
    const bool is_gas = fields.set[i] == particles::gas;
    const bool opens = particles::is_opening(fields.set[i]);
    const Vec<dim> drift =
        is_gas || opens ? share * in_double(rates.r, i) : s.v.template to<double>();
    const Vec<dim> v = in_double(opens ? rates.push : rates.v, i);
    Survey<dim> found;
    if (!finite_rates(i, opens)) found.sick = id;
    found.slowest = found.fastest = drift;
    found.h_rate = share * math::abs(static_cast<double>(rates.h[i]));
    found.pairs = rates.pairs[i];
    found.falls = rates.falls[i];
    const double divergence = math::abs(static_cast<double>(rates.rho[i])) / rho;
    found.courant = {h / (static_cast<double>(s.c) + h * divergence), id};
    const double m = static_cast<double>(s.m);
    if (is_gas) {
      found.momentum = m * s.v.template to<double>();
      found.acceleration = {math::sqrt(h / (math::sqrt(norm2(v)) + 1e-300)), id};
      if constexpr (decltype(scheme.stress)::acts)
        found.diffusion = {h * h / (2 * scheme.stress.diffusivity(scheme.eos, rho)), id};
    } else {
      found.wall_force = m * v;
      found.wall_power = m * dot(v, s.v.template to<double>());
      found.layer_power = m * static_cast<double>(opens ? rates.heating[i] : rates.r[0][i]);
    }
    return found;
  }

 private:
  // Zero times a number is zero, unless the number is not finite.
  SPHMBS_INLINE bool finite_rates(std::size_t i, bool opens) const {
    T zero = T(0) * rates.rho[i] + T(0) * rates.e[i] + T(0) * rates.h[i];
    for (int k = 0; k < dim; ++k) zero += T(0) * rates.r[k][i] + T(0) * rates.v[k][i];
    if (opens) {
      zero += T(0) * rates.heating[i];
      for (int k = 0; k < dim; ++k) zero += T(0) * rates.push[k][i];
    }
    return zero == T(0);
  }

  static SPHMBS_INLINE Vec<dim> in_double(T* const (&field)[dim], std::size_t i) {
    return particles::FieldsView<dim, T>::at(field, i).template to<double>();
  }
};

/// The length of the next step and why it is no longer.
struct StepLimit {
  double dt;                ///< [s]
  std::string_view reason;  ///< "sound", "acceleration", "diffusion" or "fixed"
  std::uint32_t id;         ///< of the particle that limits; 0 where none does
};

/// cfl times the smallest of the limits.
template <int Dim>
StepLimit step_limit(const Survey<Dim>& survey, double cfl) {
  StepLimit limit{cfl * survey.courant.dt, "sound", survey.courant.id};
  if (cfl * survey.acceleration.dt < limit.dt)
    limit = {cfl * survey.acceleration.dt, "acceleration", survey.acceleration.id};
  if (cfl * survey.diffusion.dt < limit.dt)
    limit = {cfl * survey.diffusion.dt, "diffusion", survey.diffusion.id};
  return limit;
}

}  // namespace sphmbs::sph
