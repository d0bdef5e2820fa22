// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/error.hpp>
#include <sphmbs/mbs/constraint.hpp>
#include <sphmbs/mbs/forces/penalty.hpp>
#include <sphmbs/mbs/joints/frame.hpp>
#include <sphmbs/mbs/joints/friction.hpp>
#include <sphmbs/mbs/joints/joint.hpp>
#include <sphmbs/mbs/joints/rail.hpp>

namespace sphmbs::mbs::joints {

/// What happens where a slider comes to an end of its rail.
enum class Ends {
  event,  ///< BeyondModel once a state beyond the end is accepted
  stop    ///< a spring and damper pushes it back
};

/// How a point slides along a rail.
template <int Dim>
struct SlidingOptions {
  Marker<Dim> slider = {};          ///< the point
  double at = 0;                    ///< s at t = 0 [m]
  std::optional<double> rate = {};  ///< ds/dt at t = 0 [m/s]; else from the slider's velocity
  Friction friction = {};           ///< along the rail; none unless given
  Ends ends = Ends::event;          ///< what happens at the ends of the rail
  forces::Penalty stop = {.stiffness = 1e6, .exponent = 1.5, .damping = 1};  ///< against s
  double overrun = 1e-6;    ///< share of the rail that is no event yet [-]
  double tolerance = 1e-6;  ///< distance at t = 0 that is allowed, over the rail's length
  std::string name = "";    ///< what messages call it
};

/// A point slides along a chain of elements: Phi = x(q) - r(s, q) = 0, Dim conditions. The material
/// arc parameter s is a coordinate without mass. lambda is the force of the slider on the rail, and
/// -lambda that on the slider. The equation of s is -r' . lambda + r_s = 0 with the force r_s of
/// friction and stops on s: without these lambda is across the rail, and friction F opposes the
/// slider with -r'/|r'| . lambda = -F, where w = |r'| ds/dt and the normal force is the part of
/// lambda across r' (joints/friction.hpp). In space the slider may turn about the rail freely.
///
/// relocate() takes the joint to the element that s is on; r and r' are continuous there. Beyond an
/// end the last element's polynomial goes on, so that Newton's method may overshoot.
template <RailElement E>
class Sliding {
 public:
  static constexpr int dim = E::dim;  ///< dimension of space

  /// @param arc  the node of s, see `sliding`
  Sliding(Rail<E> rail, Node arc, SlidingOptions<E::dim> options)
      : rail_(std::move(rail)), arc_(arc), options_(std::move(options)) {
    name_ = titled("sliding joint", options_.name);
    index_ = options_.slider.index;
    index_.push_back(arc_.offset);
    move_to(rail_.element_at(options_.at));
  }

  ///@{ As `Constraint` asks.
  const std::string& name() const { return name_; }
  const Index& index() const { return index_; }
  int conditions() const { return dim; }
  ///@}
  /// What it slides on.
  const Rail<E>& rail() const { return rail_; }
  /// The coordinate s, for sensors and forces.
  Marker<1> arc() const { return {.index = {arc_.offset}, .N = Matrix<1, Dynamic>::Ones(1, 1)}; }
  /// The element of the rail that the joint is on.
  std::size_t element() const { return element_; }

  /// Moves to the element that q puts it on, as `MovingConstraint` asks.
  bool relocate(const VectorXd& q) {
    const std::size_t now = rail_.element_at(q[arc_.offset]);
    if (now == element_) return false;
    move_to(now);
    return true;
  }

  /// What a checkpoint keeps of it, see `Archive`.
  template <Archive A>
  void visit_state(A& archive) {
    std::uint64_t element = element_;
    archive("element", element);
    if (A::restores) move_to(std::min<std::size_t>(element, rail_.size() - 1));
  }

  /// Phi: the point less the rail at its place.
  void residual(VectorIn q, double, VectorOut phi) const {
    const E& part = rail_.element(element_).part;
    phi = options_.slider.local(q.head(sliders())) - part.shape(on_axis(q)) * own(q);
  }

  /// Phi_q.
  void jacobian(VectorIn q, double, MatrixOut phi_q) const {
    const E& part = rail_.element(element_).part;
    phi_q.leftCols(sliders()) = options_.slider.N;
    phi_q.col(sliders()) = -part.shape_gradient(on_axis(q), 0) * own(q);
    phi_q.template rightCols<E::dofs>() = -part.shape(on_axis(q));
  }

  /// d(Phi_q^T lambda)/dq, added to h.
  void add_hessian(VectorIn q, double, VectorIn lambda, MatrixOut h) const {
    const E& part = rail_.element(element_).part;
    const int s = sliders();
    const Vector<dim> force = lambda;
    const Vector<E::dofs> cross = part.shape_gradient(on_axis(q), 0).transpose() * force;
    h(s, s) -= force.dot(part.shape_curvature(on_axis(q)) * own(q));
    h.col(s).template tail<E::dofs>() -= cross;
    h.row(s).template tail<E::dofs>() -= cross.transpose();
  }

  /// Nothing depends on time.
  void rate(VectorIn, double, VectorOut) const {}
  /// Nothing depends on time.
  void acceleration(VectorIn, VectorIn, double, VectorOut) const {}

  /// r_s = |r'| F - Q_stop, the one component of friction and stops.
  void friction(VectorIn q, VectorIn v, double, VectorIn lambda, VectorOut r) const {
    const Slip slip(*this, q, v, lambda);
    r[sliders()] += slip.stretch * slip.resistance.force + stops(q[sliders()], v[sliders()]).force;
  }

  /// Derivatives of the friction, as `FrictionalConstraint` asks.
  void friction_tangent(VectorIn q, VectorIn v, double, VectorIn lambda, MatrixOut k, MatrixOut c,
                        MatrixOut l) const {
    const int s = sliders();
    const Slip slip(*this, q, v, lambda);
    const Stopped stopped = stops(q[sliders()], v[sliders()]);
    // dF = by_velocity dw + by_normal n . dn for the force n across the rail.
    const Friction::Resistance& F = slip.resistance;
    const Vector<dim> by_tangent =  // d r_s / d r'
        (F.force + F.by_velocity * slip.velocity) * slip.along -
        F.by_normal * slip.along_force * slip.across_force;
    const E& part = rail_.element(element_).part;
    const Vector<E::dofs> row = part.shape_gradient(on_axis(q), 0).transpose() * by_tangent;
    k.row(s).template tail<E::dofs>() += row.transpose();
    k(s, s) += by_tangent.dot(part.shape_curvature(on_axis(q)) * own(q)) + stopped.by_place;
    c(s, s) += slip.stretch * slip.stretch * F.by_velocity + stopped.by_rate;
    l.row(s) += slip.stretch * F.by_normal * slip.across_force.transpose();
  }

  /// Power that friction takes [W].
  double dissipation(VectorIn q, VectorIn v, double, VectorIn lambda) const {
    const Slip slip(*this, q, v, lambda);
    return slip.resistance.force * slip.velocity + stops(q[sliders()], v[sliders()]).dissipation;
  }

  /// Energy stored in the stops [J].
  double potential(VectorIn q, double) const { return stops(q[sliders()], 0).energy; }

  /// @throws BeyondModel for a state beyond an end of the rail, or, where there are stops, one
  ///         that has gone through them by the length of an element.
  void accept(const VectorXd& q, double t) const {
    const double s = q[arc_.offset], length = rail_.length();
    const std::size_t last = s < 0 ? 0 : rail_.size() - 1;
    const bool stop = options_.ends == Ends::stop;
    const double allowed = stop ? rail_.element(last).part.length : options_.overrun * length;
    if (s >= -allowed && s <= length + allowed) return;
    std::ostringstream text;
    text << name_ << ": at t = " << t << " s the slider has left its rail: s = " << s
         << " m, the rail is from 0 to " << length << " m; "
         << (stop ? "make `stop` stiffer or the step shorter"
                  : "make the rail longer, end the run earlier, or give it `Ends::stop`");
    throw BeyondModel(text.str(), "E334");
  }

  /// @throws InvalidInput for friction or stops out of range.
  void check() const {
    options_.friction.check();
    named("stop", [&] { options_.stop.check(); });
    expects(options_.overrun >= 0 && options_.overrun < 1, "overrun", options_.overrun,
            "between 0 and 1 [-]");
  }

 private:
  struct Stopped {
    double force = 0, by_place = 0, by_rate = 0, energy = 0, dissipation = 0;
  };

  // Sliding, and the reaction split along and across the rail.
  struct Slip {
    double stretch, velocity, along_force;
    Vector<dim> along, across_force;
    Friction::Resistance resistance;

    Slip(const Sliding& joint, VectorIn q, VectorIn v, VectorIn lambda) {
      const E& part = joint.rail_.element(joint.element_).part;
      const Vector<dim> tangent = part.shape_gradient(joint.on_axis(q), 0) * joint.own(q);
      const Vector<dim> force = lambda;
      stretch = tangent.norm();
      along = tangent / stretch;
      velocity = stretch * v[joint.sliders()];
      along_force = along.dot(force);
      across_force = force - along_force * along;
      resistance = joint.options_.friction.resistance(across_force.squaredNorm(), velocity);
    }
  };

  int sliders() const { return static_cast<int>(options_.slider.index.size()); }
  Vector<E::dofs> own(VectorIn q) const { return q.template tail<E::dofs>(); }
  typename E::Material on_axis(VectorIn q) const {
    return rail_.element(element_).part.on_axis(q[sliders()] - rail_.start(element_));
  }

  void move_to(std::size_t element) {
    element_ = element;
    index_.resize(options_.slider.index.size() + 1);
    for (const Node& node : rail_.element(element).nodes)
      for (int k = 0; k < node.size; ++k) index_.push_back(node.offset + k);
  }

  Stopped stops(double s, double rate) const {
    const double length = rail_.length();
    if (options_.ends != Ends::stop || (s >= 0 && s <= length)) return {};
    const double outwards = s < 0 ? -1 : 1;
    const double depth = s < 0 ? -s : s - length;
    const forces::Penalty::Push push = options_.stop.push(depth, outwards * rate);
    return {outwards * push.force, push.by_depth, push.by_rate, push.energy, push.dissipation};
  }

  Rail<E> rail_;
  Node arc_;
  SlidingOptions<dim> options_;
  std::string name_;
  Index index_;  // slider, s, element
  std::size_t element_ = 0;
};

/// Lets a point slide along a rail: adds the coordinate s to the structure. The joint itself is to
/// be added after: structure.add(joints::sliding(structure, rail, {.slider = tip, .at = 0.5})).
/// @param rail  elements in order, each from the node where the one before ends
/// @throws InvalidInput where s is outside, or the slider is not at s.
template <class Structure, RailElement E>
Sliding<E> sliding(Structure& structure, const std::vector<Placed<E>>& rail,
                   const SlidingOptions<E::dim>& options) {
  const std::string name = titled("sliding joint", options.name);
  const Rail<E> line = named(name, [&] { return Rail<E>(rail); });
  const double s = options.at, length = line.length();
  const double rounding = 1e-12 * length;  // of the sum of the elements' lengths
  expects(s >= -rounding && s <= length + rounding, name + ": at", s,
          "between 0 and the length of the rail, " + std::to_string(length) + " [m]");
  const VectorXd q = structure.q(), v = structure.v();
  const Marker<E::dim> place = line.point(s);
  const double distance = (options.slider.at(q) - place.at(q)).norm();
  expects(distance <= options.tolerance * length, name + ": distance of the slider from the rail",
          distance, "zero at t = 0 [m]");
  const Vector<E::dim> tangent = line.tangent(s).at(q);
  const double rate = options.rate.value_or(tangent.dot(options.slider.rate(v) - place.rate(v)) /
                                            tangent.squaredNorm());
  return {line, structure.add_node(Vector<1>(s), Vector<1>(rate)), options};
}

}  // namespace sphmbs::mbs::joints
