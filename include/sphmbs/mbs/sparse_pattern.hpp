// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>

#include <sphmbs/mbs/types.hpp>

namespace sphmbs::mbs {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;  ///< columns compressed

/// Which numbers, computed piece by piece into one array, add up to which entry of a sparse matrix.
/// Every entry gathers its own sources in ascending order: no atomics, and the same bits for any
/// number of threads.
class SparsePattern {
 public:
  /// Begins a square matrix.
  void begin(int size) {
    size_ = size;
    entries_.assign(static_cast<std::size_t>(size), {});
    for (int k = 0; k < size; ++k) add(k, k, nothing);
  }

  /// The number at `source` adds to the entry (row, column).
  void add(int row, int column, std::size_t source) {
    entries_[static_cast<std::size_t>(column)].push_back({row, source});
  }

  /// An entry is kept although no number adds to it.
  void keep(int row, int column) { add(row, column, nothing); }

  /// Ends the additions: a matrix of zeros with this pattern.
  SparseMatrix finish() {
    std::vector<int> rows, outer{0};
    begin_.assign(1, 0);
    sources_.clear();
    for (auto& column : entries_) {
      std::sort(column.begin(), column.end());
      int last = -1;
      for (const auto& [row, source] : column) {
        if (row != last) {
          if (last >= 0) begin_.push_back(sources_.size());
          rows.push_back(row);
          last = row;
        }
        if (source != nothing) sources_.push_back(source);
      }
      begin_.push_back(sources_.size());
      outer.push_back(static_cast<int>(rows.size()));
      std::vector<Entry>().swap(column);
    }
    SparseMatrix zeros(size_, size_);
    zeros.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
    std::copy(outer.begin(), outer.end(), zeros.outerIndexPtr());
    std::copy(rows.begin(), rows.end(), zeros.innerIndexPtr());
    std::fill_n(zeros.valuePtr(), rows.size(), 0.0);
    return zeros;
  }

  /// Sum of the sources of the stored entry k.
  double sum(std::size_t k, const std::vector<double>& numbers) const {
    double total = 0;
    for (std::size_t s = begin_[k]; s < begin_[k + 1]; ++s) total += numbers[sources_[s]];
    return total;
  }

 private:
  using Entry = std::pair<int, std::size_t>;  // row, source
  static constexpr std::size_t nothing = static_cast<std::size_t>(-1);

  int size_ = 0;
  std::vector<std::vector<Entry>> entries_;  // by column, until finish()
  std::vector<std::size_t> begin_;           // of the sources of each stored entry
  std::vector<std::size_t> sources_;
};

}  // namespace sphmbs::mbs
