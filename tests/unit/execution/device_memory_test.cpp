// SPDX-License-Identifier: MIT
// The memory of device policies, over a runtime that stands in for a device's.
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include <sphmbs/execution/device.hpp>
#include <sphmbs/execution/device_memory.hpp>

#include "support/catch.hpp"

namespace {

using sphmbs::execution::DeviceMemory;

template <int number>
struct Toy {
  static inline bool present = true;
  static inline std::size_t room = std::size_t{1} << 40;
  static inline int allocations = 0;
  static inline int releases = 0;

  static void require() {
    if (!present) sphmbs::execution::detail::no_device("toy", "plug one in");
  }
  static void* allocate(std::size_t bytes) {
    if (bytes > room) return nullptr;
    room -= bytes;
    ++allocations;
    auto* const block = static_cast<std::size_t*>(std::malloc(bytes + 64));
    *block = bytes;
    return block + 8;
  }
  static void release(void* block) {
    std::size_t* const start = static_cast<std::size_t*>(block) - 8;
    room += *start;
    ++releases;
    std::free(start);
  }
  static void to_device(void* there, const void* here, std::size_t n) {
    std::memcpy(there, here, n);
  }
  static void to_host(void* here, const void* there, std::size_t n) { std::memcpy(here, there, n); }
};

}  // namespace

TEST_CASE("device memory is taken again before more is asked for", "[execution]") {
  using Runtime = Toy<1>;
  using Memory = DeviceMemory<Runtime>;
  void* const a = Memory::allocate(100000);
  void* const b = Memory::allocate(100000);
  CHECK(a != b);
  CHECK(Runtime::allocations == 2);
  const std::size_t held = Memory::held();
  CHECK(held >= 200000);
  CHECK(held < 230000);
  Memory::release(a);
  // A little more or less than before is the same block; far less is not.
  CHECK(Memory::allocate(99500) == a);
  CHECK(Runtime::allocations == 2);
  void* const c = Memory::allocate(1000);
  CHECK(Runtime::allocations == 3);
  Memory::release(a);
  Memory::release(b);
  Memory::release(c);
  CHECK(Runtime::releases == 0);
  Memory::trim();
  CHECK(Runtime::releases == 3);
  CHECK(Memory::held() == 0);
}

TEST_CASE("blocks in wait make room where a device is full", "[execution]") {
  using Runtime = Toy<2>;
  using Memory = DeviceMemory<Runtime>;
  Runtime::room = 300000;
  void* const a = Memory::allocate(200000);
  Memory::release(a);
  void* const b = Memory::allocate(250000);
  CHECK(Runtime::releases == 1);
  CHECK_THROWS_AS(Memory::allocate(250000), std::bad_alloc);
  Memory::release(b);
  Memory::trim();
}

TEST_CASE("what crosses the bus is counted", "[execution]") {
  using Memory = DeviceMemory<Toy<3>>;
  const std::vector<double> sent{1, 2, 3};
  std::vector<double> back(2);
  void* const there = Memory::allocate(24);
  Memory::upload(there, sent.data(), 24);
  Memory::download(back.data(), there, 16);
  Memory::download(back.data(), there, 0);
  CHECK(back == std::vector<double>{1, 2});
  CHECK(Memory::bus().uploads == 1);
  CHECK(Memory::bus().uploaded == 24);
  CHECK(Memory::bus().downloads == 1);
  CHECK(Memory::bus().downloaded == 16);
  CHECK(Memory::bus().bytes() == 40);
  Memory::release(there);
}

TEST_CASE("a missing device is an error with a hint", "[execution]") {
  using Runtime = Toy<4>;
  Runtime::present = false;
  CHECK_THROWS_WITH(DeviceMemory<Runtime>::allocate(8),
                    "execution policy toy: no device was found; plug one in");
}
