// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <sphmbs/core/transpose.hpp>
#include <sphmbs/core/vec.hpp>
#include <sphmbs/particles/record.hpp>

namespace sphmbs::particles {

/// First derivatives of the gas at a particle.
template <int Dim, class N>
struct Slopes {
  Vec<Dim, N> rho;     ///< of density [kg/m^4]
  Vec<Dim, N> p;       ///< of pressure [Pa/m]
  Vec<Dim, N> v[Dim];  ///< of each component of velocity [1/s]
};

/// The surface that a virtual particle lies behind.
template <int Dim, class N>
struct Surface {
  Vec<Dim, N> normal;  ///< unit vector, out of the solid into the gas [-]
  N depth;             ///< of the particle below the surface [m]
};

/// Numbers that either of the two takes in memory. A gas particle has slopes, a virtual particle a
/// surface.
template <int Dim, class T>
inline constexpr int slopes_size = whole_words<T>(Dim*(Dim + 2) < 4 ? 4 : Dim * (Dim + 2));

namespace detail {

template <int Dim, class N>
SPHMBS_INLINE Slopes<Dim, N> unpack_slopes(const N* f) {
  Slopes<Dim, N> s;
#pragma GCC unroll 3
  for (int k = 0; k < Dim; ++k) {
    s.rho[k] = f[k];
    s.p[k] = f[Dim + k];
#pragma GCC unroll 3
    for (int j = 0; j < Dim; ++j) s.v[j][k] = f[(2 + j) * Dim + k];
  }
  return s;
}

template <int Dim, class N>
SPHMBS_INLINE Surface<Dim, N> unpack_surface(const N* f) {
  Surface<Dim, N> s;
#pragma GCC unroll 3
  for (int k = 0; k < Dim; ++k) s.normal[k] = f[k];
  s.depth = f[Dim];
  return s;
}

}  // namespace detail

/// Both readings of what is stored for a particle; which one holds, its record says.
template <int Dim, class N>
struct Vicinity {
  Slopes<Dim, N> slopes;    ///< of gas
  Surface<Dim, N> surface;  ///< before a virtual particle
};

/// Of particle i.
template <int Dim, class T>
SPHMBS_INLINE Vicinity<Dim, T> load_vicinity(const T* stored, std::size_t i) {
  const T* f =
      static_cast<const T*>(__builtin_assume_aligned(stored + i * slopes_size<Dim, T>, 16));
  return {detail::unpack_slopes<Dim>(f), detail::unpack_surface<Dim>(f)};
}

/// Of the particles with W given indices, lane by lane.
template <int Dim, int W, class T>
SPHMBS_INLINE Vicinity<Dim, Number<T, W>> load_vicinities(const T* stored,
                                                          const std::uint32_t* index) {
  if constexpr (W == 1) {
    return load_vicinity<Dim>(stored, index[0]);
  } else {
    Pack<T, W> f[slopes_size<Dim, T>];
    load_transposed(stored, index, f);
    return {detail::unpack_slopes<Dim>(f), detail::unpack_surface<Dim>(f)};
  }
}

/// Writes the slopes at particle i.
template <int Dim, class T>
SPHMBS_INLINE void store_slopes(T* stored, std::size_t i, const Slopes<Dim, T>& s) {
  T* f = stored + i * slopes_size<Dim, T>;
#pragma GCC unroll 3
  for (int k = 0; k < Dim; ++k) {
    f[k] = s.rho[k];
    f[Dim + k] = s.p[k];
#pragma GCC unroll 3
    for (int j = 0; j < Dim; ++j) f[(2 + j) * Dim + k] = s.v[j][k];
  }
}

/// Writes the surface before virtual particle i.
template <int Dim, class T>
SPHMBS_INLINE void store_surface(T* stored, std::size_t i, const Surface<Dim, T>& s) {
  T* f = stored + i * slopes_size<Dim, T>;
  for (int k = 0; k < Dim; ++k) f[k] = s.normal[k];
  f[Dim] = s.depth;
}

}  // namespace sphmbs::particles
