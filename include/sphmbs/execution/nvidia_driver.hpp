// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include <dlfcn.h>

#include <sphmbs/execution/device.hpp>

namespace sphmbs::execution::detail {

/// Name and memory of a GPU by its number, asked of NVIDIA's driver, where there is one: OpenMP
/// does not tell them.
inline std::optional<Device> ask_nvidia_driver(int number) {
  void* const driver = dlopen("libcuda.so.1", RTLD_LAZY | RTLD_LOCAL);
  if (driver == nullptr) return std::nullopt;
  // The driver's functions return 0 where all is well; devices are numbers.
  const auto init = reinterpret_cast<int (*)(unsigned)>(dlsym(driver, "cuInit"));
  const auto get = reinterpret_cast<int (*)(int*, int)>(dlsym(driver, "cuDeviceGet"));
  const auto get_name =
      reinterpret_cast<int (*)(char*, int, int)>(dlsym(driver, "cuDeviceGetName"));
  const auto get_memory =
      reinterpret_cast<int (*)(std::size_t*, int)>(dlsym(driver, "cuDeviceTotalMem_v2"));
  if (init == nullptr || get == nullptr || get_name == nullptr || get_memory == nullptr)
    return std::nullopt;
  int device = 0;
  char name[256] = {};
  std::size_t memory = 0;
  if (init(0) != 0 || get(&device, number) != 0 || get_name(name, sizeof name - 1, device) != 0 ||
      get_memory(&memory, device) != 0)
    return std::nullopt;
  return Device{.name = name, .memory = memory, .free = memory};
}

}  // namespace sphmbs::execution::detail
