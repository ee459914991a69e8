// Numbers as the files of a run have them, whatever the locale of the process.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace scree {

// Of a text that is a number with a decimal point and nothing else.
inline std::optional<double> plain_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace scree
