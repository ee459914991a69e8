// Sparse matrices put together row by row, on all threads. Each row is summed by itself in the order of its pieces, so the
// number of threads changes no bit, and a matrix is symmetric to the bit if the pieces are.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/threads.h"
#include "thermal/heat_model.h"

namespace scree::thermal {

// Consecutive rows as they grow.
struct RowChunk {
  std::vector<int> columns;
  std::vector<double> values;
  std::vector<int> ends;  // of each row, in this chunk

  void reserve(std::size_t rows, std::size_t entries);
};

// The row that is being summed, and where each column of it stands; each thread has one.
class RowSum {
 public:
  explicit RowSum(int columns) : slot_(static_cast<std::size_t>(columns), -1) {}

  void add(int column, double value) {
    int& slot = slot_[static_cast<std::size_t>(column)];
    if (slot < 0) {
      slot = static_cast<int>(row_.size());
      row_.push_back({column, 0});
    }
    row_[static_cast<std::size_t>(slot)].value += value;
  }

  // Appends the row times `factor`, in the order of its columns; the next one begins.
  void append_to(RowChunk& chunk, double factor);

 private:
  struct Entry {
    int column;
    double value;
  };
  std::vector<int> slot_;
  std::vector<Entry> row_;
};

inline constexpr int rows_in_chunk = 4096;

// A square matrix of the rows in the chunks, which it uses up: as they come, or the k-th of them all is row order[k].
SparseMatrix joined(std::vector<RowChunk> chunks, int size, std::span<const int> order);

// A square matrix. fill(row, sum) adds the entries of a row and returns what they are to be multiplied by; it is called for the
// rows as they come, or in this order.
template <class Fill>
SparseMatrix assembled(int size, const Fill& fill, std::span<const int> order = {}) {
  std::vector<RowChunk> chunks(static_cast<std::size_t>((size + rows_in_chunk - 1) / rows_in_chunk));
#pragma omp parallel if (size >= rows_worth_sharing)
  {
    RowSum sum(size);
    std::size_t entries = 0;  // of the last chunk: the next will have about as many
#pragma omp for schedule(dynamic)
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      chunks[c].reserve(rows_in_chunk, entries + entries / 16);
      const int first = static_cast<int>(c) * rows_in_chunk;
      for (int k = first; k < std::min(size, first + rows_in_chunk); ++k) {
        const int row = order.empty() ? k : order[k];
        sum.append_to(chunks[c], fill(row, sum));
      }
      entries = chunks[c].columns.size();
    }
  }
  return joined(std::move(chunks), size, order);
}

}  // namespace scree::thermal
