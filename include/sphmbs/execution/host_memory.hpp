// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <new>

#include <unistd.h>

#include <sphmbs/execution/device.hpp>

namespace sphmbs::execution {

/// Memory of the policies that run on the host: aligned to cache lines, copies are plain copies.
struct HostMemory {
  ///@{ As `ExecutionPolicy` asks, for all policies of the host.
  static constexpr std::align_val_t alignment{64};
  static constexpr std::size_t chunk = 1024;

  static void* allocate(std::size_t bytes) { return ::operator new(bytes, alignment); }
  static void release(void* p) { ::operator delete(p, alignment); }
  static void upload(void* there, const void* here, std::size_t bytes) {
    if (bytes > 0) std::memcpy(there, here, bytes);
  }
  static void download(void* here, const void* there, std::size_t bytes) {
    upload(here, there, bytes);
  }

  static Device device() {
    const std::size_t memory = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                               static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
    return {.name = "the host", .memory = memory, .free = memory, .is_host = true};
  }
  ///@}
};

}  // namespace sphmbs::execution
