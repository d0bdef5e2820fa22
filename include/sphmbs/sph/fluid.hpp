// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/execution/default.hpp>
#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/neighbours/cell_list.hpp>
#include <sphmbs/sph/diagnosis.hpp>
#include <sphmbs/sph/exchange.hpp>
#include <sphmbs/sph/follow.hpp>
#include <sphmbs/sph/interpolate.hpp>
#include <sphmbs/sph/list_schedule.hpp>
#include <sphmbs/sph/openings.hpp>
#include <sphmbs/sph/statistics.hpp>
#include <sphmbs/sph/survey.hpp>
#include <sphmbs/sph/totals.hpp>
#include <sphmbs/sph/vicinities.hpp>
#include <sphmbs/time/integrator.hpp>

namespace sphmbs::sph {

/// A compressible gas and the virtual particles around it: particles, their neighbours, and the
/// equations that move them. A time::ExplicitSystem.
/// @tparam Scheme  RiemannSph<...>: kernel, Riemann solver, equation of state, ...
/// @tparam Policy  where loops run
/// @tparam Motion  prescribed motion of the virtual particles
/// @tparam T       floating-point type of the fields
template <class Scheme, execution::ExecutionPolicy Policy = execution::Default,
          class Motion = boundary::Fixed, class T = double>
class Fluid {
 public:
  static constexpr int dim = Scheme::dim;               ///< dimension of space
  using SchemeType = Scheme;                            ///< the scheme
  using PolicyType = Policy;                            ///< where loops run
  using NumberType = T;                                 ///< of the fields, double or float
  using Search = neighbours::CellList<dim, T, Policy>;  ///< how neighbours are found

  /// Takes the cloud and gives its memory back: move it in where particles are many.
  /// @throws InvalidInput for an empty cloud, parameters out of range, or a periodic axis shorter
  ///         than two support radii.
  Fluid(const Scheme& scheme, const geometry::Domain<dim>& domain, particles::Cloud<dim> cloud,
        const Motion& motion = {}, Policy = {})
      : scheme_(scheme),
        domain_(domain),
        motion_(motion),
        space_(domain.template periodicity<T>()),
        places_(domain.template periodicity<double>()),
        particles_((domain.wrap(cloud.r), cloud),
                   [&](double rho, double p) { return scheme.eos.internal_energy(rho, p); }),
        openings_(scheme, domain, cloud),
        gas_count_(cloud.gas_count()),
        gas_mass_(cloud.gas_mass()) {
    static_assert(boundary::Motion<Motion, Vec<dim>> && boundary::Motion<Motion, Vec<dim, T>> &&
                  time::ExplicitSystem<Fluid>);
    static_assert(neighbours::NeighbourSearch<Search, dim, T, Policy>);
    scheme.check();
    domain.check();
    if constexpr (Scheme::Wall::surfaces) cloud.require_surfaces();
    vicinities_.resize(size());
    neighbours::check_reach(
        domain, {Scheme::Kernel::support, 0, *std::max_element(cloud.h.begin(), cloud.h.end())});
  }

  /// Goes to the stage y + scale k at time() + dt.
  /// @throws NumericalFailure naming a particle, its place and its state where the state at this
  ///         stage is not finite, or density, smoothing length or squared sound speed is not
  ///         positive, or particles could move by more than they reach.
  /// @param slack  how far `follow` may move virtual particles from where they are then [m]
  void stage(double scale, double dt, double slack = 0) {
    slopes_known_ = false;
    write_records(scale, dt);
    lists_.staged(dt, motion_surplus<Policy>(advance(0, dt), places_, size()) + 2 * slack);
    if (!lists_.outdated(dt)) return;
    rebuild_lists(dt);
    write_records(scale, dt);
  }

  /// Particles that ride on bodies go where their motion has them at time() + dt by now, and the
  /// forces on them are evaluated, while the gas stays at the stage that is evaluated there.
  /// @throws NumericalFailure where that is further than the stage's slack.
  void follow(double dt) {
    const auto to = advance(0, dt);
    if (motion_surplus<Policy>(to, places_, size()) > lists_.surplus())
      fail("bodies go too far within the iterations of a step", step_limit(survey_, 1).id, dt);
    Policy::for_each(size(), FollowMotion<Scheme, T, Motion>{to, places_, particles_.records(),
                                                             vicinities_.data()});
    if constexpr (Scheme::Wall::evolves) slopes_known_ = false;  // they see where walls are
    evaluate_slopes();
    const auto timer = statistics_.time(Phase::rates);
    Policy::for_each(size(), EvaluateRiding{to, evaluation(0)});
  }
  /// Motion of the virtual particles; what moves them may change it between stages.
  Motion& motion() { return motion_; }

  /// k = keep k + f(stage).
  void rates(double keep) {
    evaluate_slopes();
    {
      const auto timer = statistics_.time(Phase::rates);
      const auto evaluate = evaluation(keep);
      Policy::for_each(size(), evaluate);
      openings_.rates(scheme_, space_, search_.whole(), particles_, evaluate.keep, evaluate.border);
    }
    const auto timer = statistics_.time(Phase::survey);
    weight_ = keep * weight_ + 1;
    survey_ = execution::reduce<Policy>(
        size(), Survey<dim>{},
        SurveyParticle<Scheme, T>{scheme_, particles_.fields(), particles_.rates(),
                                  particles_.records(), 1 / weight_});
    statistics_.evaluated(survey_.pairs, survey_.falls);
    exchange_.evaluated(survey_, gas_mass_, scheme_.acceleration, keep);
    lists_.moving(survey_.approach() + Scheme::Kernel::support * survey_.h_rate);
  }

  /// y = y + scale k, and the time goes on by dt.
  void commit(double scale, double dt) {
    const double surplus = motion_surplus<Policy>(advance(0, dt), places_, size());
    {
      const auto timer = statistics_.time(Phase::update);
      Policy::for_each(size(), CommitStep<Scheme, T, Motion>{advance(scale, dt), places_});
    }
    time_ += dt;
    last_dt_ = dt;
    exchange_.committed(scale);
    ++statistics_.steps;
    lists_.stepped(dt, surplus);
    if (openings_.moved(survey_.fastest_move() * dt, lists_.outdated(0))) let_pass();
  }

  double time() const { return time_; }  ///< of the state y [s]
  /// Number of all particles.
  std::size_t size() const { return particles_.size(); }
  /// Number of gas particles; with openings it changes.
  std::size_t gas_count() const { return gas_count_; }
  std::size_t opening_count() const { return openings_.particle_count(); }  ///< in their zones
  /// Number of virtual particles.
  std::size_t virtual_count() const { return size() - gas_count_ - opening_count(); }
  /// As given at the start.
  const Scheme& scheme() const { return scheme_; }
  /// As given at the start.
  const geometry::Domain<dim>& domain() const { return domain_; }

  /// What the last evaluation of the rates found.
  const Survey<dim>& survey() const { return survey_; }
  /// Counts and times since the start.
  const Statistics& statistics() const { return statistics_; }
  /// What the gas has received from walls, bodies and the body force.
  const Exchange<dim>& exchange() const { return exchange_; }

  /// What has passed each opening, in the order they were added. Particles pass in groups, at about
  /// a quarter of the smallest smoothing length beyond the face.
  std::span<const Traffic<dim>> traffic() const { return openings_.traffic(); }

  /// Sums over the state y.
  Totals<dim> totals() {
    return execution::reduce<Policy>(size(), Totals<dim>{},
                                     TotalsOfParticle<dim, T>{particles_.fields()});
  }

  /// Force of the gas on a set of virtual particles at the last evaluation of the rates [N].
  /// @throws InvalidInput unless the number is that of a set of virtual particles, 1 to 191.
  Vec<dim> force_on(int set) {
    expects(set >= 1 && set < particles::first_opening, "set of virtual particles", set,
            "1 to 191");
    const ForceOnParticle<dim, T> force{particles_.fields(), particles_.rates(),
                                        static_cast<std::uint8_t>(set)};
    return execution::reduce<Policy>(size(), Force<dim>{}, force).f;
  }

  /// The gas at a point, at the last stage.
  Sample<dim> sample(const Vec<dim>& x) {
    return execution::reduce<Policy>(size(), WeightedSum<dim>{},
                                     WeighAtPoint<typename Scheme::Kernel, T>{
                                         particles_.records(), space_, x.template to<T>()})
        .sample();
  }

  /// The particles, for reading and for setting initial fields. Positions must not be changed after
  /// the first stage.
  particles::Particles<dim, T, Policy>& particles() { return particles_; }

  /// See Vicinities; from an evaluation of the rates to the end of the step.
  const T* vicinities() const { return vicinities_.data(); }

  /// Between steps.
  template <Archive A>
  void visit_state(A& archive) {
    archive("time", time_);
    archive("last_dt", last_dt_);
    archive("gas_count", gas_count_);
    archive("gas_mass", gas_mass_);
    archive("particles", particles_);
    archive("openings", openings_);
    archive("neighbours", search_);
    archive("lists", lists_);
    archive("exchange", exchange_);
    archive("statistics", statistics_);
    if constexpr (A::restores) vicinities_.resize(size());
  }

  /// Memory that particles and lists take where loops run [bytes].
  std::size_t bytes() { return particles_.bytes() + search_.bytes() + vicinities_.bytes(); }

 private:
  void let_pass() {
    const auto timer = statistics_.time(Phase::neighbours);
    const Traffic<dim> passed = openings_.pass(scheme_.eos, space_, search_.whole(), particles_);
    gas_count_ += passed.in.particles - passed.out.particles;
    gas_mass_ += passed.in.mass - passed.out.mass;
    vicinities_.resize(size());
    lists_.forget();
  }

  Advance<Scheme, T, Motion> advance(double scale, double dt) {
    return {particles_.fields(), particles_.rates(), motion_, static_cast<T>(scale), time_, dt};
  }

  EvaluateRates<Scheme, T, Policy::template lanes<T>> evaluation(double keep) {
    return {scheme_,
            space_,
            {search_.view(), particles_.records(), vicinities_.data()},
            particles_.fields().set,
            particles_.rates(),
            static_cast<T>(keep),
            static_cast<T>(lists_.reach().largest())};
  }

  void evaluate_slopes() {
    if (slopes_known_) return;
    slopes_known_ = true;
    const auto timer = statistics_.time(Phase::slopes);
    vicinities_.evaluate(evaluation(0), size());
  }

  void write_records(double scale, double dt) {
    const auto timer = statistics_.time(Phase::update);
    using Write = WriteRecords<Scheme, T, Motion>;
    const std::uint32_t culprit =
        write_all<Policy>(Write{advance(scale, dt), scheme_, places_, particles_.records(),
                                vicinities_.data(), culprit_.data()},
                          culprit_, size());
    if (culprit != Write::nobody) fail("state not finite or not physical", culprit, dt);
  }

  void rebuild_lists(double dt) {
    const auto timer = statistics_.time(Phase::neighbours);
    ++statistics_.rebuilds;
    const Largest widest = widest_particle<Policy>(particles_);
    const auto reach = lists_.plan(dim, Scheme::Kernel::support, widest.h, dt);
    if (!space_.fits(2 * reach.support * widest.h))
      fail("a period is shorter than two support radii", widest.id, dt);
    if (reach.skin > reach.support * widest.h)
      fail("particles may pass each other unseen within this step", step_limit(survey_, 1).id, dt);
    search_.rebuild(particles_, domain_, reach);
  }

  [[noreturn]] void fail(std::string_view what, std::uint32_t id, double dt) {
    const Moment moment = moment_of_stage(statistics_.steps, time_, dt, last_dt_);
    throw NumericalFailure(describe_culprit<Policy>(particles_, scheme_.eos, what, id, moment));
  }

  Scheme scheme_;
  geometry::Domain<dim> domain_;
  Motion motion_;
  geometry::Periodicity<dim, T> space_;
  geometry::Periodicity<dim, double> places_;  // the same, for positions in full
  particles::Particles<dim, T, Policy> particles_;
  Openings<Scheme, T, Policy> openings_;
  std::size_t gas_count_;
  double gas_mass_;  // [kg]
  Search search_;
  ListSchedule lists_;
  Survey<dim> survey_;
  Statistics statistics_;
  execution::Field<std::uint32_t, Policy> culprit_{1};
  Vicinities<Scheme, T, Policy> vicinities_;
  double time_ = 0;
  double last_dt_ = 0;
  double weight_ = 0;          // of all evaluations in the rates
  bool slopes_known_ = false;  // of this stage
  Exchange<dim> exchange_;
};

}  // namespace sphmbs::sph
