// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sphmbs/mbs/joints/dual.hpp>
#include <sphmbs/mbs/joints/joint.hpp>

namespace sphmbs::mbs::joints {

/// Function that brings its own derivatives by x and t, as matrices of doubles:
///   jacobian(x, t)             m x n
///   hessian(x, t, lambda)      n x n, derivative of jacobian^T lambda
///   rate(x, t)                 m
///   acceleration(x, x', t)     m, as that of a Constraint
template <class F>
concept Differentiated = requires(const F f, const VectorXd x, double t) {
  { f.jacobian(x, t) } -> std::convertible_to<MatrixXd>;
  { f.hessian(x, t, x) } -> std::convertible_to<MatrixXd>;
  { f.rate(x, t) } -> std::convertible_to<VectorXd>;
  { f.acceleration(x, x, t) } -> std::convertible_to<VectorXd>;
};

/// What messages call relations by a function: F::kind, where it has one.
template <class F>
constexpr std::string_view kind_of() {
  if constexpr (requires { F::kind; }) {
    return F::kind;
  } else {
    return "relation";
  }
}

/// A user's own condition f(x, t) = 0 on quantities x = x0 + N q: coordinates as they are, or the
/// components of markers one below the other. F is callable with any scalar S,
///   f(const Eigen::Matrix<S, Dynamic, 1>& x, S t) -> vector of S, one a condition,
/// and is differentiated by forward automatic differentiation, in n (n + 1) / 2 calls for second
/// derivatives; a Differentiated F is called with double only. Unlike the standard joints it
/// allocates at each call.
template <class F>
class Relation {
 public:
  /// On the coordinates of the structure that `index` lists, in that order.
  Relation(std::string_view name, const Index& index, F f)
      : name_(titled(kind_of<F>(), name)),
        index_(index),
        N_(MatrixXd::Identity(size(index), size(index))),
        x0_(VectorXd::Zero(size(index))),
        f_(std::move(f)) {
    count();
  }

  /// On the components of markers.
  template <int Dim>
  Relation(std::string_view name, const std::vector<Marker<Dim>>& markers, F f)
      : name_(titled(kind_of<F>(), name)), f_(std::move(f)) {
    Marker<Dim> all;
    for (const Marker<Dim>& x : markers) all = all + x;
    index_ = all.index;
    N_.resize(Dim * static_cast<int>(markers.size()), size(index_));
    x0_.resize(N_.rows());
    int row = 0;
    for (const Marker<Dim>& x : markers) {
      N_.middleRows<Dim>(row) = over(index_, x).N;
      x0_.segment<Dim>(row) = x.x0;
      row += Dim;
    }
    count();
  }

  ///@{ As `Constraint` asks.
  const std::string& name() const { return name_; }
  const Index& index() const { return index_; }
  int conditions() const { return conditions_; }
  std::string condition_name(int row) const { return name_ + ": " + std::to_string(row + 1); }

  /// @throws InvalidInput for no coordinates, one listed twice, no conditions or NaN in the
  /// markers.
  void check() const {
    Index sorted = index_;
    std::sort(sorted.begin(), sorted.end());
    expects(!index_.empty(), "coordinates", "none", "one or more");
    const auto twin = std::adjacent_find(sorted.begin(), sorted.end());
    expects(twin == sorted.end(), "coordinate", twin == sorted.end() ? 0 : *twin, "listed once");
    expects(conditions_ > 0, "conditions", conditions_, "one or more");
    expects(N_.allFinite() && x0_.allFinite(), "marker", x0_.transpose(), "finite");
  }

  void residual(VectorIn q, double t, VectorOut phi) const { phi = VectorXd(f_(at(q), t)); }

  void jacobian(VectorIn q, double t, MatrixOut phi_q) const {
    const VectorXd x = at(q);
    MatrixXd phi_x(conditions_, x.size());
    if constexpr (Differentiated<F>) {
      phi_x = f_.jacobian(x, t);
    } else {
      for (int k = 0; k < x.size(); ++k) phi_x.col(k) = first(x, VectorXd::Unit(x.size(), k), t, 0);
    }
    phi_q += phi_x * N_;
  }

  void add_hessian(VectorIn q, double t, VectorIn lambda, MatrixOut h) const {
    const VectorXd x = at(q);
    const auto n = static_cast<int>(x.size());
    MatrixXd h_x(n, n);
    if constexpr (Differentiated<F>) {
      h_x = f_.hessian(x, t, VectorXd(lambda));
    } else {
      for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j)
          h_x(i, j) = h_x(j, i) =
              second(x, t, {VectorXd::Unit(n, i), 0}, {VectorXd::Unit(n, j), 0}).dot(lambda);
    }
    h += N_.transpose() * h_x * N_;
  }

  void rate(VectorIn q, double t, VectorOut phi_t) const {
    const VectorXd x = at(q);
    if constexpr (Differentiated<F>) {
      phi_t = f_.rate(x, t);
    } else {
      phi_t = first(x, VectorXd::Zero(x.size()), t, 1);
    }
  }

  void acceleration(VectorIn q, VectorIn v, double t, VectorOut gamma) const {
    const VectorXd x = at(q), x_rate = N_ * v;
    if constexpr (Differentiated<F>) {
      gamma = f_.acceleration(x, x_rate, t);
    } else {
      const Direction time{VectorXd::Zero(x.size()), 1};
      gamma = 2 * second(x, t, {x_rate, 0}, time) + second(x, t, time, time);
    }
  }
  ///@}

 private:
  struct Direction {
    VectorXd x;
    double t;
  };

  static int size(const Index& index) { return static_cast<int>(index.size()); }
  VectorXd at(VectorIn q) const { return x0_ + N_ * q; }
  void count() { conditions_ = static_cast<int>(VectorXd(f_(x0_, 0.0)).size()); }

  VectorXd first(const VectorXd& x, const VectorXd& along, double t, double along_t) const {
    Vector<Dynamic, Dual> seeded(x.size());
    for (int k = 0; k < x.size(); ++k) seeded[k] = dual(x[k], along[k]);
    const Vector<Dynamic, Dual> phi = f_(seeded, dual(t, along_t));
    return phi.unaryExpr([](const Dual& y) { return slope(y); });
  }

  VectorXd second(const VectorXd& x, double t, const Direction& a, const Direction& b) const {
    Vector<Dynamic, Dual2> seeded(x.size());
    for (int k = 0; k < x.size(); ++k) seeded[k] = dual2(x[k], a.x[k], b.x[k]);
    const Vector<Dynamic, Dual2> phi = f_(seeded, dual2(t, a.t, b.t));
    return phi.unaryExpr([](const Dual2& y) { return mixed(y); });
  }

  std::string name_;
  Index index_;
  MatrixXd N_;
  VectorXd x0_;
  F f_;
  int conditions_ = 0;
};

/// One coordinate of a structure, as the first component of a marker.
template <int Dim>
Marker<Dim> coordinate(int k) {
  return {.index = {k}, .N = Vector<Dim>::Unit(0)};
}

/// A factor times the component of a marker along a vector of the ground: factor.x.
template <int Dim>
struct Share {
  Vector<Dim> factor;  ///< direction along which x counts
  Marker<Dim> x;       ///< a point or vector
};

/// Sum of factor.x over markers = value(t): one condition, linear in q.
template <int Dim>
Joint<Dim> linear(const std::vector<Share<Dim>>& shares, const TimeFunction& value = 0.0,
                  std::string_view name = "") {
  Product<Dim> sum{.terms = {}, .c = value, .label = "linear"};
  for (const Share<Dim>& share : shares)
    sum.terms.push_back({{ground<Dim>(share.factor), Role::fixed}, {share.x, Role::gap}});
  return {titled("linear", name), {}, {sum}};
}

}  // namespace sphmbs::mbs::joints
