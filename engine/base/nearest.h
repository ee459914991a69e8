// The name a user probably meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The first of the closest names, if it is close enough to be what was meant: a third of its letters may differ, and two
// always.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& names);

// "Did you mean density?", or what there is to choose from: "Known: density, friction". Empty without names.
std::string suggest(std::string_view word, const std::vector<std::string>& names);

}  // namespace scree
