// Where steps may end: an interval between two output times, or a power of two of them, halved again and again.
//
// Steps of one interval are its length over a power of two and aligned, so the interval's end is met exactly, only a few
// different steps occur (each costs a factorisation), and a run resumed at an output time takes the same steps to the bit.
#pragma once

#include <cmath>
#include <cstdint>

namespace scree::thermal {

class StepGrid {
 public:
  // The coarsest steps that are no longer than `wanted`, but for rounding: that is as long as a step of another interval, which
  // may have been cut short by a few roundings at a jump.
  StepGrid(double start, double length, double wanted) : start_(start), length_(length) {
    constexpr double as_long = 1 + 1e-9;
    while (step() > as_long * wanted && level_ < max_level) ++level_;
  }

  static constexpr int max_level = 52;  // beyond it the position is no exact double

  [[nodiscard]] double step() const { return std::ldexp(length_, -level_); }
  [[nodiscard]] double time() const { return start_ + static_cast<double>(position_) * step(); }
  [[nodiscard]] bool done() const { return position_ == std::int64_t{1} << level_; }
  [[nodiscard]] int level() const { return level_; }

  // Goes on by a step and gives the length of the next: twice and four times as long if may_be(length) and the grid allow it.
  // At the interval's end the next one's grid begins, whose steps may be longer.
  template <class MayBe>
  double advance(const MayBe& may_be) {
    double next = step();
    ++position_;
    for (int doubled = 0; doubled < 2 && may_be(2 * next); ++doubled) {
      if (!done() && !coarsen()) break;
      next *= 2;
    }
    return next;
  }

  // Halves the step; not possible beyond max_level.
  void refine() {
    ++level_;
    position_ *= 2;
  }

 private:
  // Doubles the step where the grid allows it: not on an odd position, and not above the whole interval.
  bool coarsen() {
    if (level_ == 0 || position_ % 2 != 0) return false;
    --level_;
    position_ /= 2;
    return true;
  }

  double start_;   // [s]
  double length_;  // [s]
  int level_ = 0;  // steps are length / 2^level
  std::int64_t position_ = 0;
};

}  // namespace scree::thermal
