// SPDX-License-Identifier: MIT
// Loops of OpenMP that the thread sanitizer must judge: race [racy]
#include <cstdio>
#include <vector>

int main(int argc, char**) {
  std::vector<int> numbers(4000);
  int sum = 0, together = 0;
#pragma omp parallel for num_threads(2)
  for (int i = 0; i < 4000; ++i) numbers[static_cast<std::size_t>(i)] = i;
    // Reads what another thread has written: no race, since loops wait for each other.
#pragma omp parallel for num_threads(2) reduction(+ : sum)
  for (int i = 0; i < 4000; ++i) sum += numbers[static_cast<std::size_t>(3999 - i)];
  if (argc > 1) {
#pragma omp parallel for num_threads(2)
    for (int i = 0; i < 4000; ++i) together += numbers[static_cast<std::size_t>(i)];
  }
  std::printf("%d %d\n", sum, together);
}
