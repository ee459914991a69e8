#include "thermal/top_supernodes.h"

#include <algorithm>

namespace scree::thermal {

namespace {

constexpr int columns_in_block = 96;
constexpr int rows_in_piece = 192;

}  // namespace

// Phases forward: for each block its corner, then the rows after it. One turns. Phases backward: for each block, from the last
// to the first, the rows after it, then its corner.
void TopSupernodes::set(const SupernodalPattern& pattern, const std::vector<int>& supernodes) {
  pattern_ = pattern;
  for (const int s : supernodes) {
    const int rows = pattern.rows_of(s), columns = pattern.columns_of(s);
    most_rows_ = std::max(most_rows_, rows);
    for (int begin = 0; begin < columns; begin += columns_in_block) {
      const int end = std::min(columns, begin + columns_in_block);
      const int pieces = (rows - end + rows_in_piece - 1) / rows_in_piece;
      blocks_.push_back({s, {begin, end}, pieces > 1 ? pieces : 0});
      most_pieces_ = std::max(most_pieces_, pieces);
    }
  }
  for (const Block& block : blocks_) sizes_.insert(sizes_.end(), {1, block.pieces});
  if (!blocks_.empty()) sizes_.push_back(1);
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block) sizes_.insert(sizes_.end(), {block->pieces, 1});
}

template <int sides>
TopSupernodes::Space TopSupernodes::space() const {
  return {std::vector<double>(static_cast<std::size_t>(sides * most_rows_)),
          std::vector<double>(static_cast<std::size_t>(sides * most_pieces_ * columns_in_block))};
}

Span TopSupernodes::rows_of(const Block& block, int piece) const {
  const int begin = block.columns.end + piece * rows_in_piece;
  return {begin, std::min(pattern_.rows_of(block.supernode), begin + rows_in_piece)};
}

template <int sides, class Value>
void TopSupernodes::forward_corner(std::size_t number, const Value* values, double* x, double* w) const {
  const Block& block = blocks_[number];
  const Supernode<Value> node = pattern_.supernode(values, block.supernode);
  if (block.columns.begin == 0) {
    if (number > 0) pattern_.store<sides>(blocks_[number - 1].supernode, pattern_.rows_of(blocks_[number - 1].supernode), w, x);
    pattern_.load<sides>(block.supernode, node.columns, x, w);
  }
  forward<sides>(node, block.columns, block.pieces > 0 ? block.columns.end : node.rows, w);
}

template <int sides, class Value>
void TopSupernodes::backward_corner(std::size_t number, const Value* values, double* x, Space& space) const {
  const Block& block = blocks_[number];
  const Supernode<Value> node = pattern_.supernode(values, block.supernode);
  const int columns = block.columns.end - block.columns.begin;
  double* w = space.w.data();
  for (int piece = 0; piece < block.pieces; ++piece) {
    const double* sums = space.sums.data() + static_cast<std::ptrdiff_t>(piece) * sides * columns_in_block;
    for (int c = 0; c < sides; ++c) {
      for (int q = 0; q < columns; ++q) w[c * node.rows + block.columns.begin + q] -= sums[c * columns + q];
    }
  }
  backward<sides>(node, block.columns, block.pieces > 0 ? block.columns.end : node.rows, w);
  if (block.columns.begin > 0) return;
  pattern_.store<sides>(block.supernode, node.columns, w, x);
  if (number > 0) pattern_.load<sides>(blocks_[number - 1].supernode, pattern_.rows_of(blocks_[number - 1].supernode), x, w);
}

template <int sides, class Value>
void TopSupernodes::run(int phase, int task, const Value* values, double* x, Space& space) const {
  const int turn = 2 * static_cast<int>(blocks_.size());
  double* w = space.w.data();
  if (phase < turn) {
    const auto number = static_cast<std::size_t>(phase / 2);
    if (phase % 2 == 0) return forward_corner<sides>(number, values, x, w);
    const Block& block = blocks_[number];
    return subtract<sides>(pattern_.supernode(values, block.supernode), block.columns, rows_of(block, task), w);
  }
  if (phase == turn) {
    const int last = blocks_.back().supernode;
    pattern_.store<sides>(last, pattern_.rows_of(last), w, x);
    return pattern_.load<sides>(last, pattern_.rows_of(last), x, w);
  }
  const auto number = blocks_.size() - 1 - static_cast<std::size_t>((phase - turn - 1) / 2);
  if ((phase - turn) % 2 == 0) return backward_corner<sides>(number, values, x, space);
  const Block& block = blocks_[number];
  double* sums = space.sums.data() + static_cast<std::ptrdiff_t>(task) * sides * columns_in_block;
  multiply<sides>(pattern_.supernode(values, block.supernode), block.columns, rows_of(block, task), w, sums);
}

template TopSupernodes::Space TopSupernodes::space<1>() const;
template TopSupernodes::Space TopSupernodes::space<2>() const;
template void TopSupernodes::run<1>(int, int, const double*, double*, Space&) const;
template void TopSupernodes::run<2>(int, int, const double*, double*, Space&) const;
template void TopSupernodes::run<1>(int, int, const float*, double*, Space&) const;
template void TopSupernodes::run<2>(int, int, const float*, double*, Space&) const;

}  // namespace scree::thermal
