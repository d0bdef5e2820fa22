// SPDX-License-Identifier: MIT
#pragma once

#if !defined(_OPENMP)
#error "execution::OpenMPTarget needs OpenMP: link sphmbs::omp_target"
#endif

#include <cstddef>

#include <omp.h>

#include <sphmbs/execution/device.hpp>
#include <sphmbs/execution/device_memory.hpp>
#include <sphmbs/execution/execution_policy.hpp>
#include <sphmbs/execution/nvidia_driver.hpp>
#include <sphmbs/execution/openmp.hpp>

namespace sphmbs::execution {

namespace detail {

struct TargetMemory {
  // Clang's runtime counts devices that it is told not to use, and a default device beyond the last
  // one is the host.
  static bool host_asked_for() { return environment_says("OMP_TARGET_OFFLOAD", "disabled"); }
  static bool on_host() {
    const int device = omp_get_default_device();
    return host_asked_for() || device < 0 || device >= omp_get_num_devices();
  }
  static void require() {
    if (on_host() && !host_asked_for())
      no_device("omp_target",
                "OpenMP's runtime looks for an NVIDIA driver (libcuda), for its own plugin and for "
                "device code that fits the GPU, and OMP_DEFAULT_DEVICE must be one of the devices; "
                "OMP_TARGET_OFFLOAD=DISABLED runs the same loops on the threads of the host");
  }
  static int device() { return on_host() ? omp_get_initial_device() : omp_get_default_device(); }
  static void* allocate(std::size_t bytes) { return omp_target_alloc(bytes, device()); }
  static void release(void* block) { omp_target_free(block, device()); }
  static void to_device(void* there, const void* here, std::size_t bytes) {
    check(omp_target_memcpy(there, const_cast<void*>(here), bytes, 0, 0, device(),
                            omp_get_initial_device()));
  }
  static void to_host(void* here, const void* there, std::size_t bytes) {
    check(omp_target_memcpy(here, const_cast<void*>(there), bytes, 0, 0, omp_get_initial_device(),
                            device()));
  }
  static void check(int failure) {
    if (failure != 0)
      throw Error("execution policy omp_target: a copy over the bus failed with code " +
                      std::to_string(failure),
                  "E600");
  }
};

/// GCC 12 cannot compile a lambda or a large functor in a target region itself: it is hidden in a
/// box and called.
template <class F>
struct Boxed {
  F f;
};
template <class F>
[[gnu::noinline]] void call_boxed(const Boxed<F>& boxed, std::size_t i) {
  boxed.f(i);
}

}  // namespace detail

/// An accelerator, by OpenMP target regions: clang for speed, GCC for a second opinion. Compile
/// with the flags of the CMake target sphmbs::omp_target. Results are the same bits from run to
/// run.
struct OpenMPTarget : DeviceMemory<detail::TargetMemory> {
  ///@{ As `ExecutionPolicy` asks.
  static constexpr std::string_view name = "omp_target";
  using Host = OpenMP;
  template <class T>
  static constexpr int lanes = 1;

  template <LoopBody F>
  static void for_each(std::size_t n, const F& body) {
    if (n == 0) return;
    count_launch(sizeof(F));
    const detail::Boxed<F> boxed{body};
#if defined(__clang__)
#pragma omp target teams distribute parallel for firstprivate(boxed)
    for (std::size_t i = 0; i < n; ++i) boxed.f(i);
#else
    // Without simd, GCC lets a whole warp serve one loop body.
#pragma omp target teams distribute parallel for simd firstprivate(boxed)
    for (std::size_t i = 0; i < n; ++i) detail::call_boxed(boxed, i);
#endif
  }

  static int concurrency() {
    return detail::TargetMemory::on_host() ? omp_get_max_threads() : 1 << 16;
  }
  ///@}

  /// OpenMP tells neither names nor sizes of devices, NVIDIA's driver does.
  /// @throws InvalidInput where there is none and OMP_TARGET_OFFLOAD is not DISABLED.
  static Device device() {
    detail::TargetMemory::require();
    if (detail::TargetMemory::on_host()) return stand_in("the host (OMP_TARGET_OFFLOAD=DISABLED)");
#if SPHMBS_OMP_TARGET
    if (auto gpu = detail::ask_nvidia_driver(omp_get_default_device())) return *gpu;
#endif
    return {.name = "OpenMP device " + std::to_string(omp_get_default_device()) + " of " +
                    std::to_string(omp_get_num_devices())};
  }
};

static_assert(ExecutionPolicy<OpenMPTarget>);

}  // namespace sphmbs::execution
