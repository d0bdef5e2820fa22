// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include <sphmbs/neighbours/neighbour_search.hpp>
#include <sphmbs/particles/particles.hpp>

/// What lies in a policy's memory, copied to the host: tests never read a device's memory itself.
namespace test {

template <class Policy, class U>
std::vector<U> fetch(const U* there, std::size_t n) {
  std::vector<U> here(n);
  if (there != nullptr) Policy::download(here.data(), there, n * sizeof(U));
  return here;
}

/// State and marks of particles.
template <int Dim, class T, class Policy>
class FieldsOnHost {
 public:
  explicit FieldsOnHost(sphmbs::particles::Particles<Dim, T, Policy>& particles)
      : view_(particles.fields()) {
    const std::size_t n = particles.size();
    const auto copy = [&](auto& kept, auto*& field) {
      kept.push_back(fetch<Policy>(field, n));
      field = kept.back().data();
    };
    for (int k = 0; k < Dim; ++k)
      for (T** field : {&view_.r[k], &view_.rest[k], &view_.v[k]}) copy(numbers_, *field);
    for (T** field : {&view_.rho, &view_.e, &view_.h, &view_.m}) copy(numbers_, *field);
    copy(ids_, view_.id);
    copy(sets_, view_.set);
  }
  FieldsOnHost(const FieldsOnHost&) = delete;

  const sphmbs::particles::FieldsView<Dim, T>* operator->() const { return &view_; }

 private:
  sphmbs::particles::FieldsView<Dim, T> view_;
  std::deque<std::vector<T>> numbers_;
  std::deque<std::vector<std::uint32_t>> ids_;
  std::deque<std::vector<std::uint8_t>> sets_;
};

/// Calls pair(id_a, id_b) for all that are listed, in their order.
template <class Policy, class Pair>
void for_listed(const sphmbs::neighbours::NeighbourView& view, const std::uint32_t* ids,
                std::size_t n, const Pair& pair) {
  const auto first = fetch<Policy>(view.first, n + 1), last = fetch<Policy>(view.last, n);
  const auto list = fetch<Policy>(view.list, first[n]);
  const auto id = fetch<Policy>(ids, n);
  for (std::size_t a = 0; a < n; ++a)
    for (std::uint64_t k = first[a]; k < last[a]; ++k) pair(id[a], id[list[k]]);
}

}  // namespace test
