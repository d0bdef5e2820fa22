// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <sphmbs/mbs.hpp>
#include <sphmbs/mbs/forces/contact.hpp>

#include "support/session.hpp"

namespace sphmbs::examples {

template <class T>
inline constexpr bool is_contact = false;
template <class Surface>
inline constexpr bool is_contact<mbs::forces::Contact<Surface>> = true;

/// A component's name as part of the head of a column: one _ for whatever is no letter or digit.
inline std::string column_word(const std::string& name) {
  std::string word;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      word += c;
    else if (!word.empty() && word.back() != '_')
      word += '_';
  while (word.ends_with('_')) word.pop_back();
  return word;
}

/// What acts on a body: resultants at one time [N]. Without gas
/// total = constraints + contacts + others + mass times gravity; what bends it sums up to nothing.
template <int Dim>
struct BodyForces {
  using Force = mbs::Vector<Dim>;
  std::vector<Force> joints;          // of each joint that touches the body
  Force constraints = Force::Zero();  // of all of them, friction included
  Force contacts = Force::Zero();     // of all forces::Contact
  Force others = Force::Zero();       // of all other forces but gravity: springs, loads
  Force total = Force::Zero();        // rate of the body's momentum
};

/// Adds up the forces on a body. What is asked for several times at one time is computed once.
template <class System, class Part>
class BodyScale {
 public:
  static constexpr int dim = Part::dim;
  using Force = mbs::Vector<dim>;

  /// @param parts  that the body is made of: all that share nodes
  BodyScale(System& system, std::vector<mbs::Placed<Part>> parts)
      : system_(system), parts_(std::move(parts)) {
    unit_ = mbs::Matrix<mbs::Dynamic, dim>::Zero(system.state().q.size(), dim);
    const mbs::Matrix<Part::dofs, dim> T = Part::translation();
    for (const auto& part : parts_) {
      const mbs::Index index = part.index();
      for (int k = 0; k < Part::dofs; ++k) unit_.row(index[static_cast<std::size_t>(k)]) = T.row(k);
    }
    for_constraints([&](const auto& joint, int) {
      touched_.push_back(touches(joint.index()));
      if (!touched_.back()) return;
      std::string name = column_word(joint.name());
      if (name.empty() || std::find(joints_.begin(), joints_.end(), name) != joints_.end())
        name += "_" + std::to_string(joints_.size());
      joints_.push_back(std::move(name));
    });
  }

  /// Names of the joints that touch the body at the start.
  const std::vector<std::string>& joints() const { return joints_; }

  /// The forces at the time of the system.
  const BodyForces<dim>& now() {
    if (system_.time() == time_) return forces_;
    forces_ = {};
    const mbs::State& state = system_.state();
    std::size_t k = 0;
    for_constraints([&](const auto& joint, int number) {
      using Joint = std::decay_t<decltype(joint)>;
      if (!touched_[k++]) return;
      const mbs::VectorXd q = state.q(joint.index()), v = state.v(joint.index());
      const mbs::VectorXd lambda = system_.template multipliers<Joint>(number);
      mbs::MatrixXd phi_q = mbs::MatrixXd::Zero(joint.conditions(), q.size());
      joint.jacobian(q, state.t, phi_q);
      mbs::VectorXd push = phi_q.transpose() * lambda;
      if constexpr (mbs::FrictionalConstraint<Joint>) {
        mbs::VectorXd friction = mbs::VectorXd::Zero(q.size());
        joint.friction(q, v, state.t, lambda, friction);
        push += friction;
      }
      forces_.joints.push_back(-resultant(joint.index(), push));
      forces_.constraints += forces_.joints.back();
    });
    system_.structure().for_each_type([&]<class T>(const auto& components) {
      if constexpr (mbs::Force<T>)
        for (const T& load : components) {
          if (!touches(load.index())) continue;
          const mbs::VectorXd q = state.q(load.index()), v = state.v(load.index());
          mbs::VectorXd push = mbs::VectorXd::Zero(q.size());
          load.force(q, v, state.t, push);
          (is_contact<T> ? forces_.contacts : forces_.others) += resultant(load.index(), push);
        }
    });
    for (const auto& part : parts_) forces_.total += momentum(part, state.vdot);
    time_ = system_.time();
    return forces_;
  }

 private:
  template <class Visit>
  void for_constraints(const Visit& visit) const {
    system_.structure().for_each_type([&]<class T>(const auto& components) {
      if constexpr (mbs::Constraint<T>)
        for (std::size_t i = 0; i < components.size(); ++i)
          visit(components[i], static_cast<int>(i));
    });
  }

  bool touches(const mbs::Index& index) const {
    return std::any_of(index.begin(), index.end(), [&](int k) { return !unit_.row(k).isZero(0); });
  }

  Force resultant(const mbs::Index& index, const mbs::VectorXd& push) const {
    Force sum = Force::Zero();
    for (std::size_t k = 0; k < index.size(); ++k)
      sum += push[static_cast<int>(k)] * unit_.row(index[k]).transpose();
    return sum;
  }

  System& system_;
  std::vector<mbs::Placed<Part>> parts_;
  mbs::Matrix<mbs::Dynamic, dim> unit_;  // coordinates of unit translations of the body alone
  std::vector<std::string> joints_;
  std::vector<bool> touched_;  // of all constraints
  BodyForces<dim> forces_;
  double time_ = std::numeric_limits<double>::quiet_NaN();
};

/// Records in history.csv all that acts on a body but gas and weight: columns, for each axis,
///   joint_force_<joint>_on_<name>_x  of each joint that touches it
///   constraint_force_<name>_x        of all of them together
///   contact_force_<name>_x, other_force_<name>_x  where the structure has contacts, other forces
///   total_force_<name>_x             mass times acceleration
/// @param parts  that the body is made of: all that share nodes
template <class System, class Part>
void record_body_loads(Session<System>& session, const std::string& name,
                       const std::vector<mbs::Placed<Part>>& parts) {
  using Scale = BodyScale<System, Part>;
  const auto scale = std::make_shared<Scale>(session.system(), parts);
  const auto columns = [&](const std::string& what, auto force) {
    for (int k = 0; k < Part::dim; ++k)
      session.record(what + "_" + "xyz"[k], "N", [scale, force, k] { return force(*scale)[k]; });
  };
  for (std::size_t i = 0; i < scale->joints().size(); ++i)
    columns("joint_force_" + scale->joints()[i] + "_on_" + name,
            [i](Scale& s) { return s.now().joints[i]; });
  columns("constraint_force_" + name, [](Scale& s) { return s.now().constraints; });
  bool contacts = false, others = false;
  session.system().structure().for_each_type([&]<class T>(const auto&) {
    if constexpr (mbs::Force<T>) (is_contact<T> ? contacts : others) = true;
  });
  if (contacts) columns("contact_force_" + name, [](Scale& s) { return s.now().contacts; });
  if (others) columns("other_force_" + name, [](Scale& s) { return s.now().others; });
  columns("total_force_" + name, [](Scale& s) { return s.now().total; });
}

}  // namespace sphmbs::examples
