// SPDX-License-Identifier: MIT
#pragma once

#if !defined(_OPENACC)
#error \
    "execution::OpenACC needs an OpenACC compiler: link sphmbs::openacc, or compile with -fopenacc"
#endif

#include <cstddef>

#include <openacc.h>

#include <sphmbs/execution/device.hpp>
#include <sphmbs/execution/device_memory.hpp>
#include <sphmbs/execution/execution_policy.hpp>
#include <sphmbs/execution/serial.hpp>

namespace sphmbs::execution {

namespace detail {

struct AccMemory {
  static bool on_host() {
    const acc_device_t type = acc_get_device_type();
    return type == acc_device_host || type == acc_device_none;
  }
  static void require() {
    if (on_host() && !environment_says("ACC_DEVICE_TYPE", "host"))
      no_device("openacc",
                "GCC's OpenACC looks for an NVIDIA driver (libcuda.so.1) and for its own "
                "libgomp-plugin-nvptx.so.1; ACC_DEVICE_TYPE=host runs the same loops on one thread "
                "of the host");
  }
  static void* allocate(std::size_t bytes) { return acc_malloc(bytes); }
  static void release(void* block) { acc_free(block); }
  static void to_device(void* there, const void* here, std::size_t bytes) {
    acc_memcpy_to_device(there, const_cast<void*>(here), bytes);
  }
  static void to_host(void* here, const void* there, std::size_t bytes) {
    acc_memcpy_from_device(here, const_cast<void*>(there), bytes);
  }
};

}  // namespace detail

/// An accelerator, by OpenACC: one device thread a loop body, neighbours in the loop next to each
/// other in the device, so that structure-of-arrays views are read in one piece. Compile with GCC
/// 12 and the flags of the CMake target sphmbs::openacc. Results are the same bits from run to run.
struct OpenACC : DeviceMemory<detail::AccMemory> {
  ///@{ As `ExecutionPolicy` asks.
  static constexpr std::string_view name = "openacc";
  /// GCC links OpenACC or OpenMP offload, not both: host loops of such programs have one thread.
  using Host = Serial;
  template <class T>
  static constexpr int lanes = 1;

  template <LoopBody F>
  static void for_each(std::size_t n, const F& body) {
    if (n == 0) return;
    count_launch(sizeof(F));
    // As bytes, which the loop reads where it needs them: a copy of its own, as by firstprivate,
    // would fill its registers.
    struct {
      alignas(16) unsigned char bytes[sizeof(F)];
    } raw;
    __builtin_memcpy(raw.bytes, &body, sizeof(F));
#pragma acc parallel loop gang vector vector_length(128) copyin(raw)
    for (std::size_t i = 0; i < n; ++i) (*reinterpret_cast<const F*>(raw.bytes))(i);
  }

  static int concurrency() { return detail::AccMemory::on_host() ? 1 : 1 << 16; }
  ///@}

  /// @throws InvalidInput where there is none and ACC_DEVICE_TYPE does not ask for the host.
  static Device device() {
    detail::AccMemory::require();
    if (detail::AccMemory::on_host())
      return stand_in("the host, one thread (ACC_DEVICE_TYPE=host)");
    const acc_device_t type = acc_get_device_type();
    const int number = acc_get_device_num(type);
    const auto size = [&](acc_device_property_t property) {
      return static_cast<std::size_t>(acc_get_property(number, type, property));
    };
    return {.name = acc_get_property_string(number, type, acc_property_name),
            .memory = size(acc_property_memory),
            .free = size(acc_property_free_memory) + held()};
  }
};

static_assert(ExecutionPolicy<OpenACC>);

}  // namespace sphmbs::execution
