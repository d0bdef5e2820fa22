// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <sphmbs/core/error.hpp>
#include <sphmbs/core/expects.hpp>
#include <sphmbs/mbs/constraint.hpp>
#include <sphmbs/mbs/force.hpp>
#include <sphmbs/mbs/placed.hpp>
#include <sphmbs/mbs/placement.hpp>

namespace sphmbs::mbs {

/// What a structure is made of.
template <class T>
concept Component = Element<T> || Body<T> || Constraint<T> || Force<T>;

/// How a structure keeps a component: parts with their place, the others as they are.
template <class T>
struct StoredAs {
  using type = T;  ///< what the structure keeps
};
/// Parts are kept with their nodes.
template <Part P>
struct StoredAs<P> {
  using type = Placed<P>;  ///< what the structure keeps
};

/// The first part among Types decides on the dimension.
template <class... Types>
constexpr int dimension_of() {
  int dim = 0;
  const auto look = [&]<class T>(std::type_identity<T>) {
    if constexpr (Part<T>)
      if (dim == 0) dim = T::dim;
  };
  (look(std::type_identity<Types>{}), ...);
  return dim;
}

/// Whether a component lives in space of this dimension.
template <class T>
constexpr bool fits(int dim) {
  if constexpr (Part<T>)
    return T::dim == dim;
  else
    return true;
}

/// A multibody model: bodies, elements, joints and forces of the given types, in plain arrays, one
/// array a type, over one list of coordinates q with rates v. What it is at t = 0 is what the adds
/// said; mbs::Dynamics moves it, mbs::Statics loads it.
///
///   mbs::Structure<ancf::Cable<2>, ncf::Bar, joints::Joint<2>> mechanism;
template <Component... Types>
class Structure {
 public:
  static constexpr int dim = dimension_of<Types...>();  ///< dimension of space
  static_assert(dim == 2 || dim == 3, "a structure has at least one part");
  static_assert((fits<Types>(dim) && ...), "all parts of a structure have the same dimension");

  Vector<dim> gravity = Vector<dim>::Zero();  ///< [m/s^2]

  /// New coordinates and their rates.
  /// @throws InvalidInput unless both are finite and of the same size.
  Node add_node(const VectorXd& q, const VectorXd& v) {
    const std::string name = "node " + std::to_string(nodes_.size());
    expects(q.size() > 0 && q.size() == v.size(), name + ": number of rates", v.size(),
            "the number of its coordinates, " + std::to_string(q.size()));
    expects(q.allFinite(), name + ": coordinates", q.transpose(), "finite");
    expects(v.allFinite(), name + ": rates", v.transpose(), "finite");
    const Node node{coordinates(), static_cast<int>(q.size())};
    q_.insert(q_.end(), q.begin(), q.end());
    v_.insert(v_.end(), v.begin(), v.end());
    nodes_.push_back(node);
    return node;
  }
  /// A node at rest.
  Node add_node(const VectorXd& q) { return add_node(q, VectorXd::Zero(q.size())); }

  /// A part between existing nodes.
  /// @throws InvalidInput naming the part and its nodes, for bad parameters, for nodes that do not
  ///         fit, and for an element without length or turned inside out.
  template <Part P>
  Placed<P> add(P part, const std::array<Node, static_cast<std::size_t>(P::nodes)>& nodes) {
    auto& parts = all<P>();
    const Placed<P> placed{part, nodes, static_cast<int>(parts.size())};
    const std::string name = name_of(placed);
    for (const Node& node : nodes)
      expects(
          node.size == P::node_dofs && node.offset >= 0 && node.offset + node.size <= coordinates(),
          name + ": size of its nodes", node.size,
          std::to_string(P::node_dofs) + " coordinates of this structure");
    checked(name, [&] {
      part.check();
      if constexpr (Traceable<P>)
        check_placement(part, placed.local(VectorXd::Map(q_.data(), coordinates())));
    });
    parts.push_back(placed);
    return placed;
  }

  /// A body with nodes of its own, where and as fast as its initial state says.
  template <Body B>
  Placed<B> add(B body) {
    checked(std::string(B::label) + " " + std::to_string(all<B>().size()), [&] { body.check(); });
    const Vector<B::dofs> q = body.initial_coordinates(), v = body.initial_rates();
    std::array<Node, static_cast<std::size_t>(B::nodes)> nodes;
    for (int i = 0; i < B::nodes; ++i)
      nodes[static_cast<std::size_t>(i)] =
          add_node(q.template segment<B::node_dofs>(i * B::node_dofs),
                   v.template segment<B::node_dofs>(i * B::node_dofs));
    return add(std::move(body), nodes);
  }

  /// A joint or a force.
  /// @return its number among those of its type
  /// @throws InvalidInput naming it, for bad parameters or markers of another structure.
  template <class T>
  requires(Constraint<T> || Force<T>) int add(T component) {
    const std::string name = component.name();
    checked(name, [&] { component.check(); });
    expects(!component.index().empty(), name + ": coordinates", "none", "of a part that can move");
    for (const int k : component.index())
      expects(k >= 0 && k < coordinates(), name + ": coordinate", k,
              "one of the " + std::to_string(coordinates()) + " of this structure");
    all<T>().push_back(std::move(component));
    return static_cast<int>(all<T>().size()) - 1;
  }

  /// All components of a type, in the order of the adds.
  template <class T>
  auto& all() {
    static_assert((std::is_same_v<T, Types> || ...), "add T to the types of Structure<...>, once");
    return std::get<std::vector<typename StoredAs<T>::type>>(components_);
  }
  /// All components of a type, in the order they were added.
  template <class T>
  const auto& all() const {
    static_assert((std::is_same_v<T, Types> || ...), "add T to the types of Structure<...>, once");
    return std::get<std::vector<typename StoredAs<T>::type>>(components_);
  }

  /// Calls `visit.template operator()<T>(components)`, with all components of type T, for each
  /// type.
  template <class Visit>
  void for_each_type(Visit&& visit) {
    (visit.template operator()<Types>(all<Types>()), ...);
  }
  /// Calls visit(components) for the components of each type.
  template <class Visit>
  void for_each_type(Visit&& visit) const {
    (visit.template operator()<Types>(all<Types>()), ...);
  }

  /// Sets all coordinates and rates at t = 0, for instance to an equilibrium.
  /// @throws InvalidInput unless they are as many as there are, and finite.
  void start_from(const VectorXd& q, const VectorXd& v) {
    expects(q.size() == coordinates() && v.size() == coordinates(), "number of coordinates",
            q.size(), std::to_string(coordinates()));
    expects(q.allFinite() && v.allFinite(), "coordinates and rates", "not finite", "finite");
    VectorXd::Map(q_.data(), coordinates()) = q;
    VectorXd::Map(v_.data(), coordinates()) = v;
  }
  /// Starts at rest from these coordinates.
  void start_from(const VectorXd& q) { start_from(q, VectorXd::Zero(q.size())); }

  /// @throws InvalidInput for a structure without parts, and for gravity that is not finite.
  void check() const {
    expects(coordinates() > 0, "structure: number of coordinates", 0, "1 or more: it needs a part");
    expects(gravity.allFinite(), "gravity", gravity.transpose(), "finite [m/s^2]");
  }

  /// Coordinates at t = 0, and their rates.
  VectorXd q() const { return VectorXd::Map(q_.data(), coordinates()); }
  /// Rates at the start.
  VectorXd v() const { return VectorXd::Map(v_.data(), coordinates()); }
  /// All nodes, in the order they were added.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Number of coordinates.
  int coordinates() const { return static_cast<int>(q_.size()); }
  /// Number of parts, joints and forces.
  std::size_t components() const { return (all<Types>().size() + ...); }

  /// What messages call a component: "cable 3 (nodes 3, 4)", "revolute 'knee'".
  template <Part P>
  std::string name_of(const Placed<P>& placed) const {
    std::string name = std::string(P::label) + " " + std::to_string(placed.number) + " (nodes";
    for (std::size_t i = 0; i < placed.nodes.size(); ++i)
      name += (i == 0 ? " " : ", ") + std::to_string(node_number(placed.nodes[i]));
    return name + ")";
  }
  /// What messages call a joint or a force.
  template <class T>
  requires(Constraint<T> || Force<T>) std::string name_of(const T& component)
  const { return component.name(); }

 private:
  int node_number(const Node& node) const {
    const auto place =
        std::lower_bound(nodes_.begin(), nodes_.end(), node.offset,
                         [](const Node& other, int offset) { return other.offset < offset; });
    return static_cast<int>(place - nodes_.begin());
  }

  template <class Check>
  static void checked(const std::string& name, Check&& check) {
    try {
      check();
    } catch (const InvalidInput& e) {
      throw InvalidInput(name + ": " + e.what());
    }
  }

  std::tuple<std::vector<typename StoredAs<Types>::type>...> components_;
  std::vector<Node> nodes_;
  std::vector<double> q_, v_;
};

}  // namespace sphmbs::mbs
