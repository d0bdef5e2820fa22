// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <new>
#include <unordered_map>

#include <sphmbs/execution/host_memory.hpp>

namespace sphmbs::execution {

/// What has crossed the bus between host and device, counted copy by copy.
struct BusTraffic {
  std::uint64_t uploads = 0;     ///< copies to the device
  std::uint64_t uploaded = 0;    ///< [bytes]
  std::uint64_t downloads = 0;   ///< copies to the host
  std::uint64_t downloaded = 0;  ///< [bytes]
  std::uint64_t launches = 0;    ///< loops started on the device
  std::uint64_t arguments = 0;   ///< of all loop bodies, which go with the launches [bytes]
  /// All that was copied, both ways [bytes].
  std::uint64_t bytes() const { return uploaded + downloaded; }
};

/// Memory of a device policy: counts what crosses the bus, and keeps blocks that were given back
/// for the next one that needs their size, since devices stop to allocate. Safe among threads.
/// @tparam Raw  plain `allocate` (null where there is no room), `release`, `to_device` and
/// `to_host`
///              of the device's runtime, and `require`, which throws where there is no device
template <class Raw>
class DeviceMemory {
 public:
  /// Items that one loop body of a reduction or a scan takes.
  static constexpr std::size_t chunk = 32;

  /// @throws InvalidInput where there is no device, std::bad_alloc where it has no room.
  static void* allocate(std::size_t bytes) {
    Raw::require();
    const std::size_t size = rounded(bytes);
    Pool& pool = the_pool();
    const std::lock_guard lock(pool.mutex);
    auto kept = pool.idle.find(size);
    void* block = nullptr;
    if (kept != pool.idle.end()) {
      block = kept->second;
      pool.idle.erase(kept);
      pool.waiting -= size;
    } else {
      block = Raw::allocate(size);
      if (block == nullptr) {
        free_idle(pool);
        block = Raw::allocate(size);
      }
      if (block == nullptr) throw std::bad_alloc();
      pool.held += size;
    }
    pool.size[block] = size;
    return block;
  }

  /// Gives a block back, which is kept for the next one of its size.
  static void release(void* block) noexcept {
    Pool& pool = the_pool();
    const std::lock_guard lock(pool.mutex);
    const auto used = pool.size.find(block);
    const std::size_t size = used->second;
    pool.size.erase(used);
    pool.waiting += size;
    pool.idle.emplace(size, block);
    // Runtimes need memory for themselves, for which they cannot ask here.
    if (pool.waiting > (pool.held - pool.waiting) / 4 + least_waiting) free_idle(pool);
  }

  /// Copies `bytes` to the device, and counts them.
  static void upload(void* there, const void* here, std::size_t bytes) {
    if (bytes == 0) return;
    count([&](BusTraffic& bus) {
      ++bus.uploads;
      bus.uploaded += bytes;
    });
    Raw::to_device(there, here, bytes);
  }
  /// Copies `bytes` from the device, and counts them.
  static void download(void* here, const void* there, std::size_t bytes) {
    if (bytes == 0) return;
    count([&](BusTraffic& bus) {
      ++bus.downloads;
      bus.downloaded += bytes;
    });
    Raw::to_host(here, there, bytes);
  }

  /// Since the program began.
  static const BusTraffic& bus() { return the_pool().bus; }
  /// Memory of the device that the program has, blocks in wait included [bytes].
  static std::size_t held() { return the_pool().held; }

  /// Gives the blocks in wait back to the device.
  static void trim() {
    Pool& pool = the_pool();
    const std::lock_guard lock(pool.mutex);
    free_idle(pool);
  }

 protected:
  /// The host in a device's place.
  static Device stand_in(const char* name) {
    Device host = HostMemory::device();
    host.name = name;
    return host;
  }

  /// Counts a loop that is started with a body of so many bytes.
  static void count_launch(std::size_t argument_bytes) {
    count([&](BusTraffic& bus) {
      ++bus.launches;
      bus.arguments += argument_bytes;
    });
  }

 private:
  struct Pool {
    std::mutex mutex;
    std::multimap<std::size_t, void*> idle;
    std::unordered_map<void*, std::size_t> size;  // of blocks in use
    std::size_t held = 0;                         // [bytes]
    std::size_t waiting = 0;                      // of them in idle blocks [bytes]
    BusTraffic bus;
  };
  static constexpr std::size_t least_waiting = std::size_t{64} << 20;

  template <class Add>
  static void count(const Add& add) {
    Pool& pool = the_pool();
    const std::lock_guard lock(pool.mutex);
    add(pool.bus);
  }

  // Never destroyed: fields may outlive static objects, and the runtime frees all at the end.
  static Pool& the_pool() {
    static Pool* const pool = new Pool;
    return *pool;
  }

  static void free_idle(Pool& pool) {
    for (const auto& [size, block] : pool.idle) {
      Raw::release(block);
      pool.held -= size;
    }
    pool.idle.clear();
    pool.waiting = 0;
  }

  // Sizes in steps of an eighth of a power of two, so that lists that grow a little find a block.
  static std::size_t rounded(std::size_t bytes) {
    std::size_t step = 256;
    while (step * 16 <= bytes) step *= 2;
    return (bytes + step - 1) / step * step;
  }
};

}  // namespace sphmbs::execution
