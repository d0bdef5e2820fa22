// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <sphmbs/core/vec.hpp>

/// The gas's data: one array a field (structure of arrays), resident where the loops run.
namespace sphmbs::particles {

/// What a virtual particle is of a thin body: nothing; seen from the side its normal points to; and
/// a patch that gas on one side does not see gas on the other through.
inline constexpr std::uint8_t no_sheet = 0;
inline constexpr std::uint8_t sheet_layer = 1;  ///< of a thin body, seen from one side alone
/// A patch of a thin body, through which the two sides do not see each other.
inline constexpr std::uint8_t sheet_patch = 2;

/// Set number of gas particles; virtual particles (walls and bodies) have sets 1, 2, ..., openings
/// those from `first_opening` on.
inline constexpr std::uint8_t gas = 0;
inline constexpr int first_opening = 192;  ///< set of the first opening

/// Whether a set is that of an opening.
SPHMBS_INLINE constexpr bool is_opening(std::uint8_t set) { return set >= first_opening; }
/// Whether a set is one of virtual particles.
SPHMBS_INLINE constexpr bool is_virtual(std::uint8_t set) { return set != gas && !is_opening(set); }
/// Number of the opening whose set this is.
SPHMBS_INLINE constexpr int opening_of(std::uint8_t set) { return set - first_opening; }
/// Set of an opening.
SPHMBS_INLINE constexpr std::uint8_t opening_set(int opening) {
  return static_cast<std::uint8_t>(first_opening + opening);
}

/// Whether positions are kept in two numbers, what T holds of them and the rest: a float alone
/// would round them to some 1e-4 of a spacing in a domain of a thousand spacings, and forces with
/// them.
template <class T>
inline constexpr bool splits_positions = sizeof(T) < sizeof(double);

/// The rest of a position where T does not hold all of it; `rounded` is set to what it holds. By
/// the bits: in packs of two, GCC 12 takes the way to float and back for no change.
template <int Dim, class T>
SPHMBS_INLINE Vec<Dim, T> split(const Vec<Dim>& x, Vec<Dim, T>& rounded) {
  Vec<Dim, T> rest = Vec<Dim, T>::all(T(0));
  for (int k = 0; k < Dim; ++k) {
    if constexpr (splits_positions<T>) {
      constexpr std::uint64_t beyond_float = (std::uint64_t{1} << 29) - 1;
      std::uint64_t bits;
      __builtin_memcpy(&bits, &x.component[k], sizeof bits);
      bits &= ~beyond_float;
      double held;
      __builtin_memcpy(&held, &bits, sizeof held);
      rounded[k] = static_cast<T>(held);
      rest[k] = static_cast<T>(x[k] - held);
    } else {
      rounded[k] = x[k];
    }
  }
  return rest;
}

/// The state at the beginning of the step, as pointers that loop bodies see. Planar gas is per
/// metre of depth: m in kg/m; on a line per square metre of section: kg/m^2.
template <int Dim, class T>
struct FieldsView {
  T* r[Dim];       ///< position [m]
  T* rest[Dim];    ///< what rounding to T left of the position [m]; null where T is double
  T* v[Dim];       ///< velocity [m/s]
  T* rho;          ///< density [kg/m^3]
  T* e;            ///< specific internal energy [J/kg]
  T* h;            ///< smoothing length [m]
  T* m;            ///< mass [kg]
  T* normal[Dim];  ///< of the surface a virtual particle lies behind, out of the solid; null if
                   ///< none
  T* depth;        ///< of a virtual particle below its surface [m]; null if none
  T* patch;  ///< width of the patch of a thin body that a virtual particle is [m]; null if none
  std::uint8_t* sheet;  ///< what a virtual particle is of a thin body; null if there is none
  std::uint32_t*
      id;  ///< place in the initial cloud, or later ones for gas that comes in; never changes
  std::uint8_t* set;  ///< gas, which set of virtual particles, or which opening

  /// Of particle i, rounded to T [m].
  SPHMBS_INLINE Vec<Dim, T> position(std::size_t i) const { return at(r, i); }
  /// Of particle i [m/s].
  SPHMBS_INLINE Vec<Dim, T> velocity(std::size_t i) const { return at(v, i); }
  /// Of the surface before virtual particle i.
  SPHMBS_INLINE Vec<Dim, T> normal_at(std::size_t i) const { return at(normal, i); }
  /// The position in full.
  SPHMBS_INLINE Vec<Dim> place(std::size_t i) const {
    Vec<Dim> x = position(i).template to<double>();
    if constexpr (splits_positions<T>) x += at(rest, i).template to<double>();
    return x;
  }
  /// Stores a place in full, as place() reads it [m].
  SPHMBS_INLINE void set_place(std::size_t i, const Vec<Dim>& x) const {
    Vec<Dim, T> rounded;
    const Vec<Dim, T> left = split(x, rounded);
    put(r, i, rounded);
    if constexpr (splits_positions<T>) put(rest, i, left);
  }
  /// Stores a velocity [m/s].
  SPHMBS_INLINE void set_velocity(std::size_t i, const Vec<Dim, T>& x) const { put(v, i, x); }

  /// Entry i of a field of vectors.
  static SPHMBS_INLINE Vec<Dim, T> at(T* const (&field)[Dim], std::size_t i) {
    Vec<Dim, T> x;
    for (int k = 0; k < Dim; ++k) x[k] = field[k][i];
    return x;
  }
  /// Stores entry i of a field of vectors.
  static SPHMBS_INLINE void put(T* const (&field)[Dim], std::size_t i, const Vec<Dim, T>& x) {
    for (int k = 0; k < Dim; ++k) field[k][i] = x[k];
  }
};

/// Rates of change, the left-hand sides of eq. (26), or a weighted sum of them over the stages of a
/// step. Virtual particles, whose motion is prescribed, have at the last stage alone: in `v` the
/// force of the gas on the particle by its mass, and in `r[0]`, by its mass, the power of other
/// virtual particles on it or, for wall models with surfaces, what the gas gets from it less than
/// the work of that force [W/kg].
template <int Dim, class T>
struct RatesView {
  T* r[Dim];             ///< [m/s], eq. (14)
  T* v[Dim];             ///< [m/s^2], eq. (21)
  T* rho;                ///< [kg/(m^3 s)], eq. (20)
  T* e;                  ///< [W/kg], eq. (22)
  T* h;                  ///< [m/s], eq. (23)
  std::uint16_t* pairs;  ///< neighbours inside the support at the last evaluation
  std::uint16_t* falls;  ///< of them those whose reconstruction was refused
  // What the gas does to particles of openings, by their mass, at the last stage; null if none are.
  T* push[Dim];  ///< force [m/s^2]
  T* heating;    ///< power, less the work of that force [W/kg]

  /// Adds to a rate whose earlier stages have the weight `keep`; with 0 they are not read.
  static SPHMBS_INLINE void write(T* rate, std::size_t i, T value, T keep) {
    rate[i] = keep != T(0) ? keep * rate[i] + value : value;
  }
};

}  // namespace sphmbs::particles
