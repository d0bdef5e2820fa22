// SPDX-License-Identifier: MIT
#include <sphmbs/sphmbs.hpp>

#include <iostream>

int main() {
  std::cout << "sphmbs " << sphmbs::version << '\n';
  return std::cout.good() ? 0 : 1;
}
