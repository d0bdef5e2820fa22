// SPDX-License-Identifier: MIT
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "sphmbs refuses -ffast-math and -ffinite-math-only: they compile its checks for NaN away"
#endif

/// Marks every function that a particle loop calls. Inlining all of them is what lets device
/// compilers accept plain functors without annotating each one, and what keeps packs in registers.
#if defined(__CUDACC__)
#define SPHMBS_INLINE __host__ __device__ inline __attribute__((always_inline))
#else
#define SPHMBS_INLINE inline __attribute__((always_inline))
#endif

/// The same for a lambda: written after its parameter list.
#define SPHMBS_INLINE_LAMBDA __attribute__((always_inline))
