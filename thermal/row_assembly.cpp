#include "thermal/row_assembly.h"

#include "thermal/sparse_sum.h"

namespace scree::thermal {

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

SparseMatrix joined(const std::vector<RowChunk>& chunks, int size) {
  std::vector<int> offset(chunks.size() + 1, 0);
  for (std::size_t c = 0; c < chunks.size(); ++c) offset[c + 1] = offset[c] + static_cast<int>(chunks[c].columns.size());
  SparseMatrix matrix = uninitialised(size, offset.back());
#pragma omp parallel for schedule(static) if (size >= rows_worth_sharing)
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    std::copy(chunks[c].columns.begin(), chunks[c].columns.end(), matrix.innerIndexPtr() + offset[c]);
    std::copy(chunks[c].values.begin(), chunks[c].values.end(), matrix.valuePtr() + offset[c]);
    int* end = matrix.outerIndexPtr() + c * rows_in_chunk + 1;
    for (const int row_end : chunks[c].ends) *end++ = offset[c] + row_end;
  }
  return matrix;
}

}  // namespace scree::thermal
