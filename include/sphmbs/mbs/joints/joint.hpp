// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sphmbs/mbs/constraint.hpp>
#include <sphmbs/mbs/joints/condition.hpp>

namespace sphmbs::mbs::joints {

/// "revolute 'knee'", or "revolute" without a name.
inline std::string titled(std::string_view kind, std::string_view name) {
  return std::string(kind) + (name.empty() ? "" : " '" + std::string(name) + "'");
}

/// Any joint between points, vectors and gradients of parts and the ground that is at most
/// quadratic in q, as conditions of the two kinds of condition.hpp: first those held, then the
/// products. The functions in the other headers of this folder make the usual ones: pinned,
/// revolute, ...
template <int Dim>
class Joint {
 public:
  /// Joins what `held` and `products` name. @throws InvalidInput as check() does.
  Joint(std::string name, std::vector<Held<Dim>> held, std::vector<Product<Dim>> products = {})
      : name_(std::move(name)), held_(std::move(held)), products_(std::move(products)) {
    for_each_marker(
        [&](const Marker<Dim>& x) { index_.insert(index_.end(), x.index.begin(), x.index.end()); });
    std::sort(index_.begin(), index_.end());
    index_.erase(std::unique(index_.begin(), index_.end()), index_.end());
    for_each_marker([&](Marker<Dim>& x) {
      for (int& k : x.index)
        k = static_cast<int>(std::lower_bound(index_.begin(), index_.end(), k) - index_.begin());
    });
  }

  ///@{ As `Constraint` asks.
  const std::string& name() const { return name_; }
  const Index& index() const { return index_; }
  int conditions() const { return static_cast<int>(Dim * held_.size() + products_.size()); }
  ///@}

  /// Whether Phi is linear in q, so that add_hessian adds nothing.
  bool linear() const {
    for (const Product<Dim>& product : products_)
      for (const Term<Dim>& term : product.terms)
        if (term.u.marker.N.cols() > 0 && term.w.marker.N.cols() > 0) return false;
    return true;
  }

  /// What messages call condition `row`: "revolute 'knee': position y".
  std::string condition_name(int row) const {
    const int linear_rows = static_cast<int>(Dim * held_.size());
    if (row >= linear_rows)
      return name_ + ": " + products_[static_cast<std::size_t>(row - linear_rows)].label;
    return name_ + ": " + held_[static_cast<std::size_t>(row / Dim)].label + " " +
           std::string(1, "xyz"[row % Dim]);
  }

  /// @throws InvalidInput for a part joined to itself, nothing that can move, or NaN.
  void check() const {
    expects(conditions() > 0, "conditions", conditions(), "one or more");
    for (const Held<Dim>& held : held_) joints::check(held);
    for (const Product<Dim>& product : products_) joints::check(product);
  }

  /// Phi.
  void residual(VectorIn q, double t, VectorOut phi) const {
    int row = 0;
    for (const Held<Dim>& h : held_) {
      phi.template segment<Dim>(row) = value(h.a, q) - value(h.b, q) - h.path.value(t);
      row += Dim;
    }
    for (const Product<Dim>& p : products_) {
      double sum = -p.c.value(t);
      for (const Term<Dim>& term : p.terms)
        sum += term.f.value(t) * value(term.u.marker, q).dot(value(term.w.marker, q));
      phi[row++] = p.scale * sum;
    }
  }

  /// Phi_q.
  void jacobian(VectorIn q, double t, MatrixOut phi_q) const {
    int row = 0;
    for (const Held<Dim>& h : held_)
      for (int k = 0; k < Dim; ++k, ++row) {
        add_row<Dim>(h.a, Vector<Dim>::Unit(k), phi_q, row);
        add_row<Dim>(h.b, -Vector<Dim>::Unit(k), phi_q, row);
      }
    for (const Product<Dim>& p : products_) {
      for (const Term<Dim>& term : p.terms) {
        const double s = p.scale * term.f.value(t);
        add_row<Dim>(term.u.marker, s * value(term.w.marker, q), phi_q, row);
        add_row<Dim>(term.w.marker, s * value(term.u.marker, q), phi_q, row);
      }
      ++row;
    }
  }

  /// h += lambda scale f (N_u^T N_w + N_w^T N_u), for each product.
  void add_hessian(VectorIn, double t, VectorIn lambda, MatrixOut h) const {
    int row = static_cast<int>(Dim * held_.size());
    for (const Product<Dim>& p : products_) {
      for (const Term<Dim>& term : p.terms) {
        const double s = lambda[row] * p.scale * term.f.value(t);
        const Marker<Dim>&u = term.u.marker, &w = term.w.marker;
        for (int i = 0; i < u.N.cols(); ++i)
          for (int j = 0; j < w.N.cols(); ++j) {
            const double d = s * u.N.col(i).dot(w.N.col(j));
            const int a = u.index[static_cast<std::size_t>(i)];
            const int b = w.index[static_cast<std::size_t>(j)];
            h(a, b) += d;
            h(b, a) += d;
          }
      }
      ++row;
    }
  }

  /// Phi_t.
  void rate(VectorIn q, double t, VectorOut phi_t) const {
    int row = 0;
    for (const Held<Dim>& h : held_) {
      phi_t.template segment<Dim>(row) = -h.path.rate(t);
      row += Dim;
    }
    for (const Product<Dim>& p : products_) {
      double sum = -p.c.rate(t);
      for (const Term<Dim>& term : p.terms)
        sum += term.f.rate(t) * value(term.u.marker, q).dot(value(term.w.marker, q));
      phi_t[row++] = p.scale * sum;
    }
  }

  /// 2 Phi_qt v + Phi_tt.
  void acceleration(VectorIn q, VectorIn v, double t, VectorOut gamma) const {
    int row = 0;
    for (const Held<Dim>& h : held_) {
      gamma.template segment<Dim>(row) = -h.path.acceleration(t);
      row += Dim;
    }
    for (const Product<Dim>& p : products_) {
      double sum = -p.c.acceleration(t);
      for (const Term<Dim>& term : p.terms) {
        if (term.f.constant()) continue;
        const Vector<Dim> u = value(term.u.marker, q), w = value(term.w.marker, q);
        sum += 2 * term.f.rate(t) *
                   (u.dot(joints::rate(term.w.marker, v)) + w.dot(joints::rate(term.u.marker, v))) +
               term.f.acceleration(t) * u.dot(w);
      }
      gamma[row++] = p.scale * sum;
    }
  }

  /// The conditions; their markers count coordinates in the order of index().
  const std::vector<Held<Dim>>& held() const { return held_; }
  /// The conditions that are quadratic in q.
  const std::vector<Product<Dim>>& products() const { return products_; }

 private:
  template <class Visit>
  void for_each_marker(Visit&& visit) {
    for (Held<Dim>& h : held_) {
      visit(h.a);
      visit(h.b);
    }
    for (Product<Dim>& p : products_)
      for (Term<Dim>& term : p.terms) {
        visit(term.u.marker);
        visit(term.w.marker);
      }
  }

  std::string name_;
  Index index_;
  std::vector<Held<Dim>> held_;
  std::vector<Product<Dim>> products_;
};

}  // namespace sphmbs::mbs::joints
