// SPDX-License-Identifier: MIT
#pragma once

/// Optional: needs HDF5's C library, 1.10.2 or newer, and POSIX (target sphmbs::hdf5).
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include <hdf5.h>

#include <sphmbs/core/error.hpp>

namespace sphmbs::io::detail {

/// Keeps HDF5 from printing its errors, which become exceptions, while it lives.
class Hdf5Quiet {
 public:
  Hdf5Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Hdf5Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Hdf5Quiet(const Hdf5Quiet&) = delete;
  Hdf5Quiet& operator=(const Hdf5Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// Why HDF5 failed: what it says where the failure began, or the operating system's reason.
inline std::string hdf5_reason() {
  std::string reason = "HDF5 gives no reason";
  const auto take_first = [](unsigned n, const H5E_error2_t* error, void* text) -> herr_t {
    if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_first, &reason);
  const std::string_view number = "errno = ";
  const std::size_t at = reason.find(number);
  if (at != std::string::npos)
    reason = std::generic_category().message(std::atoi(reason.c_str() + at + number.size()));
  return reason;
}

/// Owns an identifier of HDF5.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close_with) : id_(id), close_(close_with) {}
  ~Hdf5Handle() {
    const Hdf5Quiet quiet;
    close();
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }

  operator hid_t() const { return id_; }

  /// Negative where HDF5 cannot close it.
  herr_t close() {
    const hid_t id = std::exchange(id_, H5I_INVALID_HID);
    return id >= 0 ? close_(id) : 0;
  }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Checks what calls of HDF5 return.
struct Hdf5Check {
  std::filesystem::path path;
  std::string_view message_id;

  /// @throws OutputError with path and reason.
  void operator()(herr_t result) const {
    if (result < 0) fail(hdf5_reason());
  }

  /// @throws OutputError with path and reason.
  Hdf5Handle operator()(hid_t id, Hdf5Handle::Close close) const {
    (*this)(id < 0 ? -1 : 0);
    return {id, close};
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw OutputError("cannot write " + path.string() + ": " + reason, message_id);
  }
  [[noreturn]] void fail(int error) const { fail(std::generic_category().message(error)); }
};

/// Makes sure that the disk has room for `bytes` from `first` on: once a write fails, HDF5 can
/// neither close the file nor end, and leaves it unreadable.
/// @throws OutputError with path and reason.
inline void hdf5_reserve(const Hdf5Check& check, hsize_t first, std::size_t bytes) {
  const int file = open(check.path.c_str(), O_WRONLY | O_CREAT, 0666);
  if (file < 0) check.fail(errno);
  const int error = posix_fallocate(file, static_cast<off_t>(first), static_cast<off_t>(bytes));
  close(file);
  if (error != 0) check.fail(error);
}

template <class T>
hid_t hdf5_type() {
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
}

/// Gives a file, group or data set an attribute that is a text.
inline void hdf5_describe(const Hdf5Check& check, hid_t object, const char* name,
                          const std::string& text) {
  const Hdf5Handle type = check(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, H5T_VARIABLE));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  const Hdf5Handle scalar = check(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle attribute =
      check(H5Acreate2(object, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* const characters = text.c_str();
  check(H5Awrite(attribute, type, &characters));
}

/// An empty data set of rows of `columns` numbers, or of numbers where `columns` is 1, that grows
/// and keeps a checksum of every `chunk` rows.
inline void hdf5_create_rows(const Hdf5Check& check, hid_t place, const std::string& name,
                             hid_t type, hsize_t columns, hsize_t chunk, const std::string& unit) {
  const int axes = columns > 1 ? 2 : 1;
  const hsize_t none[] = {0, columns}, most[] = {H5S_UNLIMITED, columns},
                piece[] = {chunk, columns};
  const Hdf5Handle space = check(H5Screate_simple(axes, none, most), H5Sclose);
  const Hdf5Handle properties = check(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_chunk(properties, axes, piece));
  check(H5Pset_fletcher32(properties));
  const Hdf5Handle set = check(
      H5Dcreate2(place, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  hdf5_describe(check, set, "unit", unit);
}

/// Makes rows `first` to `first` + `count` the last ones of such a data set and writes them.
template <class T>
void hdf5_append_rows(const Hdf5Check& check, hid_t place, const std::string& name, hsize_t first,
                      hsize_t count, hsize_t columns, const T* values) {
  const int axes = columns > 1 ? 2 : 1;
  const hsize_t extent[] = {first + count, columns}, begin[] = {first, 0},
                size[] = {count, columns};
  const Hdf5Handle set = check(H5Dopen2(place, name.c_str(), H5P_DEFAULT), H5Dclose);
  check(H5Dset_extent(set, extent));
  if (count == 0) return;
  const Hdf5Handle target = check(H5Dget_space(set), H5Sclose);
  check(H5Sselect_hyperslab(target, H5S_SELECT_SET, begin, nullptr, size, nullptr));
  const Hdf5Handle source = check(H5Screate_simple(axes, size, nullptr), H5Sclose);
  check(H5Dwrite(set, hdf5_type<T>(), source, target, H5P_DEFAULT, values));
  check(H5Dflush(set));  // closing it, which must not fail, would write too
}

}  // namespace sphmbs::io::detail
