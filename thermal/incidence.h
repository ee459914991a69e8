// What has to do with each row.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "engine/base/grouped.h"

namespace scree::thermal {

template <class Piece>
class PiecesOfRows {
 public:
  explicit PiecesOfRows(Grouped<Piece, std::uint32_t> by_row) : pieces_(std::move(by_row)) {}

  // for_part(part, visit) calls visit(row, piece) for all there are in a part, the same twice over. On all threads.
  template <class ForPart>
  PiecesOfRows(std::size_t rows, std::size_t parts, const ForPart& for_part)
      : pieces_(grouped<Piece, std::uint32_t>(parts, rows, for_part)) {}

  // The same with one part: for_each_use(visit).
  template <class ForEachUse>
  PiecesOfRows(std::size_t rows, const ForEachUse& for_each_use)
      : PiecesOfRows(rows, 1, [&](std::size_t, const auto& visit) { for_each_use(visit); }) {}

  // In the order in which they were visited, part by part.
  [[nodiscard]] std::span<const Piece> of(int row) const { return pieces_.of(static_cast<std::size_t>(row)); }

 private:
  Grouped<Piece, std::uint32_t> pieces_;
};

// By the numbers of cells, elements, contacts.
using Incidence = PiecesOfRows<std::uint32_t>;

// for_rows(number, visit) calls visit(row) for every row that one of `count` numbers has to do with.
template <class ForRows>
Incidence incidence_of(std::size_t rows, std::size_t count, const ForRows& for_rows) {
  return Incidence(grouped_by_number<std::uint32_t, std::uint32_t>(count, rows, [&](std::size_t number, const auto& visit) {
    for_rows(number, [&](int row) { visit(row, static_cast<std::uint32_t>(number)); });
  }));
}

}  // namespace scree::thermal
