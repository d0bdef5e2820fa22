// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <sphmbs/execution/execution_policy.hpp>

namespace sphmbs::execution {

/// Owning array in a policy's memory; not initialised. Moves, never copies silently.
template <class T, ExecutionPolicy Policy>
class Field {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Field() = default;
  /// Room for `size` numbers, whose values are not set. @throws std::bad_alloc without room.
  explicit Field(std::size_t size)
      : data_(static_cast<T*>(size > 0 ? Policy::allocate(size * sizeof(T)) : nullptr)),
        size_(size) {}
  /// A copy of numbers of the host.
  explicit Field(std::span<const T> host) : Field(host.size()) { upload(host); }
  /// Takes the memory over.
  Field(Field&& other) noexcept { swap(other); }
  /// Takes the memory over.
  Field& operator=(Field&& other) noexcept {
    Field(std::move(other)).swap(*this);
    return *this;
  }
  ~Field() {
    if (data_ != nullptr) Policy::release(data_);
  }

  /// Exchanges the memory of two fields, without a copy.
  void swap(Field& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  /// Gives up the old contents; frees them before it allocates, to keep the peak low.
  void resize_discarding(std::size_t size) {
    if (size == size_) return;
    *this = Field();
    *this = Field(size);
  }

  /// Numbers that it holds.
  std::size_t size() const { return size_; }
  /// Memory that it takes [bytes].
  std::size_t bytes() const { return size_ * sizeof(T); }

  /// Pointer for loop bodies; valid where the policy's loops run.
  T* data() { return data_; }
  /// Where the numbers lie, in the policy's memory: for loop bodies only.
  const T* data() const { return data_; }

  /// Copies all of `host`, whose size must be that of the field.
  void upload(std::span<const T> host) { Policy::upload(data_, host.data(), host.size_bytes()); }

  /// The contents, on the host.
  std::vector<T> download() const {
    std::vector<T> host(size_);
    Policy::download(host.data(), data_, bytes());
    return host;
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace sphmbs::execution
