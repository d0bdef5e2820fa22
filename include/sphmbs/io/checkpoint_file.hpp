// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <sphmbs/io/crc64.hpp>
#include <sphmbs/io/durable_file.hpp>

/// Files of named, typed arrays, in which any damage is found: a head (8 letters, version, byte
/// order), sections (head with name, type and size; checksum of it; data; their checksum), and an
/// end with the number of sections and the checksum of the whole file. Numbers are little-endian.
namespace sphmbs::io {

static_assert(std::endian::native == std::endian::little, "checkpoints are little-endian");

namespace detail {

inline constexpr std::string_view checkpoint_magic = "SPHMBSCK";
inline constexpr std::uint32_t checkpoint_version = 1;
inline constexpr std::uint32_t checkpoint_byte_order = 0x01020304;
inline constexpr std::uint32_t section_tag = 0x54434553;  // "SECT"
inline constexpr std::uint32_t end_tag = 0x53444e45;      // "ENDS"
inline constexpr std::uint32_t longest_name = 4096;

struct FileHead {
  std::array<char, 8> magic;
  std::uint32_t version, byte_order;
};
struct SectionHead {
  std::uint32_t tag, name_bytes;
  std::array<char, 8> type;
  std::uint64_t data_bytes;
};
struct FileEnd {
  std::uint32_t tag, sections;
  std::uint64_t crc;
};
static_assert(sizeof(FileHead) == 16 && sizeof(SectionHead) == 24 && sizeof(FileEnd) == 16);

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

}  // namespace detail

/// Writes such a file; what it is called appears with finish().
class CheckpointFileWriter {
 public:
  /// @throws OutputError with path and reason, as all members.
  explicit CheckpointFileWriter(std::filesystem::path path) : file_(std::move(path)) {
    detail::FileHead head{{}, detail::checkpoint_version, detail::checkpoint_byte_order};
    detail::checkpoint_magic.copy(head.magic.data(), head.magic.size());
    put(detail::bytes_of(head));
  }

  /// Adds a section. @param type  of its numbers, at most 8 letters
  void add(std::string_view name, std::string_view type, std::span<const std::byte> data) {
    detail::SectionHead head{
        detail::section_tag, static_cast<std::uint32_t>(name.size()), {}, data.size()};
    type.copy(head.type.data(), head.type.size());
    Crc64 of_head;
    const auto letters = std::as_bytes(std::span(name));
    of_head.add(detail::bytes_of(head));
    of_head.add(letters);
    put(detail::bytes_of(head));
    put(letters);
    put(detail::bytes_of(of_head.value()));
    Crc64 of_data;
    of_data.add(data);
    put(data);
    put(detail::bytes_of(of_data.value()));
    ++sections_;
  }

  /// Ends the file and gives it to the disk, under its temporary name, to be read again.
  const std::filesystem::path& close() {
    const detail::FileEnd end{detail::end_tag, sections_, crc_.value()};
    file_.write(detail::bytes_of(end));
    file_.close();
    return file_.temporary();
  }
  /// Gives the closed file its name.
  void finish() { file_.finish(); }

 private:
  void put(std::span<const std::byte> bytes) {
    crc_.add(bytes);
    file_.write(bytes);
  }

  DurableFile file_;
  Crc64 crc_;
  std::uint32_t sections_ = 0;
};

/// Reads such a file. The constructor reads all of it and checks it; no memory is taken for what
/// the file only claims to hold.
class CheckpointFile {
 public:
  /// A named part of the file.
  struct Section {
    std::string type;     ///< of its numbers, as StateWriter names it
    std::uint64_t bytes;  ///< of its data
    long begin;           ///< place of its data in the file [bytes]
  };

  /// @throws RefusedCheckpoint with the path and what is wrong: "truncated", "checksum of section
  ///         X", "trailing bytes", a newer version, not a checkpoint, or the system's reason.
  explicit CheckpointFile(std::filesystem::path path) : path_(std::move(path)) {
    file_.reset(std::fopen(path_.c_str(), "rb"));
    if (!file_) refuse("E401", std::generic_category().message(errno));
    std::error_code error;
    left_ = std::filesystem::file_size(path_, error);
    if (error) refuse("E401", error.message());
    check_head();
    while (check_section()) {
    }
  }

  /// Where the file is.
  const std::filesystem::path& path() const { return path_; }
  /// All sections by name.
  const std::map<std::string, Section, std::less<>>& sections() const { return sections_; }

  /// @throws RefusedCheckpoint unless there is a section of this name and type.
  const Section& section(std::string_view name, std::string_view type) const {
    const auto found = sections_.find(name);
    if (found == sections_.end()) refuse("E405", "has no section " + std::string(name));
    if (found->second.type != type)
      refuse("E405", "section " + std::string(name) + " has the type " + found->second.type +
                         ", not " + std::string(type));
    return found->second;
  }

  /// Reads the data of a section. @param to  as many bytes as it has
  void read(const Section& section, std::span<std::byte> to) {
    if (std::fseek(file_.get(), section.begin, SEEK_SET) != 0 ||
        std::fread(to.data(), 1, to.size(), file_.get()) != to.size())
      refuse("E401", "cannot be read again");
  }

  /// @throws RefusedCheckpoint with the file's path, the id of a message and why.
  [[noreturn]] void refuse(std::string_view id, const std::string& why) const {
    throw RefusedCheckpoint("checkpoint " + path_.string() + ": " + why, id);
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  void take(std::span<std::byte> to) {
    if (to.size() > left_) refuse("E402", "truncated");
    if (std::fread(to.data(), 1, to.size(), file_.get()) != to.size())
      refuse("E401", "cannot be read: " + std::generic_category().message(errno));
    left_ -= to.size();
  }
  template <class T>
  T take(Crc64& crc) {
    T value;
    take(std::as_writable_bytes(std::span(&value, 1)));
    crc.add(detail::bytes_of(value));
    return value;
  }

  void check_head() {
    if (left_ == 0) refuse("E402", "truncated: the file is empty");
    const auto head = take<detail::FileHead>(crc_);
    if (std::string_view(head.magic.data(), head.magic.size()) != detail::checkpoint_magic)
      refuse("E403", "this is not a checkpoint of sphmbs");
    if (head.byte_order != detail::checkpoint_byte_order)
      refuse("E403", "checksum of the head: byte order");
    if (head.version != detail::checkpoint_version)
      refuse("E404", "written in format " + std::to_string(head.version) +
                         ", this program reads format " +
                         std::to_string(detail::checkpoint_version));
  }

  // Whether there was one more.
  bool check_section() {
    const Crc64 before = crc_;
    const auto tag = take<std::uint32_t>(crc_);
    if (tag == detail::end_tag) {
      check_end(before.value());
      return false;
    }
    const std::string where = "checksum of section " + std::to_string(sections_.size() + 1);
    if (tag != detail::section_tag) refuse("E403", where);
    detail::SectionHead head{
        .tag = tag, .name_bytes = take<std::uint32_t>(crc_), .type = {}, .data_bytes = 0};
    head.type = take<std::array<char, 8>>(crc_);
    head.data_bytes = take<std::uint64_t>(crc_);
    if (head.name_bytes > detail::longest_name) refuse("E403", where);
    std::string name(head.name_bytes, '\0');
    take(std::as_writable_bytes(std::span(name)));
    crc_.add(std::as_bytes(std::span(name)));
    Crc64 of_head;
    of_head.add(detail::bytes_of(head));
    of_head.add(std::as_bytes(std::span(name)));
    if (take<std::uint64_t>(crc_) != of_head.value()) refuse("E403", where);
    if (head.data_bytes > left_) refuse("E402", "truncated in section " + name);
    const auto letters = static_cast<std::size_t>(
        std::find(head.type.begin(), head.type.end(), '\0') - head.type.begin());
    const Section section{std::string(head.type.data(), letters), head.data_bytes,
                          std::ftell(file_.get())};
    Crc64 of_data;
    std::vector<std::byte> buffer(std::min<std::uint64_t>(head.data_bytes, 1 << 20));
    for (std::uint64_t rest = head.data_bytes; rest > 0;) {
      const std::span<std::byte> piece(buffer.data(), std::min<std::uint64_t>(rest, buffer.size()));
      take(piece);
      of_data.add(piece);
      crc_.add(piece);
      rest -= piece.size();
    }
    if (take<std::uint64_t>(crc_) != of_data.value()) refuse("E403", "checksum of section " + name);
    if (!sections_.emplace(name, section).second) refuse("E403", "two sections " + name);
    return true;
  }

  void check_end(std::uint64_t crc) {
    Crc64 none;
    const auto sections = take<std::uint32_t>(none);
    const auto whole = take<std::uint64_t>(none);
    if (sections != sections_.size() || whole != crc) refuse("E403", "checksum of the file");
    if (left_ > 0) refuse("E403", std::to_string(left_) + " trailing bytes behind the end");
  }

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t left_ = 0;  // bytes that were not read
  Crc64 crc_;
  std::map<std::string, Section, std::less<>> sections_;
};

}  // namespace sphmbs::io
