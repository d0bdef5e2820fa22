// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace sphmbs::examples {

/// Table 2 of the paper: work of the walls and energy increase of the gas at a time [s], per metre
/// of depth [J/m].
struct CavityReference {
  double t, work, energy;
};

inline constexpr std::array<CavityReference, 8> cavity_paper{{{0.1, 2219, 2165},
                                                              {0.2, 4897, 4811},
                                                              {0.3, 8240, 8136},
                                                              {0.4, 12556, 12449},
                                                              {0.5, 18379, 18294},
                                                              {0.6, 26745, 26721},
                                                              {0.7, 39966, 40073},
                                                              {0.8, 64591, 64974}}};

}  // namespace sphmbs::examples
