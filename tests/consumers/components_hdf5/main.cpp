// SPDX-License-Identifier: MIT
// Somebody else's program that keeps its results in run.h5, which docs/hdf5.md reads.
#include <array>
#include <cstdio>
#include <vector>

#include <sphmbs/io/hdf5.hpp>
#include <sphmbs/io/pvd.hpp>

using namespace sphmbs;

int main() {
  try {
    io::PvdCollection("run.pvd");
    io::Hdf5Series series("run.h5", "a column that is heated");
    const std::vector<double> points{0, 0, 0, 1, 0, 0, 2, 0, 0}, node{0.5, 0, 0};
    for (int k = 0; k < 5; ++k) {
      const std::vector<io::PointArray> of_gas{
          {"pressure [Pa]", 1, std::vector<double>{1e5, 1e5 + k, 1e5 + 2 * k}},
          {"velocity [m/s]", 3, std::vector<float>(9, 0.0F)}};
      const std::array<io::Hdf5Part, 2> parts{{{"gas", points, of_gas}, {"bodies", node, {}}}};
      series.add(0.25 * k, parts);
    }
    series.close();
  } catch (const Error& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 2;
  }
}
