// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace sphmbs::io {

namespace detail {

/// Tables for eight bytes at a time.
constexpr std::array<std::array<std::uint64_t, 256>, 8> crc64_tables() {
  constexpr std::uint64_t polynomial = 0xc96c5795d7870f42;  // of ECMA-182, bits reversed
  std::array<std::array<std::uint64_t, 256>, 8> table{};
  for (std::uint64_t i = 0; i < 256; ++i) {
    std::uint64_t crc = i;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? polynomial : 0);
    table[0][i] = crc;
  }
  for (std::size_t k = 1; k < 8; ++k)
    for (std::size_t i = 0; i < 256; ++i)
      table[k][i] = (table[k - 1][i] >> 8) ^ table[0][table[k - 1][i] & 0xff];
  return table;
}

inline constexpr auto crc64_table = crc64_tables();

}  // namespace detail

/// Checksum CRC-64/XZ, fed piece by piece: finds every change of up to 64 bits in a row, and others
/// but for one in 2^64.
class Crc64 {
 public:
  /// Goes on with these bytes.
  void add(std::span<const std::byte> bytes) {
    const auto& table = detail::crc64_table;
    const std::byte* at = bytes.data();
    std::size_t left = bytes.size();
    for (; left >= 8; left -= 8, at += 8) {
      std::uint64_t word;
      std::memcpy(&word, at, sizeof word);
      word ^= state_;
      state_ = 0;
      for (std::size_t k = 0; k < 8; ++k) state_ ^= table[7 - k][(word >> (8 * k)) & 0xff];
    }
    for (; left > 0; --left, ++at)
      state_ = (state_ >> 8) ^ table[0][(state_ ^ std::to_integer<std::uint64_t>(*at)) & 0xff];
  }

  /// The checksum of all bytes so far.
  std::uint64_t value() const { return ~state_; }

 private:
  std::uint64_t state_ = ~std::uint64_t{0};
};

}  // namespace sphmbs::io
