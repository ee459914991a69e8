#include "engine/base/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <utility>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace scree {

namespace {

constexpr double terminal_interval = 0.1;  // between two drawings [s]
constexpr double lines_interval = 10;      // between two lines of a log [s]
constexpr double json_interval = 1;        // between two objects [s]

using Json = nlohmann::ordered_json;

// A path in it may be of any bytes.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

ProgressMode progress_mode(bool quiet) {
  if (quiet) return ProgressMode::quiet;
  const char* terminal = std::getenv("TERM");
  const bool erases = terminal != nullptr && std::string_view(terminal) != "dumb";
  return ::isatty(STDERR_FILENO) != 0 && erases ? ProgressMode::terminal : ProgressMode::lines;
}

std::string format_duration(double seconds) {
  // As a double, since an estimate may exceed every integer.
  const double whole = std::ceil(seconds);
  if (whole < 60) return fmt::format("{:.0f} s", whole);
  if (whole < 3600) return fmt::format("{:.0f} min {:02.0f} s", std::floor(whole / 60), std::fmod(whole, 60));
  return fmt::format("{:.0f} h {:02.0f} min", std::floor(whole / 3600), std::floor(std::fmod(whole, 3600) / 60));
}

Progress::Progress(ProgressMode mode)
    : Progress(mode, mode == ProgressMode::json ? std::cout : std::cerr, steady_seconds, terminal_width()) {}

Progress::Progress(ProgressMode mode, std::ostream& out, Clock clock, int width)
    : mode_(mode), out_(out), clock_(std::move(clock)), width_(width) {}

// What follows, an error message perhaps, begins on a line of its own.
Progress::~Progress() {
  if (drawn_) out_ << '\n' << std::flush;
}

void Progress::start(const std::string& stage, const std::string& text) {
  stage_ = stage;
  started_ = seen_ = shown_ = clock_();
  fraction_ = rate_ = 0;
  if (mode_ == ProgressMode::json) tell_start(text);
  if (mode_ == ProgressMode::lines) print(fmt::format("{}: {}", stage_, text));
  if (mode_ == ProgressMode::terminal) draw(text);
}

void Progress::update(double fraction, const std::string& text) {
  if (mode_ == ProgressMode::quiet) return;
  const double now = clock_();
  if (now > seen_) {
    // A moving average over the last fifth of the stage, but at least two seconds: steps grow cheaper or dearer as a run
    // goes on, so the mean since the start would mislead, and the last step alone would jump.
    const double rate = (fraction - fraction_) / (now - seen_);
    const double span = std::max(2.0, (now - started_) / 5);
    const double weight = fraction_ == 0 ? 1 : 1 - std::exp(-(now - seen_) / span);
    rate_ += weight * (rate - rate_);
    seen_ = now;
    fraction_ = fraction;
  }
  const double interval = mode_ == ProgressMode::terminal ? terminal_interval
                          : mode_ == ProgressMode::json   ? json_interval
                                                          : lines_interval;
  if (now - shown_ < interval) return;
  shown_ = now;
  mode_ == ProgressMode::json ? tell_update(text) : draw(text);
}

void Progress::finish(const std::string& text) {
  if (mode_ == ProgressMode::json) return tell_finish(text);
  const double seconds = clock_() - started_;
  const std::string taken = seconds < 10 ? fmt::format("{:.2f} s", seconds) : format_duration(seconds);
  print(fmt::format("{}: done in {}{}{}", stage_, taken, text.empty() ? "" : ", ", text));
}

void Progress::note(const std::string& text) {
  if (mode_ == ProgressMode::json) return print(line_of({{"event", "note"}, {"text", text}}));
  print(text);
}

void Progress::end(const Ending& ending) {
  if (mode_ == ProgressMode::json) {
    Json json{
        {"event", "end"}, {"status", ending.status}, {"exit_status", ending.exit_status}, {"directory", ending.directory}};
    if (!ending.reasons.empty()) json["reasons"] = ending.reasons;
    return print(line_of(json));
  }
  const char* no_colour = std::getenv("NO_COLOR");
  const bool colour = mode_ == ProgressMode::terminal && (no_colour == nullptr || *no_colour == '\0');
  const std::string status =
      colour ? fmt::format("\x1b[{}m{}\x1b[0m", ending.exit_status == 0 ? 32 : 31, ending.status) : ending.status;
  print(ending.directory.empty() ? status : fmt::format("{}: {}", status, ending.directory));
}

void Progress::tell_start(const std::string& text) {
  print(line_of({{"event", "start"}, {"stage", stage_}, {"text", text}}));
}

void Progress::tell_update(const std::string& text) {
  Json json{{"event", "progress"}, {"stage", stage_}, {"fraction", fraction_}, {"text", text}};
  if (rate_ > 0) json["seconds_left"] = std::max(0.0, 1 - fraction_) / rate_;
  print(line_of(json));
}

void Progress::tell_finish(const std::string& text) {
  print(line_of({{"event", "finish"}, {"stage", stage_}, {"seconds", clock_() - started_}, {"text", text}}));
}

std::string Progress::time_left() const {
  if (!(rate_ > 0)) return "";
  return fmt::format(", {} left", format_duration(std::max(0.0, 1 - fraction_) / rate_));
}

void Progress::draw(const std::string& text) {
  const std::string line = fmt::format("{}: {:.0f} %{}, {}", stage_, std::floor(100 * fraction_), time_left(), text);
  if (mode_ == ProgressMode::lines) {
    print(line);
    return;
  }
  erase();
  // One column stays free, or some terminals would wrap.
  out_ << line.substr(0, static_cast<std::size_t>(std::max(1, width_ - 1))) << std::flush;
  drawn_ = true;
}

void Progress::print(const std::string& line) {
  if (mode_ == ProgressMode::quiet) return;
  erase();
  out_ << line << '\n' << std::flush;
}

void Progress::erase() {
  if (!drawn_) return;
  out_ << "\r\x1b[K";
  drawn_ = false;
}

}  // namespace scree
