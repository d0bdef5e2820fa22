// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/forces/frame.hpp>

namespace sphmbs::mbs::forces {

/// Elastic mount between two frames A and B: springs and dampers along and about the axes of A,
///   V = 1/2 sum_i k_i (a_i . d - rest_i)^2 + 1/2 sum_i kr_i s_i^2,
/// with d from the origin of A to that of B and the small turns s_i = (a_k . b_j - a_j . b_k) / 2,
/// i, j, k cyclic: the sine of the angle when B has turned about one axis, so that the mount is
/// meant for turns well below a quarter. In the plane the one turn is about the normal. Nothing is
/// strained when B is at `rest` with its axes along those of A. Forces and moments on A and B are
/// opposite and equal.
template <int Dim>
struct Bushing {
  static constexpr int turns = Dim == 2 ? 1 : 3;  ///< about how many axes

  Frame<Dim> from = joints::ground_frame<Dim>(Vector<Dim>::Zero());  ///< A
  Frame<Dim> to = joints::ground_frame<Dim>(Vector<Dim>::Zero());    ///< B
  Vector<Dim> stiffness = Vector<Dim>::Zero();                       ///< k [N/m]
  Vector<turns> rotational_stiffness = Vector<turns>::Zero();        ///< kr [N m/rad]
  Vector<Dim> damping = Vector<Dim>::Zero();                         ///< [N s/m]
  Vector<turns> rotational_damping = Vector<turns>::Zero();          ///< [N m s/rad]
  Vector<Dim> rest = Vector<Dim>::Zero();                            ///< [m]
  std::string label = "bushing";                        ///< name in messages and reports
  Marker<Dim*(2 * Dim + 1)> y = both_frames(from, to);  ///< follows from the others

  ///@{ As `Force` asks.
  const std::string& name() const { return label; }
  const Index& index() const { return y.index; }

  void force(VectorIn q, VectorIn v, double, VectorOut f) const {
    const Y now = y.local(q), velocity = y.N * v;
    const Jacobian J = jacobian(now);
    add_force<size>(y, -J.transpose() * resistance(J, now, velocity), f);
  }

  void tangent(VectorIn q, VectorIn v, double, MatrixOut k, MatrixOut c) const {
    const Y now = y.local(q), velocity = y.N * v;
    const Jacobian J = jacobian(now);
    const Matrix<size, count> elastic =
        J.transpose() * coefficients(stiffness, rotational_stiffness).asDiagonal();
    const Matrix<size, count> viscous =
        J.transpose() * coefficients(damping, rotational_damping).asDiagonal();
    const Matrix<size, size> stiff =
        -elastic * J - viscous * jacobian(velocity) - hessian(resistance(J, now, velocity));
    add_tangent(y, stiff, k);
    add_tangent<size>(y, -viscous * J, c);
  }

  bool conservative() const { return true; }
  double potential(VectorIn q, double) const {
    const Y now = y.local(q);
    const Strains z = strains(jacobian(now), now);
    return 0.5 * z.cwiseAbs2().dot(coefficients(stiffness, rotational_stiffness));
  }

  double dissipation(VectorIn q, VectorIn v, double) const {
    const Y now = y.local(q), velocity = y.N * v;
    const Strains rate = jacobian(now) * velocity;
    return rate.cwiseAbs2().dot(coefficients(damping, rotational_damping));
  }
  ///@}

  /// @throws InvalidInput for frames without vectors, a stiffness or damping below zero, or a rest
  ///         that is not finite.
  void check() const {
    forces::check(from, "from");
    forces::check(to, "to");
    const auto positive = [](const char* what, const auto& value, const char* allowed) {
      expects(value.allFinite() && value.minCoeff() >= 0, what, value.transpose(), allowed);
    };
    positive("stiffness", stiffness, "zero or positive [N/m]");
    positive("rotational_stiffness", rotational_stiffness, "zero or positive [N m/rad]");
    positive("damping", damping, "zero or positive [N s/m]");
    positive("rotational_damping", rotational_damping, "zero or positive [N m s/rad]");
    expects(rest.allFinite(), "rest", rest.transpose(), "finite [m]");
  }

 private:
  static constexpr int place = RelativePosition<Dim>::size;
  static constexpr int size = Dim * (2 * Dim + 1);
  static constexpr int count = Dim + turns;
  using Y = Vector<size>;         // d, a_1, ..., b_1, ...
  using Strains = Vector<count>;  // a_i . d - rest_i, s_i
  using Jacobian = Matrix<count, size>;

  static Marker<size> both_frames(const Frame<Dim>& a, const Frame<Dim>& b) {
    const Marker<Dim> d = b.origin - a.origin;
    if constexpr (Dim == 2)
      return stacked(d, a.vectors[0], a.vectors[1], b.vectors[0], b.vectors[1]);
    else
      return stacked(d, a.vectors[0], a.vectors[1], a.vectors[2], b.vectors[0], b.vectors[1],
                     b.vectors[2]);
  }

  static Strains coefficients(const Vector<Dim>& along, const Vector<turns>& about) {
    Strains all;
    all << along, about;
    return all;
  }

  // The axes j and k of turn i, and where they begin in y.
  struct Pair {
    int aj, ak, bj, bk;
  };
  static Pair pair(int i) {
    const int j = Dim == 2 ? 0 : (i + 1) % 3, k = Dim == 2 ? 1 : (i + 2) % 3;
    return {Dim * (1 + j), Dim * (1 + k), Dim * (1 + Dim + j), Dim * (1 + Dim + k)};
  }

  Strains strains(const Jacobian& J, const Y& now) const {
    Strains z = 0.5 * J * now;
    z.template head<Dim>() -= rest;
    return z;
  }

  Strains resistance(const Jacobian& J, const Y& now, const Y& velocity) const {
    const Strains rate = J * velocity;
    return strains(J, now).cwiseProduct(coefficients(stiffness, rotational_stiffness)) +
           rate.cwiseProduct(coefficients(damping, rotational_damping));
  }

  // Strains are bilinear in y: their Jacobian is linear in it, their Hessian constant.
  static Jacobian jacobian(const Y& now) {
    Jacobian J = Jacobian::Zero();
    J.template topLeftCorner<Dim, place>() =
        RelativePosition<Dim>::jacobian(now.template head<place>());
    for (int i = 0; i < turns; ++i) {
      const Pair p = pair(i);
      const auto set = [&](int at, double factor, int axis) {
        J.template block<1, Dim>(Dim + i, at) =
            factor * now.template segment<Dim>(axis).transpose();
      };
      set(p.aj, -0.5, p.bk);
      set(p.ak, 0.5, p.bj);
      set(p.bj, 0.5, p.ak);
      set(p.bk, -0.5, p.aj);
    }
    return J;
  }

  static Matrix<size, size> hessian(const Strains& f) {
    Matrix<size, size> H = Matrix<size, size>::Zero();
    H.template topLeftCorner<place, place>() =
        RelativePosition<Dim>::hessian(f.template head<Dim>());
    for (int i = 0; i < turns; ++i) {
      const Pair p = pair(i);
      for (int n = 0; n < Dim; ++n) {
        H(p.ak + n, p.bj + n) = H(p.bj + n, p.ak + n) = 0.5 * f[Dim + i];
        H(p.aj + n, p.bk + n) = H(p.bk + n, p.aj + n) = -0.5 * f[Dim + i];
      }
    }
    return H;
  }
};

static_assert(Force<Bushing<2>> && Force<Bushing<3>>);

}  // namespace sphmbs::mbs::forces
