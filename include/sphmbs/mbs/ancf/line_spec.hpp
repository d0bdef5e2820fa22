// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <type_traits>

#include <sphmbs/mbs/part.hpp>
#include <sphmbs/mbs/placed.hpp>

namespace sphmbs::mbs::ancf {

/// Element that lines are made of: cables and beams.
template <class E>
concept LineElement = Element<E> && requires(E element, double x) {
  { element.length } -> std::same_as<double&>;
  { E::on_axis(x) } -> std::same_as<typename E::Material>;
  { element.shape_curvature(E::on_axis(x)) } -> std::same_as<Matrix<E::dim, E::dofs>>;
};

/// A vector at each place s of a line, and its derivative in s; s is the arc coordinate of the
/// unstretched line, from 0 to its length.
template <int Dim>
struct AlongLine {
  /// The vector at s.
  std::function<Vector<Dim>(double s)> value = {};
  /// Its derivative by s.
  std::function<Vector<Dim>(double s)> gradient = {};
};

/// A line of equal elements: straight from `from` to `to`, or of the shape of `curve`. It is free
/// of stress if its length is that of the straight line or of the curve.
///
///   {.from = O, .to = P, .elements = 24, .radius = 0.0015, .density = 5208, .youngs_modulus =
///   2e11}
template <LineElement E>
struct LineSpec {
  static constexpr int dim = E::dim;  ///< dimension of space
  /// Angular velocity: a number in the plane, a vector in space [rad/s].
  using Spin = std::conditional_t<dim == 2, double, Vector<3>>;

  Vector<dim> from = Vector<dim>::Zero();  ///< [m]
  Vector<dim> to = Vector<dim>::Zero();    ///< [m]
  int elements = 0;                        ///< how many, all of equal length

  double radius = 0;          ///< of a cable with circular section [m]
  double density = 0;         ///< [kg/m^3]
  double youngs_modulus = 0;  ///< [Pa]
  double damping = 0;         ///< relaxation time of Kelvin and Voigt [s]
  /// In place of these four: an element like the ones to make; its length is not read.
  std::optional<E> prototype = {};

  /// Unstretched length [m]; the distance between `from` and `to` unless given.
  std::optional<double> length = {};
  /// r(s) [m] and dr/ds [-], in place of `from` and `to`, which are then not read.
  AlongLine<dim> curve = {};
  /// Where the z axis of a beam's section points, as far as it is square to the line; not read for
  /// cables.
  Vector<dim> up = Vector<dim>::Unit(dim - 1);

  /// Rates at the start add up: those of a rigid motion, the spin being about the start of the
  /// line,
  Vector<dim> velocity = Vector<dim>::Zero();  ///< [m/s]
  /// [rad/s]
  Spin angular_velocity = [] {
    if constexpr (dim == 2)
      return 0.0;
    else
      return Vector<3>(Vector<3>::Zero());
  }();
  /// and given ones, dr/dt [m/s] with its derivative in s [1/s].
  AlongLine<dim> rates = {};

  /// Nodes that exist already, of this shape, to begin and to end with.
  std::optional<Node> first_node = {};  ///< node of the structure to start at, else a new one
  std::optional<Node> last_node = {};   ///< node of the structure to end at, else a new one
  /// Whether the last element ends at the node where the first begins; needs a curve.
  bool closed = false;
};

}  // namespace sphmbs::mbs::ancf
