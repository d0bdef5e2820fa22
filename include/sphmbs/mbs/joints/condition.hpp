// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/joints/time_function.hpp>
#include <sphmbs/mbs/marker.hpp>

/// The two kinds of condition that all standard joints between a part a and a part b are made of.
namespace sphmbs::mbs::joints {

/// x_a(q) - x_b(q) - path(t) = 0, Dim conditions, linear in q.
template <int Dim>
struct Held {
  Marker<Dim> a;                   ///< point or vector of the first part
  Marker<Dim> b = Marker<Dim>();   ///< none: the ground
  Path<Dim> path = {};             ///< [m], or [-] of vectors
  bool points = true;              ///< whether these are points or vectors
  std::string label = "position";  ///< name in messages and reports
};

/// What a factor of a product is to the joint; the reaction depends on it.
enum class Role {
  fixed,        ///< a direction of the ground
  vector_of_a,  ///< a vector that turns with a
  vector_of_b,  ///< a vector that turns with b
  gap           ///< a point of a less a point of b
};

/// A vector in a product.
template <int Dim>
struct Factor {
  Marker<Dim> marker;  ///< the vector, or the difference of two points
  Role role;           ///< what it is to the joint
};

/// f(t) u(q).w(q).
template <int Dim>
struct Term {
  Factor<Dim> u;         ///< first factor
  Factor<Dim> w;         ///< second factor
  TimeFunction f = 1.0;  ///< weight
};

/// scale (sum of f(t) u(q).w(q) over the terms - c(t)) = 0, one condition, quadratic in q.
template <int Dim>
struct Product {
  std::vector<Term<Dim>> terms;  ///< summed
  TimeFunction c = 0.0;          ///< what the sum is to be
  double scale = 1;              ///< makes Phi a length [m], or of unit vectors
  std::string label;             ///< name in messages and reports
};

/// x at the coordinates q that its index counts.
template <int Dim>
Vector<Dim> value(const Marker<Dim>& x, VectorIn q) {
  Vector<Dim> sum = x.x0;
  for (int k = 0; k < x.N.cols(); ++k) sum += x.N.col(k) * q[x.index[static_cast<std::size_t>(k)]];
  return sum;
}

/// The same of the rates v.
template <int Dim>
Vector<Dim> rate(const Marker<Dim>& x, VectorIn v) {
  return value(x, v) - x.x0;
}

/// row += s d^T N, in the columns that x counts.
template <int Dim>
void add_row(const Marker<Dim>& x, const Vector<Dim>& d, MatrixOut phi_q, int row) {
  for (int k = 0; k < x.N.cols(); ++k)
    phi_q(row, x.index[static_cast<std::size_t>(k)]) += d.dot(x.N.col(k));
}

/// Whether all coordinates of one marker are coordinates of the other: points or vectors of one
/// rigid body, for example.
template <int Dim>
bool on_one_part(const Marker<Dim>& a, const Marker<Dim>& b) {
  if (a.index.empty() || b.index.empty()) return false;
  const std::size_t all = merged_index({a, b}).size();
  return all == merged_index({a}).size() || all == merged_index({b}).size();
}

/// @throws InvalidInput unless all numbers are finite.
template <int Dim>
void check(const Marker<Dim>& x) {
  expects(x.N.allFinite() && x.x0.allFinite(), "marker", x.x0.transpose(), "finite");
}

/// @throws InvalidInput unless two parts are joined and all is finite.
template <int Dim>
void check(const Held<Dim>& held) {
  check(held.a);
  check(held.b);
  held.path.check();
  expects(!on_one_part(held.a, held.b), held.label + ": parts joined", "one and the same",
          "two different ones");
  expects(!(held.a - held.b).N.isZero(0), held.label + ": coordinates", "none",
          "of a part that can move");
}

/// @throws InvalidInput unless something in it can move and all is finite.
template <int Dim>
void check(const Product<Dim>& product) {
  int moving = 0;
  for (const Term<Dim>& term : product.terms) {
    check(term.u.marker);
    check(term.w.marker);
    term.f.check();
    const bool both = (term.u.role == Role::vector_of_a && term.w.role == Role::vector_of_b) ||
                      (term.u.role == Role::vector_of_b && term.w.role == Role::vector_of_a);
    expects(!both || !on_one_part(term.u.marker, term.w.marker), product.label + ": parts joined",
            "one and the same", "two different ones");
    moving += term.u.marker.N.isZero(0) && term.w.marker.N.isZero(0) ? 0 : 1;
  }
  product.c.check();
  expects(product.scale > 0 && std::isfinite(product.scale), product.label + ": scale",
          product.scale, "positive");
  expects(moving > 0, product.label + ": coordinates", "none", "of a part that can move");
}

}  // namespace sphmbs::mbs::joints
