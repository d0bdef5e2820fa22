// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/particles/particles.hpp>
#include <sphmbs/sph/stages.hpp>

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

/// What went wrong with a particle, what usually causes it, and what to try.
struct Finding {
  std::string_view id;      ///< of the message
  std::string what;         ///< is wrong, such as "density not positive"
  std::string_view likely;  ///< the usual cause
  std::string_view advice;  ///< what to try
};

/// One particle as it is at this stage, on the host, and how it was at the beginning of the step.
template <int Dim, class T, class Policy>
class Culprit {
 public:
  /// Fetches what is known of the particle with this id, or of another one where it is no longer
  /// there, and looks for the nearest virtual particle.
  Culprit(particles::Particles<Dim, T, Policy>& particles, std::uint32_t id) : id_(id) {
    const auto fields = particles.fields();
    const auto ids = read(fields.id, particles.size());
    auto i = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
    if (i == ids.size()) {
      i = 0;
      id_ = ids[0];
    }
    constexpr auto size = static_cast<std::size_t>(particles::record_size<Dim, T>);
    now_ = particles::load_record<Dim>(read(particles.records() + i * size, size).data(), 0);
    const auto rates = particles.rates();
    set_ = one(fields.set, i);
    rho_ = one(fields.rho, i);
    e_ = one(fields.e, i);
    h_ = one(fields.h, i);
    neighbours_ = one(rates.pairs, i);
    rho_rate_ = one(rates.rho, i);
    e_rate_ = one(rates.e, i);
    h_rate_ = one(rates.h, i);
    for (int k = 0; k < Dim; ++k) {
      r_rate_[k] = one(rates.r[k], i);
      v_rate_[k] = one(rates.v[k], i);
    }
    find_nearest(particles, ids);
  }

  /// Why its state cannot be gone on with.
  Finding state(const Admission& admission) const {
    constexpr std::string_view long_step =
        "the step is too long for the pressure, the expansion or the impact here, or the state "
        "that the run began with is wrong here";
    constexpr std::string_view shorter =
        "a smaller step (--cfl or --step), or a finer or smoother initial state";
    constexpr std::string_view spread =
        "the initial or boundary data of this particle, or of its "
        "neighbours, hold a number that is not finite, or is huge";
    for (const auto& [name, good] :
         {std::pair{"position", finite(now_.r)}, std::pair{"velocity", finite(now_.v)},
          std::pair{"mass", is_finite(now_.m)}, std::pair{"density", is_finite(now_.rho)},
          std::pair{"smoothing length", is_finite(now_.h)}})
      if (!good) return {"E301", name + std::string(" not finite"), spread, shorter};
    if (!(now_.rho > 0)) return {"E302", "density not positive", long_step, shorter};
    if (!(now_.h > 0)) return {"E304", "smoothing length not positive", long_step, shorter};
    if (!is_finite(now_.p)) return {"E301", "energy not finite", spread, shorter};
    if (!(now_.c > 0) || !is_finite(now_.c))
      return {"E303", "energy too low: the squared sound speed is not positive", long_step,
              shorter};
    const double speed = std::sqrt(norm2(now_.v.template to<double>()));
    if (set_ == particles::gas && speed > admission.fastest)
      return {"E306", "faster than the limit of " + said(admission.fastest) + " m/s", long_step,
              shorter};
    return {"E302", "density or smoothing length collapses within one step", long_step, shorter};
  }

  /// Which of its rates is not finite.
  Finding rates() const {
    std::string name = "force or heating";
    if (!finite(r_rate_)) name = "velocity of motion";
    if (!is_finite(h_rate_)) name = "rate of change of the smoothing length";
    if (!is_finite(e_rate_)) name = "rate of change of the energy";
    if (!is_finite(rho_rate_)) name = "rate of change of the density";
    if (!finite(v_rate_)) name = "acceleration";
    return {"E305", name + " not finite",
            "the states of this particle and of a neighbour are too far apart for the Riemann "
            "solver, or lie at one point",
            "a smaller step (--cfl or --step), first-order reconstruction, or another initial "
            "arrangement of the particles"};
  }

  /// One line on who and where it is, and in what state.
  template <class Eos>
  std::string text(const Eos& eos) const {
    std::ostringstream text;
    text.precision(6);
    if (set_ == particles::gas)
      text << "gas particle #" << id_;
    else if (particles::is_opening(set_))
      text << "particle #" << id_ << " of opening " << particles::opening_of(set_);
    else
      text << "virtual particle #" << id_ << " of set " << static_cast<int>(set_);
    text << " at ";
    vector(text, now_.r);
    text << " m, v = ";
    vector(text, now_.v);
    text << " m/s, rho = ";
    change(text, rho_, now_.rho);
    text << " kg/m^3, e = ";
    change(text, e_, eos.internal_energy(now_.rho, now_.p));
    text << " J/kg, p = " << now_.p << " Pa, h = ";
    change(text, h_, now_.h);
    text << " m, " << neighbours_ << " neighbours";
    if (nearest_set_ > 0)
      text << "; nearest virtual particle: #" << nearest_id_ << " of set " << nearest_set_ << ", "
           << nearest_ << " h away";
    return text.str();
  }

 private:
  template <class U>
  static std::vector<U> read(const U* field, std::size_t n) {
    std::vector<U> value(n);
    Policy::download(value.data(), field, n * sizeof(U));
    return value;
  }
  template <class U>
  static U one(const U* field, std::size_t i) {
    return read(field + i, 1)[0];
  }
  static bool finite(const Vec<Dim, T>& x) {
    bool all = true;
    for (int k = 0; k < Dim; ++k) all = all && is_finite(x[k]);
    return all;
  }
  static std::string said(double x) {
    std::ostringstream text;
    text << x;
    return text.str();
  }
  static void vector(std::ostringstream& text, const Vec<Dim, T>& x) {
    text << "(";
    for (int k = 0; k < Dim; ++k) text << (k > 0 ? ", " : "") << x[k];
    text << ")";
  }
  static void change(std::ostringstream& text, T before, T now) {
    if (std::abs(now - before) > T(1e-3) * std::abs(before)) text << before << " -> ";
    text << now;
  }

  // Of the places at the beginning of the step, images across periodic sides left out.
  void find_nearest(particles::Particles<Dim, T, Policy>& particles,
                    const std::vector<std::uint32_t>& ids) {
    const auto fields = particles.fields();
    const auto sets = read(fields.set, ids.size());
    std::vector<T> squares(ids.size());
    for (int k = 0; k < Dim; ++k) {
      const auto x = read(fields.r[k], ids.size());
      for (std::size_t i = 0; i < x.size(); ++i)
        squares[i] += (x[i] - now_.r[k]) * (x[i] - now_.r[k]);
    }
    T least = std::numeric_limits<T>::max();
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (!particles::is_virtual(sets[i]) || ids[i] == id_ || !(squares[i] <= least)) continue;
      if (squares[i] == least && nearest_set_ > 0 && ids[i] > nearest_id_) continue;
      least = squares[i];
      nearest_id_ = ids[i];
      nearest_set_ = sets[i];
    }
    nearest_ = std::sqrt(least) / h_;
  }

  std::uint32_t id_;
  particles::Record<Dim, T> now_{};
  std::uint8_t set_{};
  T rho_{}, e_{}, h_{}, rho_rate_{}, e_rate_{}, h_rate_{};
  Vec<Dim, T> r_rate_{}, v_rate_{};
  int neighbours_{};
  std::uint32_t nearest_id_ = 0;
  int nearest_set_ = 0;
  T nearest_{};  // [h]
};

/// The failure that a finding about a particle is.
/// @param who  Culprit::text, or empty
inline NumericalFailure failure_of(const Finding& found, const Moment& moment, std::uint32_t id,
                                   const std::string& who) {
  std::ostringstream text;
  text.precision(6);
  text << found.what << " at step " << moment.step << ", t = " << moment.time
       << " s (dt = " << moment.dt << " s)";
  if (!who.empty()) text << "\n  " << who;
  text << "\n  likely: " << found.likely << "\n  try: " << found.advice;
  return NumericalFailure(text.str(), found.id, {id});
}

}  // namespace sphmbs::sph
