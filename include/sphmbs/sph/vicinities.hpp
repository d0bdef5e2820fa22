// SPDX-License-Identifier: MIT
#pragma once

#include <sphmbs/sph/slopes.hpp>

namespace sphmbs::sph {

namespace detail {

template <class T>
struct Clear {
  T* to;
  SPHMBS_INLINE void operator()(std::size_t i) const { to[i] = T(0); }
};

}  // namespace detail

/// Slopes of gas particles and surfaces of virtual ones, for schemes that need them; see
/// particles::load_vicinity.
template <class Scheme, class T, execution::ExecutionPolicy Policy>
class Vicinities {
 public:
  /// For n particles. Those that no loop writes, of virtual particles without a state, are zero.
  void resize(std::size_t n) {
    if constexpr (Scheme::vicinity) {
      stored_.resize_discarding(n * particles::slopes_size<Scheme::dim, T>);
      Policy::for_each(stored_.size(), detail::Clear<T>{stored_.data()});
    }
  }

  /// Evaluates the slopes of a stage, for n particles.
  /// @param rates  the EvaluateRates of the stage, for its neighbours and records
  template <class Rates>
  void evaluate(const Rates& rates, std::size_t n) {
    if constexpr (Scheme::vicinity)
      Policy::for_each(
          n, EvaluateSlopes<Scheme, T, Policy::template lanes<T>>{.space = rates.space,
                                                                  .from = rates.from,
                                                                  .set = rates.set,
                                                                  .vicinities = stored_.data(),
                                                                  .border = rates.border});
  }

  /// Null where the scheme needs none.
  T* data() { return stored_.data(); }
  /// Slopes and surfaces of all particles, for loops; null where the scheme needs none.
  const T* data() const { return stored_.data(); }
  /// Memory they take [bytes].
  std::size_t bytes() const { return stored_.bytes(); }

 private:
  using Stored = execution::Field<T, Policy>;
  Stored stored_;
};

}  // namespace sphmbs::sph
