// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <sphmbs/core/transpose.hpp>
#include <sphmbs/core/vec.hpp>
#include <sphmbs/particles/fields.hpp>

namespace sphmbs::particles {

/// Stands in for the rest of positions that need none.
struct NoRest {};

/// What a pair sees of a particle at a stage of the time step, in number type N.
template <int Dim, class N>
struct Record {
  Vec<Dim, N> r;  ///< position [m]
  Vec<Dim, N> v;  ///< velocity [m/s]
  N rho;          ///< density [kg/m^3]
  N p;            ///< pressure [Pa]
  N c;            ///< sound speed [m/s]
  N h;            ///< smoothing length [m]
  N m;            ///< mass [kg]
  N shell;        ///< 1 for virtual particles, 0 for gas
  /// What rounding left of the position [m].
  std::conditional_t<splits_positions<Scalar<N>>, Vec<Dim, N>, NoRest> rest;
};

/// Moves a record to a position.
template <int Dim, class T>
SPHMBS_INLINE void set_place(Record<Dim, T>& record, const Vec<Dim>& x) {
  [[maybe_unused]] const Vec<Dim, T> rest = split(x, record.r);
  if constexpr (splits_positions<T>) record.rest = rest;
}

/// So many numbers or a few more, to fill 16 bytes: devices then read two or four at once.
template <class T>
constexpr int whole_words(int numbers) {
  constexpr int word = 16 / static_cast<int>(sizeof(T));
  return (numbers + word - 1) / word * word;
}

/// Numbers a record takes in memory: records lie one after the other, so that a pair touches one or
/// two cache lines of its neighbour instead of one a field.
template <int Dim, class T>
inline constexpr int record_size = whole_words<T>(2 * Dim + 6 + (splits_positions<T> ? Dim : 0));

namespace detail {

template <int Dim, class N>
SPHMBS_INLINE Record<Dim, N> unpack(const N* f) {
  Record<Dim, N> s;
#pragma GCC unroll 3
  for (int k = 0; k < Dim; ++k) {
    s.r[k] = f[k];
    s.v[k] = f[Dim + k];
  }
  s.rho = f[2 * Dim];
  s.p = f[2 * Dim + 1];
  s.c = f[2 * Dim + 2];
  s.h = f[2 * Dim + 3];
  s.m = f[2 * Dim + 4];
  s.shell = f[2 * Dim + 5];
  if constexpr (splits_positions<Scalar<N>>) {
#pragma GCC unroll 3
    for (int k = 0; k < Dim; ++k) s.rest[k] = f[2 * Dim + 6 + k];
  }
  return s;
}

}  // namespace detail

/// Record i.
template <int Dim, class T>
SPHMBS_INLINE Record<Dim, T> load_record(const T* records, std::size_t i) {
  const T* const f = records + i * record_size<Dim, T>;
  return detail::unpack<Dim>(static_cast<const T*>(__builtin_assume_aligned(f, 16)));
}

/// The records with W given indices, lane by lane.
template <int Dim, int W, class T>
SPHMBS_INLINE Record<Dim, Number<T, W>> load_records(const T* records, const std::uint32_t* index) {
  if constexpr (W == 1) {
    return load_record<Dim>(records, index[0]);
  } else {
    Pack<T, W> fields[record_size<Dim, T>];
    load_transposed(records, index, fields);
    return detail::unpack<Dim>(fields);
  }
}

/// Writes the record of particle i.
template <int Dim, class T>
SPHMBS_INLINE void store_record(T* records, std::size_t i, const Record<Dim, T>& s) {
  T* f = records + i * record_size<Dim, T>;
  for (int k = 0; k < Dim; ++k) {
    f[k] = s.r[k];
    f[Dim + k] = s.v[k];
  }
  f[2 * Dim] = s.rho;
  f[2 * Dim + 1] = s.p;
  f[2 * Dim + 2] = s.c;
  f[2 * Dim + 3] = s.h;
  f[2 * Dim + 4] = s.m;
  f[2 * Dim + 5] = s.shell;
  if constexpr (splits_positions<T>)
    for (int k = 0; k < Dim; ++k) f[2 * Dim + 6 + k] = s.rest[k];
}

}  // namespace sphmbs::particles
