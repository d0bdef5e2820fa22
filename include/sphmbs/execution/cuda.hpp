// SPDX-License-Identifier: MIT
#pragma once

#if !defined(__CUDACC__)
#error "execution::Cuda needs nvcc: link sphmbs::cuda, or compile with nvcc -x cu"
#endif

#include <cstddef>
#include <string>

#include <cuda_runtime.h>

#include <sphmbs/core/error.hpp>
#include <sphmbs/execution/device.hpp>
#include <sphmbs/execution/device_memory.hpp>
#include <sphmbs/execution/execution_policy.hpp>
#include <sphmbs/execution/serial.hpp>

namespace sphmbs::execution {

namespace detail {

inline void check_cuda(cudaError_t result) {
  if (result != cudaSuccess)
    throw Error(std::string("execution policy cuda: ") + cudaGetErrorString(result), "E600");
}

struct CudaMemory {
  static void require() {
    int devices = 0;
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0)
      no_device("cuda", "CUDA looks for an NVIDIA driver (libcuda.so.1)");
  }
  static void* allocate(std::size_t bytes) {
    void* block = nullptr;
    return cudaMalloc(&block, bytes) == cudaSuccess ? block : nullptr;
  }
  static void release(void* block) { cudaFree(block); }
  static void to_device(void* there, const void* here, std::size_t bytes) {
    check_cuda(cudaMemcpy(there, here, bytes, cudaMemcpyHostToDevice));
  }
  static void to_host(void* here, const void* there, std::size_t bytes) {
    check_cuda(cudaMemcpy(here, there, bytes, cudaMemcpyDeviceToHost));
  }
};

template <class F>
__global__ void cuda_loop(std::size_t n, const F body) {
  const std::size_t i = blockIdx.x * static_cast<std::size_t>(blockDim.x) + threadIdx.x;
  if (i < n) body(i);
}

}  // namespace detail

/// An NVIDIA GPU, by CUDA: the yardstick for the policies without a vendor's language. Results are
/// the same bits from run to run.
struct Cuda : DeviceMemory<detail::CudaMemory> {
  ///@{ As `ExecutionPolicy` asks.
  static constexpr std::string_view name = "cuda";
  using Host = Serial;
  template <class T>
  static constexpr int lanes = 1;

  template <LoopBody F>
  static void for_each(std::size_t n, const F& body) {
    if (n == 0) return;
    count_launch(sizeof(F));
    constexpr unsigned threads = 128;
    detail::cuda_loop<<<static_cast<unsigned>((n + threads - 1) / threads), threads>>>(n, body);
    detail::check_cuda(cudaGetLastError());
    // So that errors and times belong to the loop that they come from.
    detail::check_cuda(cudaDeviceSynchronize());
  }

  static int concurrency() { return 1 << 16; }
  ///@}

  /// @throws InvalidInput where there is none.
  static Device device() {
    detail::CudaMemory::require();
    Device found;
    cudaDeviceProp properties;
    detail::check_cuda(cudaGetDeviceProperties(&properties, 0));
    detail::check_cuda(cudaMemGetInfo(&found.free, &found.memory));
    found.free += held();
    found.name = properties.name;
    return found;
  }
};

static_assert(ExecutionPolicy<Cuda>);

}  // namespace sphmbs::execution
