// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/SparseLU>

#include <sphmbs/mbs/bordered.hpp>
#include <sphmbs/mbs/equilibrate.hpp>
#include <sphmbs/mbs/kinematics.hpp>
#include <sphmbs/mbs/redundancy.hpp>

namespace sphmbs::mbs {

/// What to do with conditions that hold what others hold already.
enum class Redundant { remove, refuse };

/// How an initial state may deviate from its conditions, and what is done about it. What is
/// projected away is meant to be rounding: the smallest change in kinetic energy moves light,
/// flexible parts most, and a whole velocity that is missing would whip them.
struct StartOptions {
  double position_tolerance = 1e-6;  ///< on Phi, over the structure's size [-]
  double velocity_tolerance = 1e-3;  ///< on dPhi/dt, over the largest rate or the size a second [-]
  Redundant redundant = Redundant::remove;  ///< what to do about conditions that follow from others
};

/// What was done to make the initial state consistent.
struct StartReport {
  double position_correction = 0;       ///< largest change of a coordinate
  double velocity_correction = 0;       ///< largest change of a rate
  std::vector<int> redundant = {};      ///< conditions removed
  std::vector<std::string> notes = {};  ///< the same for people, a sentence each
};

/// Makes a state consistent: Phi = 0, Phi_q v + Phi_t = 0, and accelerations and multipliers from
/// eq. (25). Positions and velocities are projected along M^-1 Phi_q^T, the smallest change in the
/// norm of the kinetic energy.
template <class System>
class ConsistentStart {
 public:
  /// @param size  of the structure [m], to which errors are compared.
  ConsistentStart(System& equations, State& state, double size, const StartOptions& options)
      : equations_(equations), state_(state), size_(size), options_(options) {}

  /// @throws InvalidInput for a state beyond the tolerances, for contradictory conditions, and for
  ///         redundant ones where options refuse them; NumericalFailure for a singular mass.
  StartReport run() {
    place();
    project_velocities();
    find_accelerations();
    return report_;
  }

  /// Accelerations and multipliers only, of a state that is consistent otherwise.
  /// @throws NumericalFailure for a singular mass.
  void find_accelerations() {
    constexpr int repetitions = 50;  // friction depends on the multipliers
    const int n = static_cast<int>(state_.q.size());
    state_.vdot = VectorXd::Zero(n);
    VectorXd residual;
    for (int k = 0; k < repetitions; ++k) {
      equations_.evaluate(state_);
      equations_.residual(VectorXd::Zero(n), residual);
      state_.vdot.setZero();
      const VectorXd conditions = kept(acceleration_of_conditions(equations_, state_));
      const VectorXd x = solve(-residual.head(n), -conditions);
      state_.vdot = x.head(n);
      const VectorXd change = x.tail(equations_.conditions());
      state_.lambda += change;
      if (change.norm() <= 1e-12 * state_.lambda.norm()) break;
    }
  }

  /// Redundancy and positions only, as statics needs them.
  /// @throws as run()
  StartReport place() {
    relocate();
    check_positions();
    find_redundant();
    project_positions();
    return report_;
  }

 private:
  using LU = Eigen::SparseLU<SparseMatrix>;

  void relocate() {
    equations_.relocate(state_.q);
    state_.lambda = VectorXd::Zero(equations_.conditions());
    equations_.evaluate(state_);
  }

  void find_redundant() {
    // Dependence shows up to the error of positions that are still to be projected.
    const VectorXd phi = equations_.conditions_residual();
    if (phi.size() == 0) return;
    const double error = 100 * phi.cwiseAbs().maxCoeff() / size_;
    report_.redundant =
        redundant_rows(equations_.jacobian(), rigidity_rows(), std::max(1e-9, error));
    if (report_.redundant.empty()) return;
    const std::string text =
        std::to_string(report_.redundant.size()) +
        " redundant condition(s), already held by others: " + names(report_.redundant);
    if (options_.redundant == Redundant::refuse) throw InvalidInput(text);
    report_.notes.push_back(text + "; removed");
    equations_.remove(report_.redundant);
  }

  // Where a joint and the rigidity of a body hold the same, the joint is what is redundant.
  std::vector<unsigned char> rigidity_rows() {
    std::vector<unsigned char> rows(static_cast<std::size_t>(equations_.conditions()), 0);
    equations_.for_each_component(state_,
                                  [&]<class T>(const auto&, const Slot& slot, const Local&) {
                                    if constexpr (Body<T>)
                                      std::fill_n(rows.begin() + slot.first_condition, slot.m, 1);
                                  });
    return rows;
  }

  void check_positions() const {
    const double allowed = options_.position_tolerance * size_;
    const VectorXd phi = equations_.conditions_residual();
    for (int k = 0; k < phi.size(); ++k)
      if (!(std::abs(phi[k]) <= allowed)) refuse("positions", k, phi[k], allowed);
  }

  void project_positions() {
    int worst = 0;
    const VectorXd start = state_.q;
    VectorXd phi = equations_.conditions_residual();
    if (phi.size() == 0) return;
    // Of places far from the origin, and of unit vectors of small bodies.
    const double reach = std::max(size_, state_.q.cwiseAbs().maxCoeff());
    const double rounding = 1e-14 * reach;
    for (int k = 0; k < 10 && kept(phi).cwiseAbs().maxCoeff() > rounding; ++k) {
      state_.q += solve(VectorXd::Zero(state_.q.size()), -kept(phi)).head(state_.q.size());
      relocate();
      phi = equations_.conditions_residual();
    }
    if (phi.cwiseAbs().maxCoeff(&worst) > 1e-10 * reach) contradiction(worst, phi[worst]);
    report_.position_correction = (state_.q - start).cwiseAbs().maxCoeff();
    if (report_.position_correction > 1e-12 * size_)
      note("initial positions", report_.position_correction);
  }

  void project_velocities() {
    if (equations_.conditions() == 0) return;
    VectorXd rate = rate_of_conditions(equations_, state_);
    const double scale = std::max(state_.v.cwiseAbs().maxCoeff(), size_);
    const double allowed = options_.velocity_tolerance * scale;
    int worst = 0;
    if (rate.cwiseAbs().maxCoeff(&worst) > allowed)
      refuse("velocities", worst, rate[worst], allowed);
    const VectorXd start = state_.v;
    state_.v += solve(VectorXd::Zero(start.size()), -kept(rate)).head(start.size());
    rate = rate_of_conditions(equations_, state_);
    if (rate.cwiseAbs().maxCoeff(&worst) > 1e-8 * scale) contradiction(worst, rate[worst]);
    report_.velocity_correction = (state_.v - start).cwiseAbs().maxCoeff();
    if (report_.velocity_correction > 1e-12 * scale)
      note("initial velocities", report_.velocity_correction);
  }

  // [M, Phi_q^T; Phi_q, 0] x = [force, conditions], at the state.
  VectorXd solve(const VectorXd& force, const VectorXd& conditions) {
    const int n = equations_.coordinates(), m = equations_.conditions();
    SparseMatrix A = bordered(equations_, equations_.mass());
    const VectorXd D = equilibrate(A, equations_.roles());
    LU lu(A);
    VectorXd b(n + m);
    b << force, conditions;
    b = D.cwiseProduct(b);
    VectorXd x = VectorXd::Constant(n + m, std::numeric_limits<double>::quiet_NaN());
    if (lu.info() == Eigen::Success) x = D.cwiseProduct(VectorXd(lu.solve(b)));
    if (!x.allFinite())
      throw NumericalFailure(
          "The mass matrix together with the conditions is singular at t = 0: a coordinate has "
          "neither mass nor a condition that determines it; give it mass or a joint.",
          "E332");
    return x;
  }

  VectorXd kept(VectorXd conditions) const {
    return without_removed(equations_, std::move(conditions));
  }

  std::string name(int condition) const { return equations_.name_of_condition(condition); }

  std::string names(const std::vector<int>& conditions) const {
    std::string list, last;
    for (const int k : conditions) {
      const std::string own = name(k);
      if (own != last) list += (list.empty() ? "" : ", ") + own;
      last = own;
    }
    return list;
  }

  [[noreturn]] void refuse(const std::string& what, int condition, double value,
                           double allowed) const {
    std::ostringstream text;
    text << "Initial " << what << " violate " << name(condition) << " by " << std::abs(value)
         << ": at most " << allowed << " is projected away. "
         << (what == "velocities"
                 ? "Give the parts the velocities of their joints and drives, or let a drive begin "
                   "smoothly (joints::SmoothStep)."
                 : "Place the parts where their joints are.");
    throw InvalidInput(text.str());
  }

  [[noreturn]] void contradiction(int condition, double value) const {
    std::ostringstream text;
    text << name(condition) << " contradicts other conditions: " << std::abs(value)
         << " remains after projection.";
    throw InvalidInput(text.str());
  }

  void note(const std::string& what, double size) {
    std::ostringstream text;
    text << what << " projected onto the conditions: largest change " << size;
    report_.notes.push_back(text.str());
  }

  System& equations_;
  State& state_;
  double size_;
  StartOptions options_;
  StartReport report_;
};

}  // namespace sphmbs::mbs
