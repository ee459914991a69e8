// The restart file: HDF5, one data set per vector, the rest as two lists, and a digest of it all, so that a damaged file is
// noticed.
#include <new>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/check.h"
#include "engine/base/hash.h"
#include "engine/base/hdf5_image.h"
#include "engine/base/hdf5_reader.h"
#include "thermal/heat_run.h"
#include "thermal/problems.h"

namespace scree::thermal {

namespace {

constexpr const char* format_name = "scree heat state 9";

using Doubles = std::vector<double>;
using Counts = std::vector<std::int64_t>;

// A state as plain lists: when it is written, the long ones stay where they are.
template <class Values>
struct Lists {
  Values temperature, error, rate, lumping, by_boundary, by_applied, by_surroundings, matrix, before, before_that;
  Doubles numbers;
  Counts counts;
};
using ReadLists = Lists<Doubles>;
using WrittenLists = Lists<std::span<const double>>;

// Calls use(name, list) for all of them, in the order in which they are written.
template <class SomeLists, class Use>
void for_each_list(SomeLists& lists, const Use& use) {
  use("temperature", lists.temperature);
  use("error", lists.error);
  use("rate", lists.rate);
  use("lumping", lists.lumping);
  use("by_boundary", lists.by_boundary);
  use("by_applied", lists.by_applied);
  use("by_surroundings", lists.by_surroundings);
  use("matrix", lists.matrix);
  use("before", lists.before);
  use("before_that", lists.before_that);
  use("numbers", lists.numbers);
  use("counts", lists.counts);
}

std::span<const double> list_of(const Eigen::VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

// The next step makes the last of the earlier ends one too many.
constexpr std::size_t kept_ends = BetweenSteps::ends_before - 1;

std::span<const double> list_of(const StepEnds& ends, std::size_t which) {
  return which < ends.size() ? list_of(*ends[which].temperature) : std::span<const double>();
}
double time_of(const StepEnds& ends, std::size_t which) {
  return which < ends.size() ? ends[which].time : 0;
}

Eigen::VectorXd vector_of(const Doubles& list) {
  return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

WrittenLists pack(const HeatState& state) {
  const Ledger& ledger = state.ledger;
  return {list_of(state.temperature),
          list_of(state.error),
          list_of(state.rate),
          list_of(state.lumping.carried),
          ledger.by_boundary,
          ledger.by_applied,
          ledger.by_surroundings,
          list_of(state.matrix.temperature),
          list_of(state.earlier, 0),
          list_of(state.earlier, 1),
          {state.time, state.next_step, state.time_error, state.least_step, state.largest_step, ledger.start_jump,
           ledger.stored, ledger.turnover, state.reached.least, state.reached.largest, state.given.least, state.given.largest,
           state.lumping.largest, state.matrix.time, state.matrix.scale, time_of(state.earlier, 0), time_of(state.earlier, 1)},
          {state.steps, state.rejected_steps, state.factorisations}};
}

HeatState unpack(const ReadLists& lists) {
  HeatState state;
  state.temperature = vector_of(lists.temperature);
  state.error = vector_of(lists.error);
  state.rate = vector_of(lists.rate);
  state.lumping = {vector_of(lists.lumping), lists.numbers.at(12)};
  state.ledger.by_boundary = lists.by_boundary;
  state.ledger.by_applied = lists.by_applied;
  state.ledger.by_surroundings = lists.by_surroundings;
  state.time = lists.numbers.at(0);
  state.next_step = lists.numbers.at(1);
  state.time_error = lists.numbers.at(2);
  state.least_step = lists.numbers.at(3);
  state.largest_step = lists.numbers.at(4);
  state.ledger.start_jump = lists.numbers.at(5);
  state.ledger.stored = lists.numbers.at(6);
  state.ledger.turnover = lists.numbers.at(7);
  state.reached = {lists.numbers.at(8), lists.numbers.at(9)};
  state.given = {lists.numbers.at(10), lists.numbers.at(11)};
  state.matrix = {vector_of(lists.matrix), lists.numbers.at(13), lists.numbers.at(14)};
  const std::array<const Doubles*, kept_ends> earlier{&lists.before, &lists.before_that};
  for (std::size_t i = 0; i < kept_ends; ++i) {
    if (earlier[i]->empty()) break;
    state.earlier.push_back({lists.numbers.at(15 + i), std::make_shared<const Eigen::VectorXd>(vector_of(*earlier[i]))});
  }
  state.steps = lists.counts.at(0);
  state.rejected_steps = lists.counts.at(1);
  state.factorisations = lists.counts.at(2);
  return state;
}

template <class SomeLists>
std::string digest(const std::string& key, const SomeLists& lists) {
  Hasher hasher;
  hasher.add(key);
  for_each_list(lists, [&](const char*, const auto& list) {
    hasher.add(list.size()).add_bytes(list.data(), list.size() * sizeof list.front());
  });
  return hasher.hex();
}

void read(const Hdf5Reader& in, const char* name, Doubles& list) {
  list = in.doubles(name);
}
void read(const Hdf5Reader& in, const char* name, Counts& list) {
  list = in.integers(name);
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& rule, const std::string& suggestion) {
  Problem wrong = problem("heat state", "", rule, suggestion);
  wrong.where.file = file.string();
  throw InputError(wrong);
}

}  // namespace

void write(const HeatState& state, const std::string& key, const std::filesystem::path& file) {
  const WrittenLists lists = pack(state);
  std::size_t numbers = 0;
  for_each_list(lists, [&](const char*, const auto& list) { numbers += list.size(); });
  Hdf5Image image(sizeof(double) * numbers);
  image.put_attribute("format", format_name);
  image.put_attribute("key", key);
  image.put_attribute("digest", digest(key, lists));
  for_each_list(lists, [&](const char* name, const auto& list) { image.put(name, list); });
  write_text(file, image.bytes());
}

HeatState read_state(const std::filesystem::path& file, const std::string& key) {
  if (!std::filesystem::exists(file)) refuse(file, "no such file", "Run the scene from its start");
  const std::string damaged = "must be a whole heat state; this one is damaged or something else";
  try {
    const Hdf5Reader in(file);
    if (in.text_attribute("format") != format_name) refuse(file, damaged, "Delete it and run the scene from its start");
    const std::string found = in.text_attribute("key");
    ReadLists lists;
    for_each_list(lists, [&](const char* name, auto& list) { read(in, name, list); });
    const bool whole =
        in.text_attribute("digest") == digest(found, lists) && lists.numbers.size() == 17 && lists.counts.size() == 3;
    if (!whole) refuse(file, damaged, "Delete it and run the scene from its start");
    if (found != key) {
      refuse(file, "must belong to this scene; its blocks, contacts or heat have changed since",
             "Run the scene from its start");
    }
    return unpack(lists);
  } catch (const Hdf5Error&) {
    refuse(file, damaged, "Delete it and run the scene from its start");
  } catch (const std::logic_error&) {  // a text that is not there, or a list longer than any
    refuse(file, damaged, "Delete it and run the scene from its start");
  } catch (const std::bad_alloc&) {  // or than memory
    refuse(file, damaged, "Delete it and run the scene from its start");
  }
}

}  // namespace scree::thermal
