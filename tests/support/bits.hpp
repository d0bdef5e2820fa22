// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <vector>

namespace test {

/// Equal to the last bit: NaN equals itself, and 0 is not -0.
template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace test
