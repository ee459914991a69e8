#include "engine/base/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/mman.h>
#include <udunits2.h>
#include <unistd.h>

#include "engine/base/check.h"
#include "engine/base/plain_locale.h"
#include "engine/base/trimmed.h"

namespace scree {

namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
struct FreeSystem {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;
using System = std::unique_ptr<ut_system, FreeSystem>;

// Names that UDUNITS lacks, in one of its tables or in all.
void add_names(ut_system* system) {
  const auto name = [](const char* symbol, const Unit& unit) { ut_map_symbol_to_unit(symbol, UT_ASCII, unit.get()); };
  name("deg", Unit{ut_get_unit_by_name(system, "degree")});
  name("degC", Unit{ut_get_unit_by_symbol(system, "°C")});
  name("%", Unit{ut_scale(0.01, ut_get_dimensionless_unit_one(system))});
}

System read_table(const char* file) {
  ut_set_error_message_handler(ut_ignore);
  const PlainLocale decimal_points;
  System system{ut_read_xml(file)};
  if (system) add_names(system.get());
  return system;
}

// Without the long table of UDUNITS, that of units in common use, from which none of what most scenes name comes: it takes
// three times as long to read as all others. UDUNITS imports its tables into one file, which here lasts as long as the call.
System read_short_table() {
  ut_status ignored = UT_SUCCESS;
  const auto folder = std::filesystem::path(ut_get_path_xml(nullptr, &ignored)).parent_path();
  std::string text = "<unit-system>";
  for (const char* part : {"prefixes", "base", "derived", "accepted"}) {
    text += fmt::format("<import>{}/udunits2-{}.xml</import>", folder.string(), part);
  }
  text += "</unit-system>";
  const int file = ::memfd_create("units", MFD_CLOEXEC);
  if (file < 0) return nullptr;
  const bool written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  System system = written ? read_table(fmt::format("/proc/self/fd/{}", file).c_str()) : nullptr;
  ::close(file);
  return system;
}

// Each is read once, at the first unit that needs it, and never given back, which would take as long again.
ut_system* long_table() {
  static ut_system* const table = read_table(nullptr).release();
  if (table == nullptr) throw RunError("the table of units of UDUNITS-2 cannot be read (Debian package libudunits2-data)");
  return table;
}
ut_system* short_table() {
  static ut_system* const table = read_short_table().release();
  return table != nullptr ? table : long_table();
}

// What the short table knows, and the long one does not take for something else: there ft is a foot, here a femtotonne.
constexpr auto words_of_short_table = std::to_array<std::string_view>(
    {"%", "J",  "K",  "MJ",  "MPa", "MW", "N",  "Pa", "W",  "bar", "cm",  "d",  "day", "days", "deg", "degC", "g",
     "h", "kJ", "kN", "kPa", "kW",  "kg", "km", "m",  "mK", "mW",  "min", "mm", "ms",  "rad",  "s",   "t",    "um"});
static_assert(std::is_sorted(words_of_short_table.begin(), words_of_short_table.end()));

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// UDUNITS also reads products with numbers ("m 3" is 3 m), origins ("K @ 3") and dates: surely mistakes here. Digits may
// only be exponents: behind a letter, a sign, a hat, or another digit; but for the 1 of 1/s.
bool plain_spelling(std::string_view unit) {
  // A zero byte would end the unit for UDUNITS and hide the rest.
  if (unit.find('@') != std::string_view::npos || unit.find('\0') != std::string_view::npos) return false;
  for (std::size_t i = unit.starts_with("1/") ? 1 : 0; i < unit.size(); ++i) {
    if (!is_digit(unit[i])) continue;
    if (i == 0) return false;
    const char before = unit[i - 1];
    const bool exponent = std::isalnum(static_cast<unsigned char>(before)) || before == '-' || before == '+' || before == '^';
    if (!exponent) return false;
  }
  return true;
}

// Numbers and signs stand between words.
bool in_short_table(std::string_view spelling) {
  constexpr std::string_view between = " \t.*/^()+-0123456789";
  for (std::size_t begin = spelling.find_first_not_of(between); begin != std::string_view::npos;) {
    const std::size_t end = std::min(spelling.find_first_of(between, begin), spelling.size());
    const std::string_view word = spelling.substr(begin, end - begin);
    if (!std::binary_search(words_of_short_table.begin(), words_of_short_table.end(), word)) return false;
    begin = spelling.find_first_not_of(between, end);
  }
  return true;
}

Unit parse_unit(std::string_view spelling, ut_system* table) {
  return Unit{ut_parse(table, std::string(spelling).c_str(), UT_UTF8)};
}

constexpr std::string_view raised_minus = "⁻";

// m⁻² as m-2: UDUNITS knows the raised digits, but not the minus.
std::string without_superscripts(std::string_view spelling) {
  constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string plain(spelling);
  const auto replace = [&plain](std::string_view raised, const std::string& by) {
    for (auto at = plain.find(raised); at != std::string::npos; at = plain.find(raised, at))
      plain.replace(at, raised.size(), by);
  };
  replace(raised_minus, "-");
  for (std::size_t i = 0; i < digits.size(); ++i) replace(digits[i], std::to_string(i));
  return plain;
}

Unit parse_unit(std::string_view spelling) {
  if (spelling.starts_with('/')) return parse_unit(fmt::format("1{}", spelling));  // 10 /s
  if (spelling.find(raised_minus) != std::string_view::npos) return parse_unit(without_superscripts(spelling));
  if (!plain_spelling(spelling)) return nullptr;
  return parse_unit(spelling, in_short_table(spelling) ? short_table() : long_table());
}

// UDUNITS takes an angle for a plain number; a percentage is no angle all the same.
bool is_angle(const ut_unit* unit) {
  std::array<char, 64> text{};
  const int length = ut_format(unit, text.data(), text.size(), UT_DEFINITION | UT_ASCII);
  return length > 0 && std::string_view(text.data()).find("rad") != std::string_view::npos;
}

// UDUNITS also converts a unit into its reciprocal, 4 Hz into 0.25 s.
bool same_dimension(const ut_unit* a, const ut_unit* b) {
  const Unit ratio{ut_divide(a, b)};
  return ratio && ut_is_dimensionless(ratio.get()) != 0;
}

// From `unit` to the SI unit of the quantity, if they measure the same.
Converter converter_to(const Quantity& quantity, ut_unit* unit) {
  ut_system* const table = ut_get_system(unit);  // units of two tables have nothing to do with each other
  const Unit si = quantity.unit.empty() ? Unit{ut_get_dimensionless_unit_one(table)} : parse_unit(quantity.unit, table);
  SCREE_EXPECT(si != nullptr);
  if (!same_dimension(unit, si.get()) || is_angle(unit) != is_angle(si.get())) return nullptr;
  if (quantity.kind != Quantity::Kind::temperature_difference) return Converter{ut_get_converter(unit, si.get())};
  // As a factor of a product a unit loses its origin: degC m to K m is what differences need, without rounding at 273.15.
  const Unit metre{ut_get_unit_by_name(table, "meter")};
  const Unit from{ut_multiply(unit, metre.get())};
  const Unit to{ut_multiply(si.get(), metre.get())};
  return Converter{ut_get_converter(from.get(), to.get())};
}

struct Number {
  std::optional<double> value;  // nothing if it does not fit a double
  std::string_view rest;
};

std::optional<Number> leading_number(std::string_view text) {
  const bool has_sign = !text.empty() && (text.front() == '+' || text.front() == '-');
  const std::string_view digits = has_sign ? text.substr(1) : text;
  // from_chars also reads "inf" and "nan".
  if (digits.empty() || !(is_digit(digits.front()) || digits.front() == '.')) return std::nullopt;
  if (text.front() == '+') text = digits;  // from_chars does not know it
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument) return std::nullopt;
  Number number{value, trimmed(text.substr(static_cast<std::size_t>(end - text.data())))};
  if (error == std::errc::result_out_of_range) number.value.reset();
  return number;
}

bool measures(std::string_view unit, const Quantity& quantity) {
  const Unit parsed = parse_unit(unit);
  return parsed && converter_to(quantity, parsed.get());
}

// How the unit might have been spelt: 60 mins, 10 Min, 0.88 kJ/kgK, 3.1 W/m K, 3.1 W/m.
std::vector<std::string> respelt(std::string_view unit) {
  std::vector<std::string> spellings;
  if (unit.ends_with('s')) spellings.emplace_back(unit.substr(0, unit.size() - 1));
  std::string small(unit);
  std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
  spellings.push_back(small);
  if (unit.ends_with('K')) unit = unit.substr(0, unit.find_last_not_of(" .*·K") + 1);
  spellings.push_back(fmt::format("{}/K", unit));
  return spellings;
}

// The unit of this quantity that is probably meant, if it is clear; behind the same number any other would be another value.
std::optional<std::string> likely_unit(std::string_view unit, const Quantity& quantity) {
  const bool warm = quantity.kind != Quantity::Kind::scale;
  // However its degrees are written: C, deg C, oC.
  if (warm && (unit.ends_with('C') || unit == "c" || unit == "deg" || unit.ends_with("elsius"))) return "degC";
  if (warm && (unit.ends_with('F') || unit == "f" || unit.ends_with("ahrenheit"))) return "degF";
  if (quantity.unit == "s" && unit == "m") return "min";
  if (quantity.unit == "m" && unit == "M") return "m";
  for (const std::string& spelling : respelt(unit)) {
    if (measures(spelling, quantity)) return spelling;
  }
  return std::nullopt;
}

UnitProblem wrong_unit(std::string_view number, std::string_view unit, const Quantity& quantity, bool known) {
  UnitProblem problem;
  if (quantity.unit.empty()) {
    problem.reason = fmt::format("{} is no unit of a plain number", unit);
    problem.suggestion = number.empty() ? "Leave it out" : fmt::format("Did you mean {}?", number);
    return problem;
  }
  problem.reason = known ? fmt::format("{} is no unit of {}", unit, quantity.name) : fmt::format("{} is no known unit", unit);
  const std::optional<std::string> likely = likely_unit(unit, quantity);
  problem.suggestion = likely ? fmt::format("Did you mean {}{}{}?", number, number.empty() ? "" : " ", *likely)
                              : fmt::format("Write it in {} or another unit of {}", quantity.unit, quantity.name);
  return problem;
}

// Behind a number in the text of a quantity: what begins so makes no number of it, as in 1:30, 2*60 s and 2_500.
bool may_be_unit(std::string_view rest) {
  constexpr std::string_view never = ",:*_+-";
  return never.find(rest.front()) == std::string_view::npos;
}

}  // namespace

std::variant<double, UnitProblem> parse_quantity(std::string_view text, const Quantity& quantity) {
  text = trimmed(text);
  const std::optional<Number> number = leading_number(text);
  if (!number) {
    return UnitProblem{quantity.unit.empty() ? "not a number" : "not a number, with or without a unit", ""};
  }
  if (!number->value) return UnitProblem{"too large or too small for a number in double precision", ""};
  if (number->rest.empty()) return *number->value;

  if (!may_be_unit(number->rest)) {
    return UnitProblem{"not a number",
                       number->rest.starts_with(',') ? "Write decimals with a point" : "Write it as one number"};
  }
  const std::string_view digits = trimmed(text.substr(0, text.size() - number->rest.size()));
  const Unit unit = parse_unit(number->rest);
  if (!unit) return wrong_unit(digits, number->rest, quantity, false);
  const Converter converter = converter_to(quantity, unit.get());
  if (!converter) return wrong_unit(digits, number->rest, quantity, true);

  const double value = cv_convert_double(converter.get(), *number->value);
  if (!std::isfinite(value)) return UnitProblem{"too large for a number in double precision", ""};
  return value;
}

double UnitConverter::operator()(double value) const {
  return cv_convert_double(static_cast<const cv_converter*>(converter_.get()), value);
}

std::variant<UnitConverter, UnitProblem> unit_converter(std::string_view spelling, const Quantity& quantity) {
  spelling = trimmed(spelling);
  const bool si = spelling.empty() || spelling == quantity.unit;
  const Unit unit = si ? Unit{ut_get_dimensionless_unit_one(short_table())} : parse_unit(spelling);
  if (!unit) return wrong_unit("", spelling, quantity, false);
  Converter converter = si ? Converter{ut_get_converter(unit.get(), unit.get())} : converter_to(quantity, unit.get());
  if (!converter) return wrong_unit("", spelling, quantity, true);
  return UnitConverter(std::shared_ptr<cv_converter>(std::move(converter)));
}

}  // namespace scree
