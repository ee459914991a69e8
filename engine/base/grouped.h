// Brings together what belongs to the same of many groups, in linear time and on all threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/chunks.h"
#include "engine/base/threads.h"
#include "engine/base/written_later.h"

namespace scree {

template <class Value, class Start>
struct Grouped {
  LargeVector<Start> begin;          // of each group's values, and the end
  VectorWrittenLater<Value> values;  // of a group in the order of the parts they come from, and as they come within a part

  // Those of one group.
  [[nodiscard]] std::span<Value> of(std::size_t group) {
    return {values.data() + begin[group], values.data() + begin[group + 1]};
  }
  [[nodiscard]] std::span<const Value> of(std::size_t group) const {
    return {values.data() + begin[group], values.data() + begin[group + 1]};
  }
};

// Every thread has a band of groups and as large a share of the parts. What it finds there for another band it puts aside for
// that one, so that no two threads write to the same place: counters to which all may add take several times as long. Where
// groups and parts follow the same order, little is put aside.
template <class Value, class Start, class ForPart>
class Grouping {
 public:
  Grouping(std::size_t parts, std::size_t groups, const ForPart& for_part)
      : parts_(parts),
        for_part_(for_part),
        bands_(std::clamp<std::size_t>(parts, 1, static_cast<std::size_t>(threads_in_use()))),
        band_size_((groups + bands_ - 1) / bands_),
        share_((parts + bands_ - 1) / bands_),
        strays_(bands_) {
    // Each start is counted two places on and moves one on while values are put.
    grouped_.begin.assign(groups + 2, 0);
    for_bands([&](std::size_t band) { count(band); });
    for_bands([&](std::size_t band) {
      for_strays(0, bands_, band, [&](std::size_t group, const Value&) { ++grouped_.begin[group + 2]; });
    });
    std::partial_sum(grouped_.begin.begin(), grouped_.begin.end(), grouped_.begin.begin());
    grouped_.values.resize(grouped_.begin.back());
    for_bands([&](std::size_t band) { put(band); });
    grouped_.begin.pop_back();
  }

  [[nodiscard]] Grouped<Value, Start> take() { return std::move(grouped_); }

 private:
  using Strays = std::vector<std::pair<std::uint32_t, Value>>;

  template <class Body>
  void for_bands(const Body& body) const {
    const auto count = static_cast<std::int64_t>(bands_);
#pragma omp parallel for schedule(static, 1) if (count > 1)
    for (std::int64_t band = 0; band < count; ++band) body(static_cast<std::size_t>(band));
  }

  // Counts what a band finds in its parts for itself.
  void count(std::size_t band) {
    std::vector<Strays> strays(bands_);
    for_parts(
        band, [&](std::size_t group, const Value&) { ++grouped_.begin[group + 2]; },
        [&](std::uint32_t group, const Value& value) {
          strays[group / band_size_].push_back({group, value});
        });
    strays_[band] = std::move(strays);
  }

  // What other bands found for this one goes before and behind what it finds itself, as their parts do.
  void put(std::size_t band) {
    const auto put = [&](std::size_t group, const Value& value) { grouped_.values[grouped_.begin[group + 1]++] = value; };
    for_strays(0, band, band, put);
    for_parts(band, put, [](std::uint32_t, const Value&) {});
    for_strays(band + 1, bands_, band, put);
  }

  template <class Own, class Other>
  void for_parts(std::size_t band, const Own& own, const Other& other) const {
    const std::size_t first = band * band_size_;
    for (std::size_t part = band * share_; part < std::min(parts_, (band + 1) * share_); ++part) {
      for_part_(part, [&](std::uint32_t group, const Value& value) {
        group - first < band_size_ ? own(group, value) : other(group, value);
      });
    }
  }

  template <class Visit>
  void for_strays(std::size_t from, std::size_t end, std::size_t band, const Visit& visit) const {
    for (; from < end; ++from) {
      for (const auto& [group, value] : strays_[from][band]) visit(group, value);
    }
  }

  std::size_t parts_;
  const ForPart& for_part_;
  std::size_t bands_;
  std::size_t band_size_;                    // groups of a band, but of the last, which may have fewer
  std::size_t share_;                        // parts of a band, likewise
  std::vector<std::vector<Strays>> strays_;  // by the band that found them, then by the one that they belong to
  Grouped<Value, Start> grouped_;
};

// for_part(part, visit) calls visit(group, value) for all that is in a part, twice and the same both times. The same for any
// number of threads.
template <class Value, class Start = std::size_t, class ForPart>
Grouped<Value, Start> grouped(std::size_t parts, std::size_t groups, const ForPart& for_part) {
  return Grouping<Value, Start, ForPart>(parts, groups, for_part).take();
}

// The same for what belongs to each of `count` numbers, of which every chunk is a part: for_one(number, visit).
template <class Value, class Start = std::size_t, class ForOne>
Grouped<Value, Start> grouped_by_number(std::size_t count, std::size_t groups, const ForOne& for_one) {
  return grouped<Value, Start>(chunk_count(count), groups, [&](std::size_t part, const auto& visit) {
    const Chunk chunk = chunk_of(count, part);
    for (std::size_t number = chunk.begin; number < chunk.end; ++number) for_one(number, visit);
  });
}

}  // namespace scree
