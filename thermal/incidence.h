// What has to do with each row.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace scree::thermal {

template <class Piece>
class PiecesOfRows {
 public:
  // for_each_use(visit) calls visit(row, piece) for all there are, the same twice over; those of one row on one thread.
  template <class ForEachUse>
  PiecesOfRows(std::size_t rows, const ForEachUse& for_each_use) : begin_(rows + 1, 0) {
    for_each_use([&](int row, const Piece&) { ++begin_[static_cast<std::size_t>(row) + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    pieces_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for_each_use([&](int row, const Piece& piece) { pieces_[next[static_cast<std::size_t>(row)]++] = piece; });
  }

  // In the order in which they were visited.
  [[nodiscard]] std::span<const Piece> of(int row) const {
    const auto at = static_cast<std::size_t>(row);
    return {pieces_.data() + begin_[at], pieces_.data() + begin_[at + 1]};
  }

 private:
  std::vector<std::uint32_t> begin_;  // of each row, and the end
  std::vector<Piece> pieces_;
};

// By the numbers of cells, elements, contacts.
using Incidence = PiecesOfRows<std::uint32_t>;

}  // namespace scree::thermal
