// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/equations.hpp>

namespace sphmbs::mbs {

/// Calls function(joint, local state, place of its conditions in the result) for each constraint.
template <class System, class Function>
VectorXd by_constraint(System& equations, const State& state, const Function& function) {
  VectorXd result = VectorXd::Zero(equations.conditions());
  equations.for_each_component(
      state, [&]<class T>(const auto& component, const Slot& slot, const Local& x) {
        if constexpr (Constraint<T>)
          function(component, x, result.segment(slot.first_condition, slot.m));
      });
  return result;
}

/// dPhi/dt = Phi_q v + Phi_t, with Phi_q of the last evaluation.
template <class System>
VectorXd rate_of_conditions(System& equations, const State& state) {
  return equations.jacobian_times(state.v) +
         by_constraint(equations, state, [](const auto& joint, const Local& x, VectorOut out) {
           joint.rate(x.q, x.t, out);
         });
}

/// d2Phi/dt2 = Phi_q vdot + (Phi_q v)_q v + 2 Phi_qt v + Phi_tt, with Phi_q of the last evaluation.
template <class System>
VectorXd acceleration_of_conditions(System& equations, const State& state) {
  VectorXd result =
      equations.jacobian_times(state.vdot) +
      by_constraint(equations, state, [](const auto& joint, const Local& x, VectorOut out) {
        joint.acceleration(x.q, x.v, x.t, out);
      });
  equations.for_each_component(
      state, [&]<class T>(const auto& component, const Slot& slot, const Local& x) {
        if constexpr (Body<T> || Constraint<T>)
          for (int i = 0; i < slot.m; ++i) {
            const VectorXd unit = VectorXd::Unit(slot.m, i);
            MatrixXd H = MatrixXd::Zero(slot.n, slot.n);
            if constexpr (Body<T>)
              H = component.part.rigidity_hessian(Vector<T::conditions>(unit));
            else
              component.add_hessian(x.q, x.t, unit, H);
            result[slot.first_condition + i] += x.v.dot(H * x.v);
          }
      });
  return result;
}

/// Sets the entries of removed conditions to zero.
template <class System>
VectorXd without_removed(const System& equations, VectorXd conditions) {
  for (int i = 0; i < conditions.size(); ++i)
    if (equations.removed(i)) conditions[i] = 0;
  return conditions;
}

}  // namespace sphmbs::mbs
