#include "thermal/row_assembly.h"

#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "engine/base/check.h"
#include "thermal/sparse_sum.h"

namespace scree::thermal {

namespace {

void refuse_too_many(const std::vector<RowChunk>& chunks) {
  std::size_t entries = 0;
  for (const RowChunk& chunk : chunks) entries += chunk.columns.size();
  if (entries <= std::numeric_limits<int>::max()) return;
  throw RunError(fmt::format("a matrix of the nodes has {} entries, more than the {} that can be counted; take coarser meshes",
                             entries, std::numeric_limits<int>::max()));
}

}  // namespace

void RowChunk::reserve(std::size_t rows, std::size_t entries) {
  columns.reserve(entries);
  values.reserve(entries);
  ends.reserve(rows);
}

void RowSum::append_to(RowChunk& chunk, double factor) {
  std::sort(row_.begin(), row_.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
  for (const Entry& entry : row_) {
    chunk.columns.push_back(entry.column);
    chunk.values.push_back(factor * entry.value);
    slot_[static_cast<std::size_t>(entry.column)] = -1;
  }
  chunk.ends.push_back(static_cast<int>(chunk.columns.size()));
  row_.clear();
}

SparseMatrix joined(std::vector<RowChunk> chunks, int size, std::span<const int> order) {
  refuse_too_many(chunks);
  // Calls use(row, begin, end) with each row of a chunk and where its entries stand in that.
  const auto for_each_row = [&](std::size_t c, const auto& use) {
    for (int i = 0; i < std::ssize(chunks[c].ends); ++i) {
      const int number = static_cast<int>(c) * rows_in_chunk + i;
      use(order.empty() ? number : order[number], i == 0 ? 0 : chunks[c].ends[i - 1], chunks[c].ends[i]);
    }
  };
  std::vector<int> offset(static_cast<std::size_t>(size) + 1, 0);
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    for_each_row(c, [&](int row, int begin, int end) { offset[row + 1] = end - begin; });
  }
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  SparseMatrix matrix = uninitialised(size, offset.back());
  std::copy(offset.begin(), offset.end(), matrix.outerIndexPtr());
#pragma omp parallel for schedule(static) if (size >= rows_worth_sharing)
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    for_each_row(c, [&](int row, int begin, int end) {
      std::copy(chunks[c].columns.begin() + begin, chunks[c].columns.begin() + end, matrix.innerIndexPtr() + offset[row]);
      std::copy(chunks[c].values.begin() + begin, chunks[c].values.begin() + end, matrix.valuePtr() + offset[row]);
    });
    chunks[c] = {};
  }
  return matrix;
}

}  // namespace scree::thermal
