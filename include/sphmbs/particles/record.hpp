// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <sphmbs/core/transpose.hpp>
#include <sphmbs/core/vec.hpp>

namespace sphmbs::particles {

/// What a pair sees of a particle at a stage of the time step, in number type N.
template <int Dim, class N>
struct Record {
  Vec<Dim, N> r;  // position [m]
  Vec<Dim, N> v;  // velocity [m/s]
  N rho;          // density [kg/m^3]
  N p;            // pressure [Pa]
  N c;            // sound speed [m/s]
  N h;            // smoothing length [m]
  N m;            // mass [kg]
  N shell;        // 1 for virtual particles, 0 for gas
};

/// Numbers a record takes in memory: records lie one after the other, so that a pair touches one or
/// two cache lines of its neighbour instead of one a field.
template <int Dim>
inline constexpr int record_size = 2 * Dim + 6;

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
  return s;
}

}  // namespace detail

/// Record i.
template <int Dim, class T>
SPHMBS_INLINE Record<Dim, T> load_record(const T* records, std::size_t i) {
  return detail::unpack<Dim>(records + i * record_size<Dim>);
}

/// The records with W given indices, lane by lane.
template <int Dim, int W, class T>
SPHMBS_INLINE Record<Dim, Number<T, W>> load_records(const T* records, const std::uint32_t* index) {
  if constexpr (W == 1) {
    return load_record<Dim>(records, index[0]);
  } else {
    Pack<T, W> fields[record_size<Dim>];
    load_transposed(records, index, fields);
    return detail::unpack<Dim>(fields);
  }
}

template <int Dim, class T>
SPHMBS_INLINE void store_record(T* records, std::size_t i, const Record<Dim, T>& s) {
  T* f = records + i * record_size<Dim>;
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
}

}  // namespace sphmbs::particles
