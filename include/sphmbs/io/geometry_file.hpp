// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include <sphmbs/core/expects.hpp>
#include <sphmbs/geometry/facets.hpp>

/// What the readers of geometry have in common.
namespace sphmbs::io {

///@{ A unit of length that files come in, for the readers' parameter `unit` [m].
inline constexpr double metre = 1;
inline constexpr double centimetre = 0.01;
inline constexpr double millimetre = 0.001;
inline constexpr double inch = 0.0254;
///@}

namespace detail {

/// The whole content of a file.
/// @throws InvalidInput E150 with path and reason.
inline std::string read_geometry_file(const std::filesystem::path& path) {
  const auto refuse = [&path](const std::string& reason) {
    return InvalidInput("cannot read " + path.string() + ": " + reason, "E150");
  };
  const auto last_error = [] { return std::generic_category().message(errno); };
  std::error_code reason;
  const auto status = std::filesystem::status(path, reason);
  if (!std::filesystem::exists(status)) throw refuse("there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw refuse("it must be a file");
  const std::uintmax_t size = std::filesystem::file_size(path, reason);
  if (reason) throw refuse(reason.message());
  if (size == 0) throw refuse("it is empty");
  if (size >= std::uintmax_t{1} << 32) throw refuse("it must be smaller than 4 GiB");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
      std::fopen(path.string().c_str(), "rb"), std::fclose);
  if (!file) throw refuse(last_error());
  std::string content(static_cast<std::size_t>(size), '\0');
  if (std::fread(content.data(), 1, content.size(), file.get()) != content.size())
    throw refuse(std::ferror(file.get()) != 0 ? last_error() : "it became shorter meanwhile");
  return content;
}

/// @throws InvalidInput for a unit of length that is not positive.
inline void check_unit(double unit) {
  expects(std::isfinite(unit) && unit > 0, "unit of length", unit,
          "positive [m], such as 0.001 for millimetres");
}

/// A piece of a file for a message: without what does not print, and not too long.
inline std::string quoted(std::string_view piece) {
  constexpr std::size_t most = 24;
  std::string text = "\"";
  for (const char c : piece.substr(0, most)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (piece.size() > most ? "...\"" : "\"");
}

/// Words of a text, line by line. Blanks and the characters `blanks` part them; a backslash at the
/// end of a line joins it to the next one; what follows `#` is left out.
class Words {
 public:
  Words(std::string_view text, std::string_view name, const char* id, double unit,
        std::string_view blanks = "")
      : text_(text), name_(name), id_(id), unit_(unit), blanks_(blanks) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  }

  /// The next word of the line; empty at its end.
  std::string_view next() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n' && text_[at_] != '#')
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// Whether the line ended with a comment.
  bool at_comment() const { return at_ < text_.size() && text_[at_] == '#'; }

  /// Goes to the next line; false where there is none.
  bool next_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    if (at_ >= text_.size()) return false;
    ++at_;
    ++line_;
    return true;
  }

  /// The next word, on whichever line; empty at the end of the text.
  std::string_view next_anywhere() {
    std::string_view word = next();
    while (word.empty() && next_line()) word = next();
    return word;
  }

  /// A coordinate in metres.
  double coordinate(std::string_view word) const {
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size()) fail(word, "a number");
    return checked(value, word);
  }

  /// The same of a number that is read.
  double checked(double value, std::string_view word) const {
    const double scaled = unit_ * value;
    if (!(std::abs(scaled) <= geometry::Facets<3>::farthest))
      fail(word, "a finite coordinate below 1e30 m");
    return scaled;
  }

  /// @throws InvalidInput "<file>:<line>: <what> <piece>: must be <allowed>"; where the text ends
  ///         too early, the piece is empty.
  [[noreturn]] void fail(std::string_view piece, const std::string& allowed) const {
    throw InvalidInput(name_ + ":" + std::to_string(line_) + ": " +
                           (piece.empty() ? "nothing" : quoted(piece)) + " found: must be " +
                           allowed,
                       id_);
  }

 private:
  bool is_blank(char c) const {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' ||
           blanks_.find(c) != std::string_view::npos;
  }
  void skip_blanks() {
    while (at_ < text_.size()) {
      const std::string_view rest = text_.substr(at_);
      const std::size_t joint = rest.starts_with("\\\n") ? 2 : rest.starts_with("\\\r\n") ? 3 : 0;
      if (joint > 0) {
        at_ += joint;
        ++line_;
      } else if (is_blank(text_[at_])) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  std::string name_;
  const char* id_;
  double unit_;
  std::string_view blanks_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

}  // namespace detail
}  // namespace sphmbs::io
