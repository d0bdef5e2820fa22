// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/execution/scan.hpp>
#include <sphmbs/particles/particles.hpp>
#include <sphmbs/sph/characteristics.hpp>
#include <sphmbs/sph/passage.hpp>

namespace sphmbs::sph {

/// The openings of a gas: the rates of their particles, and the passing of particles.
template <class Scheme, class T, execution::ExecutionPolicy Policy>
class Openings {
 public:
  static constexpr int dim = Scheme::dim;       ///< dimension of space
  using Eos = decltype(Scheme::eos);            ///< equation of state of the gas
  using Space = geometry::Periodicity<dim, T>;  ///< periodic axes

  /// @throws InvalidInput for a zone less deep than gas sees, across a periodic axis, beyond a
  ///         periodic border, with other particles in it or without gas before its face, and for
  ///         openings of a gas with a body force.
  Openings(const Scheme& scheme, const geometry::Domain<dim>& domain,
           const particles::Cloud<dim>& cloud)
      : next_id_(cloud.size()), traffic_(cloud.openings.size()) {
    check(scheme, domain, cloud);
    measure(cloud);
    std::vector<particles::OpeningView<dim, T>> seen;
    for (const particles::Opening<dim>& o : cloud.openings) {
      const auto number = [](double x) { return static_cast<T>(x); };
      const double spacing = o.resolution.spacing;
      particles::OpeningView<dim, T> view{
          .lower = o.lower.template to<T>(),
          .upper = o.upper.template to<T>(),
          .axis = o.axis,
          .side = number(o.side),
          .distance = number(o.distance),
          .spacing = number(spacing),
          .h = number(o.resolution.smoothing_ratio * spacing),
          .m = number(o.far.rho * math::power<dim>(spacing)),
          .rho = number(o.far.rho),
          .p = number(o.far.p),
          .e = number(scheme.eos.internal_energy(o.far.rho, o.far.p)),
          .c = number(scheme.eos.sound_speed(o.far.rho, o.far.p)),
          .v = o.far.v.template to<T>()};
      if (view.along(view.v) < T(0)) view.v[o.axis] = T(0);
      seen.push_back(view);
    }
    if (!seen.empty()) views_ = View(seen);
  }

  /// Particles in all zones.
  std::size_t particle_count() const { return particle_count_; }
  /// What has passed each opening since the start.
  const std::vector<Traffic<dim>>& traffic() const { return traffic_; }

  /// k = keep k + f(stage) for the openings' particles.
  void rates(const Scheme& scheme, const Space& space, const neighbours::NeighbourView& lists,
             particles::Particles<dim, T, Policy>& particles, T keep, T border) const {
    if (traffic_.empty()) return;
    Policy::for_each(particles.size(), EvaluateOpening<Scheme, T, Policy::template lanes<T>>{
                                           scheme.eos,
                                           space,
                                           {lists, particles.records(), nullptr},
                                           views_.data(),
                                           particles.fields().set,
                                           particles.rates(),
                                           keep,
                                           border});
  }

  /// A step was taken in which no particle moved by more than `way` [m]. True when particles are to
  /// pass: some may be a quarter of their smoothing length beyond a face, or `lists` are made anew.
  bool moved(double way, bool lists) {
    way_ += way;
    return !traffic_.empty() && (lists || way_ > tolerance_);
  }

  /// Lets particles pass, and returns what came in and went out.
  /// @throws NumericalFailure when more particles came in than can be told apart.
  Traffic<dim> pass(const Eos& eos, const Space& space, const neighbours::NeighbourView& lists,
                    particles::Particles<dim, T, Policy>& particles) {
    using Counts = execution::Field<std::uint32_t, Policy>;
    way_ = 0;
    const std::size_t n = particles.size();
    execution::Field<detail::Fate, Policy> fate(n);
    Counts copies(n), follows(n), first(n + 1), rank(n + 1);
    detail::Pass<dim, T, Eos> pass{eos,           space,
                                   lists,         particles.fields(),
                                   views_.data(), static_cast<int>(traffic_.size()),
                                   fate.data(),   copies.data(),
                                   follows.data()};
    Policy::for_each(n, pass);
    Traffic<dim> all;
    for (std::size_t k = 0; k < traffic_.size(); ++k) {
      const auto passed = execution::reduce<Policy>(
          n, Traffic<dim>{}, detail::CountPassage<dim, T, Eos>{pass, static_cast<int>(k)});
      traffic_[k].combine(passed);
      all.combine(passed);
    }
    const std::size_t now = execution::exclusive_scan<Policy>(n, copies.data(), first.data());
    const std::size_t followers = execution::exclusive_scan<Policy>(n, follows.data(), rank.data());
    particle_count_ += now - n + all.out.particles - all.in.particles;
    if (next_id_ + followers >= std::numeric_limits<std::uint32_t>::max())
      throw NumericalFailure(
          "more than 2^32 - 1 particles came in by openings; run on from the "
          "present state as a new start",
          "E312");
    Counts order(now);
    Policy::for_each(n, detail::Copy{copies.data(), first.data(), order.data()});
    particles.select(order.data(), now);
    pass.fields = particles.fields();
    Policy::for_each(now, detail::Become<dim, T, Eos>{pass, order.data(), first.data(), rank.data(),
                                                      static_cast<std::uint32_t>(next_id_)});
    next_id_ += followers;
    return all;
  }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    archive("next_id", next_id_);
    archive("particle_count", particle_count_);
    archive("way", way_);
    archive("traffic", traffic_);
  }

 private:
  using View = execution::Field<particles::OpeningView<dim, T>, Policy>;

  void measure(const particles::Cloud<dim>& cloud) {
    tolerance_ = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (!particles::is_virtual(cloud.set[i]))
        tolerance_ = std::min(tolerance_, 0.25 * cloud.h[i]);
      if (particles::is_opening(cloud.set[i])) ++particle_count_;
    }
  }

  static void check(const Scheme& scheme, const geometry::Domain<dim>& domain,
                    const particles::Cloud<dim>& cloud) {
    if (cloud.openings.empty()) return;
    for (int k = 0; k < dim; ++k)
      expects(scheme.acceleration[k] == 0, "acceleration of a gas with openings",
              scheme.acceleration[k], "0: far gas has no weight");
    double h_max = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (!particles::is_virtual(cloud.set[i])) h_max = std::max(h_max, cloud.h[i]);
    const double support = Scheme::Kernel::support * h_max;
    for (std::size_t k = 0; k < cloud.openings.size(); ++k) {
      const particles::Opening<dim>& o = cloud.openings[k];
      for (int axis = 0; axis < dim; ++axis) {
        if (!domain.periodic[static_cast<std::size_t>(axis)]) continue;
        expects(axis != o.axis, "axis of an opening", axis,
                "one along which the domain is not periodic");
        expects(o.lower[axis] >= domain.box.lower[axis] && o.upper[axis] <= domain.box.upper[axis],
                "lower corner of an opening's zone", o.lower[axis],
                "so that the zone lies in the periodic box [m]");
      }
      expects(o.length() > support, "depth of an opening's zone", o.length(),
              "more than the support radius of the gas, " + std::to_string(support) + " m");
      const std::uint8_t own = particles::opening_set(static_cast<int>(k));
      particles::Opening<dim> front = o;  // what the face opens to
      (o.side > 0 ? front.upper : front.lower)[o.axis] += o.side * support;
      (o.side > 0 ? front.lower : front.upper)[o.axis] += o.side * o.length();
      std::size_t met = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        met += cloud.set[i] == particles::gas && front.holds(cloud.r[i], 0) ? 1 : 0;
        expects(cloud.set[i] == own || !o.holds(cloud.r[i], 1e-6 * o.resolution.spacing),
                "set of a particle in the zone of opening " + std::to_string(k),
                static_cast<int>(cloud.set[i]), "the opening's own: gas lies beyond its face");
      }
      expects(met > 0, "gas in front of opening " + std::to_string(k), met,
              "some particles within a support radius: its side is that of the gas");
    }
  }

  View views_;
  std::size_t next_id_ = 0;
  std::size_t particle_count_ = 0;
  double tolerance_ = 0;  // how far particles may be beyond a face before they pass [m]
  double way_ = 0;        // how far they may have gone since they last passed [m]
  std::vector<Traffic<dim>> traffic_;
};

}  // namespace sphmbs::sph
