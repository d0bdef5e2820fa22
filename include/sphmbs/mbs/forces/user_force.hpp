// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/stacked.hpp>

namespace sphmbs::mbs::forces {

/// A user's function, assignable even where it is a lambda that captures something.
template <class F>
class Assignable {
 public:
  /// Holds a function.
  Assignable(F function) : function_(std::move(function)) {}
  /// Copies the function.
  Assignable(const Assignable&) = default;
  /// Takes the function over.
  Assignable(Assignable&&) = default;
  ~Assignable() = default;
  /// Replaces the function, which lambdas alone do not allow.
  Assignable& operator=(Assignable other) {
    std::destroy_at(&function_);
    std::construct_at(&function_, std::move(other.function_));
    return *this;
  }
  /// The function.
  const F& operator*() const { return function_; }

 private:
  F function_;
};

/// Says that the tangent of a user's law comes from running it with dual numbers.
struct Differentiated {};

/// A user's force F(x, v, t) on a quantity x of a structure: a point, several `stacked` markers, or
/// `coordinates`. Q = N^T F; its work is F . dx.
///
///   law(x, v, t, F)            writes F, which comes zeroed; written for any number type of x, v
///                              and F, it is differentiated forwards
///   tangent(x, v, t, k, c)     where given, writes k = dF/dx and c = dF/dv, which come zeroed
///   law.potential(x, t)        where it exists, the energy stored; such a force is no load, which
///                              statics would raise from nothing
///   law.dissipation(x, v, t)   where it exists, the power taken out
///
///   auto drag = forces::user_force(tip, [](const auto&, const auto& v, double, auto& F) {
///     using std::sqrt;
///     F = -0.3 * sqrt(v.squaredNorm() + 1e-12) * v;
///   });
template <int Size, class Law, class Tangent = Differentiated>
struct UserForce {
  using Value = Vector<Size>;        ///< x, v, and the force on them
  using Slope = Matrix<Size, Size>;  ///< derivatives of the force
  /// Whether the law gives a potential.
  static constexpr bool has_potential = requires(const Law l, Value x) { l.potential(x, 0.0); };
  static constexpr bool is_load = !has_potential;  ///< statics raises it step by step, see `Load`

  Marker<Size> on;                        ///< x, the numbers the law sees
  Assignable<Law> law;                    ///< the force, see above
  Assignable<Tangent> slope = Tangent{};  ///< k and c, see above; without it by dual numbers
  std::string label = "user force";       ///< name in messages and reports

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return on.index; }

  void force(VectorIn q, VectorIn v, double t, VectorOut f) const {
    const Value x = on.local(q), velocity = on.N * v;
    Value F = Value::Zero();
    (*law)(x, velocity, t, F);
    add_force<Size>(on, F, f);
  }

  void tangent(VectorIn q, VectorIn v, double t, MatrixOut k, MatrixOut c) const {
    const Value x = on.local(q), velocity = on.N * v;
    Slope stiff = Slope::Zero(), viscous = Slope::Zero();
    if constexpr (std::is_same_v<Tangent, Differentiated>)
      differentiate(x, velocity, t, stiff, viscous);
    else
      (*slope)(x, velocity, t, stiff, viscous);
    add_tangent(on, stiff, k);
    add_tangent(on, viscous, c);
  }

  double potential(VectorIn q, double t) const {
    if constexpr (has_potential)
      return (*law).potential(Value(on.local(q)), t);
    else
      return 0;
  }
  double dissipation(VectorIn q, VectorIn v, double t) const {
    if constexpr (requires(Value x) { (*law).dissipation(x, x, t); })
      return (*law).dissipation(Value(on.local(q)), Value(on.N * v), t);
    else
      return 0;
  }
  ///@}

  /// @throws InvalidInput where the marker moves with no coordinate.
  void check() const { expects(!on.index.empty(), "coordinates of its marker", 0, "one or more"); }

 private:
  void differentiate(const Value& x, const Value& v, double t, Slope& k, Slope& c) const {
    using Dual = Eigen::AutoDiffScalar<Vector<2 * Size>>;
    Vector<Size, Dual> place, velocity, F;
    for (int i = 0; i < Size; ++i) {
      place[i] = Dual(x[i], 2 * Size, i);
      velocity[i] = Dual(v[i], 2 * Size, Size + i);
      F[i] = Dual(0.0);
    }
    (*law)(std::as_const(place), std::as_const(velocity), t, F);
    for (int i = 0; i < Size; ++i) {
      k.row(i) = F[i].derivatives().template head<Size>().transpose();
      c.row(i) = F[i].derivatives().template tail<Size>().transpose();
    }
  }
};

/// @param law      see UserForce
/// @param tangent  its derivatives; by default it is differentiated
template <int Size, class Law, class Tangent = Differentiated>
UserForce<Size, Law, Tangent> user_force(const Marker<Size>& on, Law law, Tangent tangent = {},
                                         std::string label = "user force") {
  return {on, std::move(law), std::move(tangent), std::move(label)};
}

}  // namespace sphmbs::mbs::forces
