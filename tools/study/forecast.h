// How much of a study's work is done, where runs that settle a pile first take longer than those that only heat it.
#pragma once

#include <array>
#include <cstddef>

namespace scree::study {

class Forecast {
 public:
  void expect(bool settles) { ++kinds_[settles ? 1 : 0].expected; }

  void count(bool settles, double wall_seconds) {
    Kind& kind = kinds_[settles ? 1 : 0];
    ++kind.done;
    kind.seconds += wall_seconds;
  }

  // 0 to 1, by the mean time of each kind of run so far.
  [[nodiscard]] double done_part() const {
    double done = 0;
    double all = 0;
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      // What nobody has measured takes as long as the other kind.
      const double mean = kinds_[i].done > 0 ? kinds_[i].mean() : kinds_[1 - i].mean();
      done += mean * static_cast<double>(kinds_[i].done);
      all += mean * static_cast<double>(kinds_[i].expected);
    }
    return all > 0 ? done / all : 0;
  }

 private:
  struct Kind {
    std::size_t expected = 0;
    std::size_t done = 0;
    double seconds = 0;

    [[nodiscard]] double mean() const { return done > 0 ? seconds / static_cast<double>(done) : 0; }
  };
  std::array<Kind, 2> kinds_;  // only heats, settles
};

}  // namespace scree::study
