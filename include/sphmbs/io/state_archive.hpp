// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include <sphmbs/core/archive.hpp>
#include <sphmbs/core/vec.hpp>
#include <sphmbs/execution/field.hpp>
#include <sphmbs/io/checkpoint_file.hpp>

namespace sphmbs::io {

namespace detail {

/// How the type of a number is called in a file.
template <class T>
std::string type_name() {
  if constexpr (std::is_enum_v<T>)
    return type_name<std::underlying_type_t<T>>();
  else
    return (std::is_floating_point_v<T> ? "f"
            : std::is_signed_v<T>       ? "i"
                                        : "u") +
           std::to_string(8 * sizeof(T));
}

template <class T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Contiguous numbers: std::vector, std::string; and such of fixed size: std::array.
template <class C>
concept Numbers = requires(C c) {
  requires Number<std::remove_cvref_t<decltype(*c.data())>>;
  c.size();
};
template <class C>
concept NumberArray = Numbers<C> && requires {
  std::tuple_size<C>::value;
};
/// Eigen's matrices and vectors.
template <class M>
concept ResizableMatrix = requires(M m) {
  m.resize(1, 1);
  m.rows();
};

template <class C>
concept Flat = requires(C c) {
  c.component;  // Vec
};

/// std::map, std::set, and containers of objects.
template <class C>
concept KeyedContainer = requires {
  typename C::key_type;
};
template <class C>
concept Mapping = KeyedContainer<C> && requires {
  typename C::mapped_type;
};

}  // namespace detail

/// What StateWriter and StateReader have in common: how a state is taken apart. `Medium` moves
/// arrays of numbers by name.
template <class Medium>
class StateArchive {
 public:
  /// Saves a value under a name, or restores it; see `Archive` for what a value can be.
  template <class T>
  void operator()(std::string_view name, T& value) {
    const Inside inside(path_, name);
    show(value);
  }

  /// The first `count` entries of an execution::Field; a restored one has memory for `capacity`,
  /// the rest of it zero.
  template <class Field>
  void field(std::string_view name, Field& field, std::size_t count, std::size_t capacity) {
    const Inside inside(path_, name);
    medium().transfer_field(path_, field, count, capacity);
  }

 private:
  /// Where in the state it is, for as long as this lives.
  class Inside {
   public:
    Inside(std::string& path, std::string_view name) : path_(path), outer_(path.size()) {
      if (!path_.empty()) path_ += '/';
      path_ += name;
    }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    ~Inside() { path_.resize(outer_); }

   private:
    std::string& path_;
    std::size_t outer_;
  };

  Medium& medium() { return static_cast<Medium&>(*this); }

  template <class T>
  void show(T& value) {
    if constexpr (requires { value.visit_state(medium()); }) {
      value.visit_state(medium());
    } else if constexpr (detail::Number<T>) {
      medium().transfer(path_, &value, 1);
    } else if constexpr (detail::Flat<T>) {
      medium().transfer(path_, value.component, std::size(value.component));
    } else if constexpr (detail::KeyedContainer<T>) {
      show_keyed(value);
    } else if constexpr (detail::NumberArray<T>) {
      medium().transfer(path_, value.data(), value.size());
    } else if constexpr (requires { std::tuple_size<T>::value; }) {
      std::apply([&](auto&... part) { show_parts(part...); }, value);
    } else if constexpr (detail::ResizableMatrix<T>) {
      show_matrix(value);
    } else if constexpr (detail::Numbers<T>) {
      auto size = static_cast<std::uint64_t>(value.size());
      size =
          medium().count(path_, detail::type_name<std::remove_cvref_t<decltype(*value.data())>>(),
                         sizeof(*value.data()), size);
      if constexpr (Medium::restores) value.resize(size);
      medium().transfer(path_, value.data(), size);
    } else {
      auto size = static_cast<std::uint64_t>(value.size());
      (*this)("size", size);
      if constexpr (Medium::restores) {
        medium().require(size <= medium().file().sections().size(), path_);
        value.resize(size);
      }
      std::size_t k = 0;
      for (auto& entry : value) (*this)(std::to_string(k++), entry);
    }
  }

  template <class... Parts>
  void show_parts(Parts&... parts) {
    int k = 0;
    ((*this)(std::to_string(k++), parts), ...);
  }

  template <class M>
  void show_matrix(M& value) {
    using Entry = typename M::Scalar;
    std::array<std::int64_t, 2> shape{value.rows(), value.cols()};
    (*this)("shape", shape);
    const Inside inside(path_, "entries");
    const auto entries = medium().count(path_, detail::type_name<Entry>(), sizeof(Entry),
                                        static_cast<std::uint64_t>(value.size()));
    if constexpr (Medium::restores) {
      medium().require(shape[0] >= 0 && shape[1] >= 0 &&
                           (shape[1] == 0 ? entries == 0
                                          : entries % static_cast<std::uint64_t>(shape[1]) == 0 &&
                                                entries / static_cast<std::uint64_t>(shape[1]) ==
                                                    static_cast<std::uint64_t>(shape[0])),
                       path_);
      value.resize(shape[0], shape[1]);
    }
    medium().transfer(path_, value.data(), static_cast<std::size_t>(value.size()));
  }

  template <class C>
  void show_keyed(C& value) {
    using Key = typename C::key_type;
    std::vector<Key> keys;
    if constexpr (!Medium::restores)
      for (const auto& entry : value) {
        if constexpr (detail::Mapping<C>)
          keys.push_back(entry.first);
        else
          keys.push_back(entry);
      }
    (*this)("keys", keys);
    if constexpr (Medium::restores) value.clear();
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if constexpr (detail::Mapping<C>)
        (*this)(std::to_string(k), value[keys[k]]);
      else if constexpr (Medium::restores)
        value.insert(keys[k]);
    }
  }

  std::string path_;
};

/// Saves a state into a file.
class StateWriter : public StateArchive<StateWriter> {
 public:
  static constexpr bool restores = false;  ///< values are saved

  /// @param file  to write to; it must outlive this.
  explicit StateWriter(CheckpointFileWriter& file) : file_(file) {}

 private:
  friend StateArchive<StateWriter>;

  template <class T>
  void transfer(std::string_view name, const T* data, std::size_t count) {
    file_.add(name, detail::type_name<T>(), std::as_bytes(std::span(data, count)));
  }
  std::uint64_t count(std::string_view, std::string_view, std::size_t, std::uint64_t size) const {
    return size;
  }
  template <class T, class Policy>
  void transfer_field(std::string_view name, const execution::Field<T, Policy>& field,
                      std::size_t count, std::size_t) {
    std::vector<T> host(field.size() == 0 ? 0 : count);
    if (!host.empty()) Policy::download(host.data(), field.data(), count * sizeof(T));
    transfer(name, host.data(), host.size());
  }

  CheckpointFileWriter& file_;
};

/// Restores a state from a file.
class StateReader : public StateArchive<StateReader> {
 public:
  static constexpr bool restores = true;  ///< values are restored

  /// @param file  to read from; it must outlive this.
  explicit StateReader(CheckpointFile& file) : file_(file) {}

  /// @throws RefusedCheckpoint naming a section that is missing or does not fit.
  const CheckpointFile& file() const { return file_; }

 private:
  friend StateArchive<StateReader>;

  template <class T>
  void transfer(std::string_view name, T* data, std::size_t count) {
    const auto& section = file_.section(name, detail::type_name<T>());
    if (section.bytes != count * sizeof(T))
      file_.refuse("E405", "section " + std::string(name) + " has " +
                               std::to_string(section.bytes / sizeof(T)) + " numbers, not " +
                               std::to_string(count));
    file_.read(section, std::as_writable_bytes(std::span(data, count)));
  }
  void require(bool fits, const std::string& name) const {
    if (!fits) file_.refuse("E405", "the size of " + name + " does not fit to what is there");
  }
  std::uint64_t count(std::string_view name, std::string_view type, std::size_t width,
                      std::uint64_t) const {
    return file_.section(name, type).bytes / width;
  }
  template <class T, class Policy>
  void transfer_field(std::string_view name, execution::Field<T, Policy>& field, std::size_t count,
                      std::size_t capacity) {
    const bool some = file_.section(name, detail::type_name<T>()).bytes > 0;
    std::vector<T> host(some ? capacity : 0);
    transfer(name, host.data(), some ? count : 0);
    field = execution::Field<T, Policy>();
    if (some) field = execution::Field<T, Policy>(std::span<const T>(host));
  }

  CheckpointFile& file_;
};

static_assert(Archive<StateWriter> && Archive<StateReader>);

}  // namespace sphmbs::io
