#include "tools/study/study_keys.h"

#include "engine/base/key_row.h"
#include "tools/study/study.h"

namespace scree::study {

namespace {

using enum KeyType;
namespace q = quantity;

constexpr Range many{.low = 2, .high = most_runs};

std::vector<Key> varied_keys() {
  return {
      row("scene", path, "The base scene, relative to this file.").required(),
      row("set", list, "What every run has otherwise than the base scene, as KEY=VALUE.").fallback("[]"),
      row("set[]", text, "One change."),
      row("error_estimate", flag, "Estimate the space error of every run, too.").fallback("false"),
      row("vary", list, "What varies; every combination is a run, unless latin_hypercube is given.").fallback("[]"),
      row("vary[]", section, "One key that varies."),
      row("vary[].key", text, "Its path in the scene, as in --set.").required(),
      row("vary[].also", list, "Other keys that take the same value.").fallback("[]"),
      row("vary[].also[]", text, "One of them."),
      row("vary[].values", list, "The values, as in --set.").range(at_least_one).required().choice("form"),
      row("vary[].values[]", text, "One value; a vector in quotes."),
      row("vary[].range", section, "From one value to another.").required().choice("form"),
      row("vary[].range.from", text, "The first value, with its unit.").required(),
      row("vary[].range.to", text, "The last value, with its unit.").required(),
      row("vary[].range.points", integer, "How many values, the ends among them.")
          .range(many)
          .required()
          .only({Condition{.key = "latin_hypercube", .absent = true}}),
      row("vary[].range.spacing", word, "Equal differences or equal ratios.").words({"linear", "log"}).fallback("linear"),
  };
}

std::vector<Key> other_keys() {
  return {
      row("latin_hypercube", section,
          "So many points, each in a layer of its own along every varied key; equal ones are one run."),
      row("latin_hypercube.points", integer, "How many.").range(many).required(),
      row("latin_hypercube.seed", integer, "Another seed, other points.").range(not_negative).fallback("1"),
      row("ensemble", section, "Repeats every combination with another chance, for means and their confidence."),
      row("ensemble.key", text, "The scene's key that holds the chance, such as settle.seed.").required(),
      row("ensemble.members", integer, "How many times.").range(many).required(),
      row("ensemble.first", integer, "The first member's value; the others count on from it.")
          .range(not_negative)
          .fallback("1"),
      row("report", list, "The table's columns beside what varies.").range(at_least_one).required(),
      row("report[]", text, "A path in summary.json, such as heat.probes.inside.temperature; or a map."),
      row("report[].column", text, "What the column is called.").required(),
      row("report[].path", text, "A path in summary.json.").required().choice("figure"),
      row("report[].probe", text, "A probe of the scene, for the time when it reaches a temperature.")
          .required()
          .choice("figure"),
      row("report[].reaches", quantity, "That temperature.", q::temperature)
          .required()
          .only({Condition{.key = "report[].probe"}}),
  };
}

KeyTable make_table() {
  std::vector<Key> keys = varied_keys();
  for (Key& key : other_keys()) keys.push_back(std::move(key));
  return KeyTable(std::move(keys));
}

}  // namespace

const KeyTable& study_keys() {
  static const KeyTable table = make_table();
  return table;
}

}  // namespace scree::study
