// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

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
  static constexpr int dim = Scheme::dim;
  using Eos = decltype(Scheme::eos);

  Openings() = default;

  /// @throws InvalidInput for a zone less deep than gas sees, or across a periodic axis.
  Openings(const Scheme& scheme, const geometry::Domain<dim>& domain,
           const particles::Cloud<dim>& cloud)
      : next_id_(static_cast<std::uint32_t>(cloud.size())), traffic_(cloud.openings.size()) {
    double h_max = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (!particles::is_opening(cloud.set[i])) continue;
      ++particle_count_;
      h_max = std::max(h_max, cloud.h[i]);
      tolerance_ = tolerance_ > 0 ? std::min(tolerance_, 0.25 * cloud.h[i]) : 0.25 * cloud.h[i];
    }
    std::vector<particles::OpeningView<dim, T>> seen;
    for (const particles::Opening<dim>& o : cloud.openings) {
      expects(!domain.periodic[static_cast<std::size_t>(o.axis)], "axis of an opening", o.axis,
              "one along which the domain is not periodic");
      expects(o.length() > Scheme::Kernel::support * h_max, "depth of an opening's zone",
              o.length(),
              "more than the support radius, " + std::to_string(Scheme::Kernel::support * h_max) +
                  " m");
      seen.push_back({o.lower.template to<T>(), o.upper.template to<T>(), o.axis,
                      static_cast<T>(o.side), static_cast<T>(o.distance), static_cast<T>(o.spacing),
                      static_cast<T>(o.far.rho), static_cast<T>(o.far.p),
                      static_cast<T>(scheme.eos.internal_energy(o.far.rho, o.far.p)),
                      o.far.v.template to<T>()});
    }
    if (!seen.empty()) views_ = View(seen);
  }

  /// Particles in all zones.
  std::size_t particle_count() const { return particle_count_; }
  const std::vector<Traffic<dim>>& traffic() const { return traffic_; }

  /// k = keep k + f(stage) for the openings' particles.
  void rates(const geometry::Periodicity<dim, T>& space, const neighbours::NeighbourView& lists,
             particles::Particles<dim, T, Policy>& particles, T keep, T border) const {
    if (traffic_.empty()) return;
    Policy::for_each(particles.size(), EvaluateOpening<Scheme, T, Policy::template lanes<T>>{
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
  Traffic<dim> pass(const Eos& eos, particles::Particles<dim, T, Policy>& particles) {
    using Counts = execution::Field<std::uint32_t, Policy>;
    way_ = 0;
    const std::size_t n = particles.size();
    const detail::OpeningsView<dim, T> openings{views_.data(), static_cast<int>(traffic_.size())};
    execution::Field<detail::Fate, Policy> fate(n);
    Counts copies(n), follows(n), first(n + 1), rank(n + 1);
    Policy::for_each(n, detail::Pass<dim, T, Eos>{eos, particles.fields(), openings, fate.data(),
                                                  copies.data(), follows.data()});
    Traffic<dim> all;
    for (std::size_t k = 0; k < traffic_.size(); ++k) {
      const auto passed = execution::reduce<Policy>(
          n, Traffic<dim>{},
          detail::CountPassage<dim, T>{particles.fields(), fate.data(), static_cast<int>(k)});
      traffic_[k].combine(passed);
      all.combine(passed);
    }
    const std::size_t now = execution::exclusive_scan<Policy>(n, copies.data(), first.data());
    const std::size_t followers = execution::exclusive_scan<Policy>(n, follows.data(), rank.data());
    particle_count_ += now - n + all.out.particles - all.in.particles;
    if (now == n && followers == 0 && all.in.particles == 0) return all;
    Counts order(now);
    Policy::for_each(n, detail::Copy{copies.data(), first.data(), order.data()});
    particles.select(order.data(), now);
    Policy::for_each(now,
                     detail::Follow<dim, T, Eos>{eos, particles.fields(), openings, order.data(),
                                                 fate.data(), rank.data(), first.data(), next_id_});
    next_id_ += static_cast<std::uint32_t>(followers);
    return all;
  }

 private:
  using View = execution::Field<particles::OpeningView<dim, T>, Policy>;

  View views_;
  std::uint32_t next_id_ = 0;
  std::size_t particle_count_ = 0;
  double tolerance_ = 0;  // how far particles may be beyond a face before they pass [m]
  double way_ = 0;        // how far they may have gone since they last passed [m]
  std::vector<Traffic<dim>> traffic_;
};

}  // namespace sphmbs::sph
