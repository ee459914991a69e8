// The grid against testing every box with every other.
#include "contact/box_grid.h"

#include <cmath>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace scree::contact {
namespace {

template <int dim>
std::vector<Aabb<dim>> random_boxes(std::size_t count, double extent, double largest, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Aabb<dim>> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    // Sizes over three orders of magnitude.
    const double size = largest * std::pow(10.0, -3 * unit(random));
    const Point<dim> low = extent * Point<dim>::NullaryExpr([&]() { return unit(random); });
    boxes.emplace_back(low, low + size * Point<dim>::NullaryExpr([&]() { return unit(random); }));
  }
  return boxes;
}

template <int dim>
void compare(const std::vector<Aabb<dim>>& boxes, std::size_t at_least) {
  const BoxGrid<dim> grid(boxes);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  Places found;
  for (std::uint32_t place = 0; place < boxes.size(); ++place) {
    grid.find(place, found);
    for (const auto other : found) {
      const std::pair<std::uint32_t, std::uint32_t> pair = std::minmax(grid.order()[place], grid.order()[other]);
      EXPECT_TRUE(pairs.insert(pair).second) << pair.first << " and " << pair.second << " found each other";
    }
  }
  Aabb<dim> all;
  for (const auto& box : boxes) all.extend(box);
  const double rounding = 1e-6 * all.diagonal().norm();
  std::size_t meeting = 0;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      const bool found_it = pairs.count({i, j}) > 0;
      if (boxes[i].intersects(boxes[j])) {
        ++meeting;
        EXPECT_TRUE(found_it) << i << " and " << j << " meet";
      } else if (found_it) {
        EXPECT_LT(boxes[i].exteriorDistance(boxes[j]), rounding) << i << " and " << j << " are apart";
      }
    }
  }
  EXPECT_GT(meeting, at_least);
}

TEST(BoxGrid, FindsEveryTwoBoxesThatMeetOnce) {
  std::mt19937 random(3);
  compare<2>(random_boxes<2>(2000, 1, 0.5, random), 2000);
  compare<3>(random_boxes<3>(2000, 1, 1, random), 2000);
}

TEST(BoxGrid, FindsThemFarFromTheOriginToo) {
  std::mt19937 random(4);
  auto boxes = random_boxes<3>(1000, 1, 1, random);
  for (auto& box : boxes) box.translate(Point<3>(1e6, -1e6, 1e6));
  compare<3>(boxes, 500);
}

TEST(BoxGrid, FindsThemInAFlatLayerWithOneBoxFarAway) {
  std::mt19937 random(5);
  auto boxes = random_boxes<3>(2000, 1, 0.5, random);
  for (auto& box : boxes) box.translate(Point<3>(0, 0, -0.999 * box.min().z()));
  boxes.emplace_back(Point<3>(900, 900, 900), Point<3>(901, 900.1, 900.1));
  compare<3>(boxes, 1000);
}

TEST(BoxGrid, FindsAllThatMeetAnyBox) {
  std::mt19937 random(6);
  const auto boxes = random_boxes<3>(1000, 1, 0.5, random);
  const BoxGrid<3> grid(boxes);
  Places found;
  for (auto box : random_boxes<3>(100, 1, 5, random)) {
    box.translate(Point<3>(-0.5, 0, 0.3));
    grid.find(box, found);
    std::set<std::uint32_t> members;
    for (const auto place : found) EXPECT_TRUE(members.insert(grid.order()[place]).second) << "found twice";
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].intersects(box)) {
        EXPECT_EQ(members.count(i), 1);
      } else if (members.count(i) > 0) {
        EXPECT_LT(boxes[i].exteriorDistance(box), 1e-5);
      }
    }
  }
}

TEST(BoxGrid, LooksOnlyAtAHandfulOfBoxesWhateverTheirNumber) {
  // A layer of unit boxes, each of which meets its eight neighbours: half of them find it.
  std::vector<Aabb<3>> boxes;
  for (int i = 0; i < 10000; ++i) {
    const Point<3> low(i % 100, i / 100, 0);
    boxes.emplace_back(low, low + Point<3>(1, 1, 1));
  }
  const BoxGrid<3> grid(boxes);
  Places found;
  std::size_t pairs = 0;
  for (std::uint32_t place = 0; place < boxes.size(); ++place) {
    grid.find(place, found);
    EXPECT_LE(found.size(), 8);
    pairs += found.size();
  }
  EXPECT_EQ(pairs, 2 * 100 * 99 + 2 * 99 * 99);
}

}  // namespace
}  // namespace scree::contact
