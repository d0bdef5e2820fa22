// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/mbs/equations.hpp>

namespace sphmbs::mbs {

/// Energies of a structure, and what went in and out since t = 0; total() is constant but for the
/// error of the integrator.
struct Energies {
  double kinetic = 0;     ///< 1/2 v.M v [J]
  double strain = 0;      ///< of flexible elements [J]
  double potential = 0;   ///< of gravity, zero at the origin [J]
  double springs = 0;     ///< potential of forces and end stops that have one [J]
  double dissipated = 0;  ///< by dampers, friction and internal damping since t = 0 [J]
  double work = 0;        ///< done by loads, drives and forces from outside since t = 0 [J]

  /// Kinetic and stored energy [J].
  double mechanical() const { return kinetic + strain + potential + springs; }
  /// What is constant in time but for errors of the integrator [J].
  double total() const { return mechanical() + dissipated - work; }
};

/// Kinetic, strain and potential energy at a state.
template <class System, class Structure>
Energies energies_at(System& equations, const Structure& structure, const State& state) {
  Energies e;
  const VectorXd p = equations.mass() * state.v;
  e.kinetic = 0.5 * state.v.dot(p);
  const VectorXd weight = equations.mass() * (equations.translation() * structure.gravity);
  e.potential = -state.q.dot(weight);
  equations.for_each_component(state,
                               [&]<class T>(const auto& component, const Slot&, const Local& x) {
                                 if constexpr (Element<T>)
                                   e.strain += component.part.strain_energy(Vector<T::dofs>(x.q));
                                 if constexpr (Force<T> || StoringConstraint<T>)
                                   e.springs += component.potential(x.q, x.t);
                               });
  return e;
}

/// Potential of forces whose power `Powers::work` includes.
template <class System>
double potential_of_forces(System& equations, const State& state) {
  double sum = 0;
  equations.for_each_component(state,
                               [&]<class T>(const auto& component, const Slot&, const Local& x) {
                                 if constexpr (Force<T>)
                                   if (!is_conservative(component))
                                     sum += component.potential(x.q, x.t);
                               });
  return sum;
}

/// Powers at a state: of everything that damps, and of what drives, the outside and forces do that
/// are not conservative.
struct Powers {
  double dissipated = 0;  ///< [W]
  double work = 0;        ///< [W]
};

/// Powers of damping and loads at a state [W].
template <class System>
Powers powers_at(System& equations, const State& state) {
  Powers p;
  p.work = equations.external_force().dot(state.v);
  equations.for_each_component(
      state, [&]<class T>(const auto& component, const Slot& slot, const Local& x) {
        if constexpr (Element<T>)
          p.dissipated += component.part.dissipation(Vector<T::dofs>(x.q), Vector<T::dofs>(x.v));
        if constexpr (FrictionalConstraint<T>)
          p.dissipated += component.dissipation(x.q, x.v, x.t, x.lambda);
        if constexpr (Constraint<T>) {
          VectorXd rate = VectorXd::Zero(slot.m);
          component.rate(x.q, x.t, rate);
          p.work += rate.dot(x.lambda);
        }
        if constexpr (Force<T>) {
          const double damped = component.dissipation(x.q, x.v, x.t);
          p.dissipated += damped;
          if (is_conservative(component)) return;
          VectorXd Q = VectorXd::Zero(slot.n);
          component.force(x.q, x.v, x.t, Q);
          p.work += Q.dot(x.v) + damped;
        }
      });
  return p;
}

}  // namespace sphmbs::mbs
