// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/execution/default.hpp>
#include <sphmbs/execution/reduce.hpp>
#include <sphmbs/neighbours/cell_list.hpp>
#include <sphmbs/sph/diagnosis.hpp>
#include <sphmbs/sph/escape.hpp>
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
  ///         positive, or particles could move by more than they reach. The step can be undone.
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
      fail(too_far("bodies go too far within the iterations of a step"), survey_.courant.id, dt);
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
  /// @throws NumericalFailure naming a particle with a rate that is not finite.
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
    judged_ = false;
    if (survey_.is_sick()) {
      // A number that is not finite makes the rates of all around it so: who had it is named.
      const std::uint32_t origin = culprit_of<Policy>(
          SickRecord<dim, T>{particles_.records(), particles_.fields().id, culprit_.data()},
          culprit_, size());
      if (origin != nobody) fail_for_state(origin, staged_);
      const CulpritType culprit(particles_, survey_.sick);
      fail(culprit.rates(), survey_.sick, staged_, culprit.text(scheme_.eos));
    }
    exchange_.evaluated(survey_, gas_mass_, scheme_.acceleration, keep);
    lists_.moving(survey_.approach() + Scheme::Kernel::support * survey_.h_rate);
  }

  /// Judges y + scale k at time() + dt before it replaces y; `commit` does so itself.
  /// @throws NumericalFailure naming a particle that would not be physical; y is as it was.
  void admit(double scale, double dt) {
    if (judged_) return;
    judged_ = true;
    const auto timer = statistics_.time(Phase::update);
    const JudgeUpdate<Scheme, T, Motion> judge{
        advance(scale, dt), scheme_, static_cast<T>(admission_.least),
        admission_.fastest * admission_.fastest, culprit_.data()};
    const std::uint32_t id = culprit_of<Policy>(judge, culprit_, size());
    if (id == nobody) return;
    write_records(scale, dt);  // for the message, if it does not fail itself
    fail_for_state(id, dt);
  }

  /// Back to the state y after something failed: from its first stage to its commit a step can be
  /// undone.
  void undo() {
    lists_.undo(before_.lists);
    exchange_ = before_.exchange;
    judged_ = slopes_known_ = false;
    ++statistics_.retries;
  }

  /// y = y + scale k, and the time goes on by dt.
  /// @throws NumericalFailure as `admit` does; BeyondModel where gas has left the domain that must
  ///         not, then the step has been taken.
  void commit(double scale, double dt) {
    admit(scale, dt);
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
    const bool anew = lists_.outdated(0);
    if (openings_.moved(survey_.fastest_move() * dt, anew)) let_pass();
    if (anew && domain_.escape == geometry::Escape::remove) remove_escaped();
    before_ = {lists_, exchange_};
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

  /// What has left the domain and was removed, with Escape::remove.
  const Passed<dim>& escaped() const { return escaped_; }
  /// Gas particles that there should be: those of the start, and what came in less what was lost.
  std::uint64_t gas_accounted() const {
    std::uint64_t n = gas_at_start_ - escaped_.particles;
    for (const Traffic<dim>& t : traffic()) n += t.in.particles - t.out.particles;
    return n;
  }

  /// What an update may do to particles.
  Admission& admission() { return admission_; }

  /// A line on a particle at the last stage. @param id  of a particle that is there
  std::string describe(std::uint32_t id) { return CulpritType(particles_, id).text(scheme_.eos); }

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
    archive("escaped", escaped_);
    archive("statistics", statistics_);
    if constexpr (A::restores) {
      vicinities_.resize(size());
      before_ = {lists_, exchange_};
    }
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
    staged_ = dt;
    const std::uint32_t culprit = culprit_of<Policy>(
        WriteRecords<Scheme, T, Motion>{advance(scale, dt), scheme_, places_, particles_.records(),
                                        vicinities_.data(), culprit_.data()},
        culprit_, size());
    if (culprit != nobody) fail_for_state(culprit, dt);
  }

  // Gas moves by less than a skin between two lists.
  void remove_escaped() {
    const Outside<dim> found = outside<Policy>(particles_, domain_);
    if (found.passed.particles == 0) return;
    if (found.passed.particles == gas_count_) escape("and all others have left it", found.id);
    remove_outside<Policy>(particles_, domain_);
    escaped_.combine(found.passed);
    gas_count_ -= found.passed.particles;
    gas_mass_ -= found.passed.mass;
    vicinities_.resize(size());
    lists_.forget();
  }

  void look_for_escaped() {
    const Outside<dim> found = outside<Policy>(particles_, domain_);
    if (!(found.lengths <= far))
      escape("is " + std::to_string(found.lengths) + " lengths of it outside", found.farthest);
    if (domain_.escape == geometry::Escape::error && found.passed.particles > 0)
      escape("is outside", found.id);
  }

  [[noreturn]] void escape(const std::string& how, std::uint32_t id) {
    throw BeyondModel("gas leaves the domain at step " + std::to_string(statistics_.steps) +
                          ", t = " + std::to_string(time_) + " s: particle #" + std::to_string(id) +
                          " " + how +
                          "\n  likely: a wall has a hole or is too thin, or the gas is meant to "
                          "leave\n  try: a larger domain, walls of more layers, an opening, or "
                          "Escape::remove",
                      "E309", {id});
  }

  void rebuild_lists(double dt) {
    const auto timer = statistics_.time(Phase::neighbours);
    look_for_escaped();
    ++statistics_.rebuilds;
    const Largest widest = widest_particle<Policy>(particles_);
    const auto reach = lists_.plan(dim, Scheme::Kernel::support, widest.h, dt);
    if (!space_.fits(2 * reach.support * widest.h))
      fail({"E308", "a period is shorter than two support radii",
            "the gas expands until it sees itself around the periodic side",
            "a longer period, or a finer gas"},
           widest.id, dt);
    if (!(reach.skin <= reach.support * widest.h))
      fail(too_far("particles may pass each other unseen within this step"), survey_.courant.id,
           dt);
    search_.rebuild(particles_, domain_, reach);
  }

  using CulpritType = Culprit<dim, T, Policy>;

  static Finding too_far(std::string what) {
    return {"E307", std::move(what), "the step is too long for the fastest motion",
            "a smaller step (--cfl or --step), or a finer or smoother initial state"};
  }
  [[noreturn]] void fail_for_state(std::uint32_t id, double dt) {
    const CulpritType culprit(particles_, id);
    fail(culprit.state(admission_), id, dt, culprit.text(scheme_.eos));
  }
  [[noreturn]] void fail(const Finding& found, std::uint32_t id, double dt) {
    fail(found, id, dt, describe(id));
  }
  [[noreturn]] void fail(const Finding& found, std::uint32_t id, double dt,
                         const std::string& who) {
    throw failure_of(found, moment_of_stage(statistics_.steps, time_, dt, last_dt_), id, who);
  }

  struct Before {
    ListSchedule lists;
    Exchange<dim> exchange;
  };
  static constexpr double far = 1e3;  // in lengths of the domain, from where cells make no sense

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
  Before before_;  // this step
  Admission admission_;
  Passed<dim> escaped_;
  std::uint64_t gas_at_start_ = gas_count_;
  double staged_ = 0;    // time of the stage less that of the state [s]
  bool judged_ = false;  // the update with these rates
};

}  // namespace sphmbs::sph
