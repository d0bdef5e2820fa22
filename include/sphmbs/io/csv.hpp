// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <sphmbs/core/error.hpp>

namespace sphmbs::io {

/// Table of numbers in a text file: one `# comment` line, one header line such as
/// `t[s],speed_A[m/s]`, then one line per row. Numbers have 17 significant digits, so that reading
/// them gives back the same double, and a decimal point whatever the locale is.
///
/// Rows are buffered. The destructor writes the rest but cannot report a failure: call flush() at
/// the end of a run.
class CsvWriter {
 public:
  /// Head of one column. Without unit, the brackets are left out.
  struct Column {
    /// Heading of the column.
    std::string name{};
    /// Written behind the name as `name[unit]`; may be empty.
    std::string unit{};
  };

  /// Creates or empties the file and writes comment and header. Throws std::invalid_argument if
  /// there is no column, if the comment has more than one line or if a name or unit holds a comma,
  /// a quote or a line end; OutputError with path and reason if the file cannot be written.
  CsvWriter(std::filesystem::path path, const std::string& comment,
            const std::vector<Column>& columns)
      : path_(std::move(path)), columns_(columns.size()) {
    if (columns.empty()) throw std::invalid_argument("CsvWriter: no columns");
    if (comment.find_first_of("\r\n") != std::string::npos) {
      throw std::invalid_argument("CsvWriter: the comment has more than one line");
    }
    line_ = "# " + comment + "\n";
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string& unit = columns[i].unit;
      const std::string head = columns[i].name + (unit.empty() ? "" : "[" + unit + "]");
      if (head.find_first_of(",\"\r\n") != std::string::npos) {
        throw std::invalid_argument("CsvWriter: column \"" + head +
                                    "\" holds a comma, a quote or a line end");
      }
      line_ += (i == 0 ? "" : ",") + head;
    }
    line_ += '\n';
    file_.reset(std::fopen(path_.string().c_str(), "wb"));
    if (!file_) fail();
    write_line();
    flush();
  }

  /// Goes on with an earlier file of so many columns after its first `bytes`; what follows them is
  /// cut off. Throws OutputError with path and reason if it cannot be written or is shorter.
  CsvWriter(std::filesystem::path path, std::size_t columns, std::uintmax_t bytes)
      : path_(std::move(path)), columns_(columns) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path_, error);
    if (!error && size < bytes)
      throw OutputError("cannot go on with " + path_.string() + ": it has " + std::to_string(size) +
                        " bytes, fewer than the " + std::to_string(bytes) + " written before");
    if (!error) std::filesystem::resize_file(path_, bytes, error);
    if (error) throw OutputError("cannot go on with " + path_.string() + ": " + error.message());
    file_.reset(std::fopen(path_.string().c_str(), "ab"));
    if (!file_) fail();
    written_ = bytes;
  }

  /// Appends one row with as many values as there are columns, in their order and units; NaN is
  /// written as `nan`, infinities as `inf` and `-inf`. Throws std::invalid_argument if the number
  /// of values differs, OutputError with path and reason if writing fails.
  void row(std::span<const double> values) {
    if (values.size() != columns_) {
      throw std::invalid_argument("CsvWriter: " + std::to_string(values.size()) +
                                  " values for the " + std::to_string(columns_) + " columns of " +
                                  path_.string());
    }
    line_.clear();
    for (const double value : values) {
      if (!line_.empty()) line_ += ',';
      append(value);
    }
    line_ += '\n';
    write_line();
  }

  /// The same for values listed in the call: `csv.row({t, speed})`.
  void row(std::initializer_list<double> values) {
    row(std::span<const double>(values.begin(), values.size()));
  }

  /// Hands all rows to the operating system. Throws OutputError with path and reason.
  void flush() {
    if (std::fflush(file_.get()) != 0) fail();
  }

  /// Length of the file once all rows are flushed.
  std::uintmax_t bytes() const { return written_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  void append(double value) {
    // to_chars would show the sign bit of a NaN, which has no meaning.
    if (std::isnan(value)) {
      line_ += "nan";
      return;
    }
    char digits[32];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
    line_.append(digits, end);
  }

  void write_line() {
    if (std::fwrite(line_.data(), 1, line_.size(), file_.get()) != line_.size()) fail();
    written_ += line_.size();
  }

  [[noreturn]] void fail() const {
    throw OutputError("cannot write " + path_.string() + ": " +
                      std::generic_category().message(errno));
  }

  std::filesystem::path path_;
  std::size_t columns_;
  std::string line_;
  std::uintmax_t written_ = 0;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace sphmbs::io
