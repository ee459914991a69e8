#include "engine/base/nearest.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scree {

// Optimal string alignment: three rows of the table of prefixes.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& names) {
  constexpr std::size_t longest = 100;  // a longer word is no misspelt name
  if (word.size() > longest) return std::nullopt;
  std::optional<std::string> best;
  std::size_t least = 0;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word, name);
    const std::size_t accepted = std::max<std::size_t>(2, name.size() / 3);
    // A word of which nothing is left is another word: "at" is not "every".
    if (distance > accepted || distance >= std::max(word.size(), name.size())) continue;
    if (!best || distance < least) {
      best = name;
      least = distance;
    }
  }
  return best;
}

std::string suggest(std::string_view word, const std::vector<std::string>& names) {
  if (const auto name = nearest(word, names)) return fmt::format("Did you mean {}?", *name);
  if (names.empty()) return {};
  constexpr std::size_t shown = 20;
  const std::vector<std::string> first(names.begin(),
                                       names.begin() + static_cast<std::ptrdiff_t>(std::min(shown, names.size())));
  return fmt::format("Known: {}{}", fmt::join(first, ", "), names.size() > shown ? ", ..." : "");
}

}  // namespace scree
