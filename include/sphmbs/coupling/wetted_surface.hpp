// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/coupling/point_rows.hpp>
#include <sphmbs/coupling/riding.hpp>
#include <sphmbs/execution/default.hpp>
#include <sphmbs/execution/field.hpp>
#include <sphmbs/particles/particles.hpp>

namespace sphmbs::coupling {

/// Writes the force of gas on each virtual particle that rides on a body [N].
template <int Dim, class T, class Motion>
struct ReadForce {
  particles::FieldsView<Dim, T> fields;  ///< of all particles
  particles::RatesView<Dim, T> rates;    ///< of all particles
  Motion motion;                         ///< which of the particles ride
  Vec<Dim>* force;                       ///< of the gas on each riding particle, by its number [N]

  /// For particle i: the body of a loop.
  SPHMBS_INLINE void operator()(std::size_t i) const {
    const boundary::Mark mark{fields.set[i], fields.id[i]};
    if (!particles::is_virtual(fields.set[i]) || !motion.rides(mark)) return;
    force[motion.number(mark)] =
        static_cast<double>(fields.m[i]) *
        particles::FieldsView<Dim, T>::at(rates.v, i).template to<double>();
  }
};

/// The surface between gas and a structure: sets of virtual particles that ride on material points
/// of its bodies. It tells the gas where they go and the structure what the gas does to them.
///
/// A force f on a particle at r(q) is the generalized force (dr/dq)^T f, so that force, moment and
/// power are the same on both sides. Where gas sticks to the bodies it meets the velocity of the
/// surface before a particle, and the force acts there: then force and power are the same, and the
/// moment up to that of the rubbing over the particle's depth.
///
///   coupling::WettedSurface<2> surface;
///   surface.tie(cloud, set, coupling::points_of(body, mechanism.q(), cloud, set), mechanism.q());
///   sph::Fluid<Gas, Policy, coupling::Riding<2>> fluid(gas, domain, cloud, surface.motion());
template <int Dim, execution::ExecutionPolicy Policy = execution::Default,
          class Rest = boundary::Fixed>
class WettedSurface {
 public:
  static constexpr int dim = Dim;                 ///< dimension of space
  static constexpr int space = Dim == 3 ? 3 : 2;  ///< of the structure
  using Motion = Riding<Dim, Rest>;               ///< motion of the virtual particles, for the gas

  /// @param rest  motion of the sets that ride on nothing
  /// @param lever whether gas meets the surface before a particle (where it sticks) or the particle
  explicit WettedSurface(bool lever = false, const Rest& rest = {}) : lever_(lever), rest_(rest) {}

  /// Ties the set's particles, in their order, to points of a structure with coordinates q.
  /// @param depth  of the body across a plane gas, whose forces are per metre [m]
  /// @throws InvalidInput unless there is a point for each particle, at its place and with its
  ///         normal, and for a set that is tied already or too late.
  void tie(const particles::Cloud<Dim>& cloud, int set,
           const std::vector<WettedPoint<space>>& points, const mbs::VectorXd& q,
           double depth = 1) {
    const std::string name = "points of set " + std::to_string(set);
    expects(set >= 1 && set <= cloud.sets, "set of virtual particles", set,
            "between 1 and " + std::to_string(cloud.sets));
    std::int64_t& first = first_[static_cast<std::size_t>(set)];
    expects(first == Motion::aground, name, "tied twice", "tied once");
    expects(place_.size() == 0, name, "tied after motion()", "tied before the gas is made");
    expects(depth > 0 && std::isfinite(depth) && (Dim < 3 || depth == 1), "depth of a body", depth,
            Dim < 3 ? "positive [m]" : "1: gas in space has its own");
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud.set[i] == set) members.push_back(i);
    expects(points.size() == members.size() && !points.empty(), name, points.size(),
            "one for each of the set's particles, " + std::to_string(members.size()));
    expects(members.back() - members.front() + 1 == members.size(), name, "scattered",
            "added to the cloud in one go");
    for (std::size_t k = 0; k < points.size(); ++k)
      check_place(points[k], q, cloud, members[k], name + ": point " + std::to_string(k));
    first = static_cast<std::int64_t>(size()) - static_cast<std::int64_t>(members.front());
    sets_.push_back({set, size(), size() + points.size(), depth});
    for (std::size_t k = 0; k < points.size(); ++k) {
      rows_.add(points[k], lever_ ? cloud.depth[members[k]] : 0);
      smoothing_length_ = std::min(smoothing_length_, cloud.h[members[k]]);
    }
  }

  /// Whether gas meets the surface before a particle.
  bool lever() const { return lever_; }
  /// Number of virtual particles that ride on the bodies.
  std::size_t size() const { return rows_.size(); }
  /// The smallest of the particles at the start [m].
  double smoothing_length() const { return smoothing_length_; }

  /// The motion of a gas's virtual particles. All sets must have been tied.
  /// @throws InvalidInput where none was.
  Motion motion() {
    expects(size() > 0, "wetted particles", size(), "some, tied before the gas is made");
    if (place_.size() == 0) {
      courses_ = execution::Field<Course<Dim>, Policy>(size());
      forces_ = execution::Field<Vec<Dim>, Policy>(size());
      place_ = execution::Field<std::int64_t, Policy>(std::span<const std::int64_t>(first_));
      rows_.assemble();
    }
    return {courses_.data(), place_.data(), start_, rest_};
  }

  /// Sends the particles on their way from coordinates q with rates v and accelerations a, at a
  /// time `start` [s].
  void depart(double start, const mbs::VectorXd& q, const mbs::VectorXd& v,
              const mbs::VectorXd& a) {
    start_ = start;
    way_ = rows_.template depart<Dim>(q, v, a);
    courses_.upload(way_);
  }

  /// Reads the forces of the gas at the last evaluation of its rates.
  template <class Fluid>
  void read(Fluid& fluid) {
    using T = typename Fluid::NumberType;
    auto& particles = fluid.particles();
    Policy::for_each(
        particles.size(),
        ReadForce<Dim, T, Motion>{particles.fields(), particles.rates(), motion(), forces_.data()});
    force_ = forces_.download();
    for (const Range& range : sets_)
      for (std::size_t i = range.first; i < range.last; ++i) force_[i] = range.depth * force_[i];
  }

  /// Forces on the bodies that were read, one a particle [N].
  const std::vector<Vec<Dim>>& forces() const { return force_; }

  /// Generalized force of such forces, where the particles are at a time [N per coordinate].
  mbs::VectorXd load(const std::vector<Vec<Dim>>& forces, double time, int coordinates) const {
    return rows_.template load<Dim>(forces, way_, time - start_, coordinates);
  }

  /// Power of the forces that were read at the velocities that gas met at a time [W].
  double power(double time) const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i)
      sum += dot(force_[i], way_[i].u + (time - start_) * way_[i].w);
    return sum;
  }

  /// Whether a set rides on a body.
  bool wets(int set) const {
    return set >= 0 && set < particles::first_opening &&
           first_[static_cast<std::size_t>(set)] != Motion::aground;
  }
  /// Each set with the place of its first particle, not wrapped, at the last departure [m].
  std::vector<std::pair<int, Vec<Dim>>> places() const {
    std::vector<std::pair<int, Vec<Dim>>> all;
    for (const Range& range : sets_) all.push_back({range.set, way_[range.first].r});
    return all;
  }
  /// The largest speed at the last departure [m/s].
  double fastest() const {
    double square = 0;
    for (const Course<Dim>& c : way_) square = std::max(square, norm2(c.v));
    return std::sqrt(square);
  }

  /// Force of the gas on a set of particles, of those that were read [N].
  /// @throws InvalidInput for a set that rides on nothing.
  Vec<Dim> force_on(int set) const {
    Vec<Dim> sum{};
    for_forces(set, [&](std::size_t i) { sum += force_[i]; });
    return sum;
  }

  /// Moment of these forces about a point, where the particles were at the last departure [N m].
  /// @throws InvalidInput for a set that rides on nothing.
  mbs::Vector<Dim == 3 ? 3 : 1> moment_on(int set, const mbs::Vector<space>& about) const {
    mbs::Vector<Dim == 3 ? 3 : 1> sum = mbs::Vector < Dim == 3 ? 3 : 1 > ::Zero();
    for_forces(set, [&](std::size_t i) {
      const auto n = in_space<space>(way_[i].n), f = in_space<space>(force_[i]);
      mbs::Vector<space> arm = in_space<space>(way_[i].r) - about;
      if (rows_.lever(i) != 0) arm += rows_.lever(i) * n.normalized();
      if constexpr (Dim == 3)
        sum += arm.cross(f);
      else
        sum[0] += arm[0] * f[1] - arm[1] * f[0];
    });
    return sum;
  }

 private:
  struct Range {
    int set;
    std::size_t first, last;
    double depth;  // [m]
  };

  template <class Visit>
  void for_forces(int set, const Visit& visit) const {
    const auto range = std::find_if(sets_.begin(), sets_.end(),
                                    [&](const Range& candidate) { return candidate.set == set; });
    expects(range != sets_.end(), "set of virtual particles", set, "one that rides on a body");
    for (std::size_t i = range->first; i < std::min(range->last, force_.size()); ++i) visit(i);
  }

  static void check_place(const WettedPoint<space>& point, const mbs::VectorXd& q,
                          const particles::Cloud<Dim>& cloud, std::size_t i,
                          const std::string& name) {
    mbs::Vector<space> r = point.at.at(q), n = point.normal_at(q);
    expects(n.norm() > 0 || point.offset == 0, name + ": offset", point.offset,
            "0 for a point without a normal [m]");
    if (n.norm() > 0) n.normalize();
    const double off = (r + point.offset * n - in_space<space>(cloud.r[i])).norm();
    expects(off <= 1e-6 * cloud.h[i], name + ": distance", off, "0: at the place of its particle");
    if (norm2(cloud.normal[i]) == 0) return;
    const double apart = (n - in_space<space>(cloud.normal[i])).norm();
    expects(apart <= 1e-4, name + ": normal, difference", apart, "0: that of its particle");
  }

  static std::array<std::int64_t, particles::first_opening> nowhere() {
    std::array<std::int64_t, particles::first_opening> all;
    all.fill(Motion::aground);
    return all;
  }

  bool lever_;
  Rest rest_;
  PointRows<space> rows_;
  std::array<std::int64_t, particles::first_opening> first_ = nowhere();
  std::vector<Range> sets_;
  double smoothing_length_ = std::numeric_limits<double>::infinity();
  double start_ = 0;
  std::vector<Course<Dim>> way_;
  std::vector<Vec<Dim>> force_;
  execution::Field<Course<Dim>, Policy> courses_;
  execution::Field<Vec<Dim>, Policy> forces_;
  execution::Field<std::int64_t, Policy> place_;
};

}  // namespace sphmbs::coupling
