// Several products in a row, K x, K of what was made of that, and so on, with each row of K read from memory once for some of
// them: as soon as a stretch of rows and its two neighbours are done, their next product can be taken, while they are in the
// cache. (Wavefronts over levels, as in C. Alappat, G. Hager, O. Schenk, G. Wellein, IEEE Trans. Parallel Distrib. Syst. 34(2),
// 2023.) What a row comes to depends on its neighbours' last values only, so the order of rows does not change a bit.
//
// A tile is a stretch of rows whose columns lie in itself and the tiles beside it. In phase w, product j is taken of tile w -
// 2j: that of product j - 1 of both its neighbours was taken in the phase before at the latest, and nothing that another task
// of the same phase reads is written.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace scree::thermal {

// Consecutive rows that are worked off together.
struct RowStretch {
  int end;            // row
  int reach;          // one more than the last column of its rows and of all before
  std::int64_t work;  // entries that are read
};

class RowTiles {
 public:
  // Tiles of one matrix out of such stretches of its rows.
  explicit RowTiles(const std::vector<RowStretch>& stretches);

  // Products that are taken together: 1 if that would not pay.
  [[nodiscard]] int depth() const { return depth_; }

  // Tasks of each phase, of `depth` products.
  [[nodiscard]] std::vector<int> tasks(int depth) const;

  struct Task {
    int product;             // of those taken together
    std::size_t begin, end;  // stretches
  };
  [[nodiscard]] Task task(int depth, int phase, int number) const;

 private:
  [[nodiscard]] int tiles() const { return static_cast<int>(ends_.size()) - 1; }
  [[nodiscard]] int tasks_of_tile(int tile) const;

  std::vector<std::size_t> ends_;  // stretches: tile t is from ends_[t] to ends_[t + 1]
  int depth_ = 1;
};

}  // namespace scree::thermal
