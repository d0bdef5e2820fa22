// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <sphmbs/core/error.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/ancf/line_spec.hpp>
#include <sphmbs/mbs/ancf/section.hpp>
#include <sphmbs/mbs/structure.hpp>

namespace sphmbs::mbs::ancf {

/// The elements of a line in a structure, in order from its start to its end.
template <LineElement E>
struct Line {
  static constexpr int dim = E::dim;  ///< dimension of space

  /// Place on the line: x [m] on an element.
  struct Place {
    int element;  ///< which one, counted from 0 at the start of the line
    double x;     ///< arc coordinate in that element [m]
  };

  std::vector<Placed<E>> elements;  ///< from the start of the line to its end
  double length;                    ///< unstretched [m]

  /// Where s is, from 0 at the start to length at the end. At a border it is the element that
  /// begins there; beyond the ends, the first or the last one, with x outside of it.
  Place locate(double s) const {
    const int n = static_cast<int>(elements.size());
    const double h = length / n;
    const int element = static_cast<int>(std::clamp(std::floor(s / h), 0.0, n - 1.0));
    return {element, s - element * h};
  }

  /// The point at s, and dr/ds there.
  /// @throws InvalidInput unless s is on the line.
  Marker<dim> point(double s) const {
    const Place place = on_line(s);
    return at(place).point(E::on_axis(place.x));
  }
  /// r' at arc coordinate s [m] of the line: a vector that moves with it.
  Marker<dim> gradient(double s) const {
    const Place place = on_line(s);
    return at(place).gradient(E::on_axis(place.x), 0);
  }

  /// The point at s = 0.
  Marker<dim> start() const { return elements.front().start(); }
  /// The point at the end of the line.
  Marker<dim> end() const { return elements.back().end(); }

 private:
  const Placed<E>& at(const Place& place) const {
    return elements[static_cast<std::size_t>(place.element)];
  }
  Place on_line(double s) const {
    expects(s >= 0 && s <= length, "line: s", s, "from 0 to its length, in [m]");
    return locate(s);
  }
};

namespace detail {

/// The element that a call of line() means: E, or where that is void the first among Types that
/// lines can be made of.
template <class E, class First, class... Types>
auto line_element() {
  if constexpr (!std::is_void_v<E>)
    return std::type_identity<E>{};
  else if constexpr (LineElement<First>)
    return std::type_identity<First>{};
  else
    return line_element<E, Types...>();
}
template <class E, class... Types>
using LineElementOf = typename decltype(line_element<E, Types...>())::type;

/// omega x r.
inline Vector<2> turned(double omega, const Vector<2>& r) { return omega * Vector<2>(-r[1], r[0]); }
inline Vector<3> turned(const Vector<3>& omega, const Vector<3>& r) { return omega.cross(r); }

/// Where the line runs, with its unstretched length.
template <class E>
std::pair<AlongLine<E::dim>, double> line_shape(const LineSpec<E>& spec) {
  using Vec = Vector<E::dim>;
  expects(spec.from.allFinite(), "line: from", spec.from.transpose(), "finite [m]");
  expects(spec.to.allFinite(), "line: to", spec.to.transpose(), "finite [m]");
  const bool curved = static_cast<bool>(spec.curve.value);
  expects(curved == static_cast<bool>(spec.curve.gradient), "line: curve", "half of it",
          "given with its value and its gradient, or not at all");
  expects(!curved || spec.length, "line: length", "missing", "given with a curve [m]");
  const double length = spec.length.value_or((spec.to - spec.from).norm());
  expects(std::isfinite(length) && length > 0, "line: length", length, "positive [m]");
  if (curved) return {spec.curve, length};
  const Vec from = spec.from, slope = (spec.to - spec.from) / length;
  expects(slope.norm() > 0, "line: distance between from and to", 0, "positive [m]");
  return {{.value = [=](double s) -> Vec { return from + s * slope; },
           .gradient = [=](double) { return slope; }},
          length};
}

/// One of its elements.
template <class E>
E line_element_of(const LineSpec<E>& spec, double length) {
  const bool section = spec.radius != 0 || spec.density != 0 || spec.youngs_modulus != 0;
  E element;
  if (spec.prototype) {
    expects(!section && spec.damping == 0, "line: prototype", "given",
            "given without radius, density, youngs_modulus and damping");
    element = *spec.prototype;
  } else if constexpr (requires { E::of(length, CircularSection{}, 0.0); }) {
    const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
    expects(positive(spec.radius), "line: radius", spec.radius,
            "positive [m], or a prototype given");
    expects(positive(spec.density), "line: density", spec.density, "positive [kg/m^3]");
    expects(positive(spec.youngs_modulus), "line: youngs_modulus", spec.youngs_modulus,
            "positive [Pa]");
    element = E::of(
        length,
        {.radius = spec.radius, .density = spec.density, .youngs_modulus = spec.youngs_modulus},
        spec.damping);
  } else {
    throw InvalidInput("line: prototype = missing: must be given for this element");
  }
  element.length = length;
  return element;
}

/// Coordinates of the node at s.
template <class E>
Vector<E::node_dofs> line_node(const LineSpec<E>& spec, const AlongLine<E::dim>& shape, double s) {
  Vector<E::node_dofs> q;
  const Vector<E::dim> slope = shape.gradient(s);
  q.template head<E::dim>() = shape.value(s);
  q.template segment<E::dim>(E::dim) = slope;
  if constexpr (E::node_dofs == 12) {  // a beam: its directors are square to the axis
    const Vector<3> along = slope.normalized(), side = spec.up.cross(along);
    expects(side.norm() > 1e-6 * spec.up.norm(), "line: up", spec.up.transpose(),
            "a vector that is not along the line");
    q.template tail<6>() << side.normalized(), along.cross(side.normalized());
  }
  return q;
}

/// Their rates.
template <class E>
Vector<E::node_dofs> line_node_rate(const LineSpec<E>& spec, const Vector<E::node_dofs>& q,
                                    const Vector<E::dim>& start, double s) {
  Vector<E::node_dofs> v;
  for (int k = 0; k < E::node_dofs; k += E::dim) {
    const Vector<E::dim> x = q.template segment<E::dim>(k);
    v.template segment<E::dim>(k) = turned(spec.angular_velocity, k == 0 ? x - start : x);
  }
  v.template head<E::dim>() += spec.velocity;
  if (spec.rates.value) {
    v.template head<E::dim>() += spec.rates.value(s);
    v.template segment<E::dim>(E::dim) += spec.rates.gradient(s);
  }
  return v;
}

/// @throws InvalidInput unless a node that exists already is where the line needs it.
inline void expect_node(const std::string& name, const Node& node, const VectorXd& all,
                        const VectorXd& needed, double length) {
  expects(node.size == needed.size() && node.offset >= 0 && node.offset + node.size <= all.size(),
          "line: size of the " + name, node.size, std::to_string(needed.size()) + " coordinates");
  const Eigen::IOFormat row(Eigen::StreamPrecision, Eigen::DontAlignCols);
  std::ostringstream allowed;
  allowed << "those of the line there, " << needed.transpose().format(row);
  const VectorXd q = all.segment(node.offset, node.size);
  expects((q - needed).norm() <= 1e-9 * (length + needed.norm()),
          "line: coordinates of the " + name, q.transpose().format(row), allowed.str());
}

}  // namespace detail

/// Makes a line in a structure, of elements of type E; where E is not given, of the first cable or
/// beam among the types of the structure.
/// @throws InvalidInput for a line without length or elements, for values that are not finite or
/// out of range, and for existing nodes that are somewhere else; messages of a single element name
/// it with its nodes.
template <class E = void, class... Types>
auto line(Structure<Types...>& structure,
          const LineSpec<detail::LineElementOf<E, Types...>>& spec) {
  using Made = detail::LineElementOf<E, Types...>;
  expects(spec.elements > 0, "line: elements", spec.elements, "1 or more");
  expects(static_cast<bool>(spec.rates.value) == static_cast<bool>(spec.rates.gradient),
          "line: rates", "half of them",
          "given with their value and their gradient, or not at all");
  expects(!spec.closed || (spec.curve.value && !spec.first_node && !spec.last_node), "line: closed",
          spec.closed, "false without a curve, or with nodes to begin or end with");
  const auto course = detail::line_shape(spec);  // no structured binding: lambdas use it
  const auto& shape = course.first;
  const double length = course.second;
  const Made element = detail::line_element_of(spec, length / spec.elements);

  const Vector<Made::dim> start = shape.value(0);
  std::vector<Node> nodes;
  for (int i = 0; i <= spec.elements; ++i) {
    const double s = i == spec.elements ? length : i * element.length;
    const Vector<Made::node_dofs> q = detail::line_node(spec, shape, s);
    const auto meets = [&](const std::string& name, const Node& node) {
      detail::expect_node(name, node, structure.q(), q, length);
      nodes.push_back(node);
    };
    if (i == 0 && spec.first_node)
      meets("first node", *spec.first_node);
    else if (i == spec.elements && spec.last_node)
      meets("last node", *spec.last_node);
    else if (i == spec.elements && spec.closed)
      meets("node that closes the loop", Node(nodes.front()));
    else
      nodes.push_back(structure.add_node(q, detail::line_node_rate(spec, q, start, s)));
  }

  Line<Made> made{.elements = {}, .length = length};
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    made.elements.push_back(structure.add(element, std::array{nodes[i], nodes[i + 1]}));
  return made;
}

}  // namespace sphmbs::mbs::ancf
