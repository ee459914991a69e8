// How far a run has come, for whoever waits for it.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace scree {

enum class ProgressMode {
  terminal,  // one line that renews itself
  lines,     // for a log: a line at the start and end of a stage and every ten seconds between
  quiet,     // nothing
};

// `quiet` if asked for, `terminal` if standard error is one that can erase a line, else `lines`.
ProgressMode progress_mode(bool quiet);

// "8 s", "3 min 20 s", "2 h 05 min".
std::string format_duration(double seconds);

// One stage at a time: start, any number of updates, finish. A stage left by an exception is simply not finished.
class Progress {
 public:
  using Clock = std::function<double()>;  // [s]

  // Writes to standard error.
  explicit Progress(ProgressMode mode);
  Progress(ProgressMode mode, std::ostream& out, Clock clock, int width);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  void start(const std::string& stage, const std::string& text);
  // `fraction` of the stage that is done, 0 to 1. Cheap enough for every step: most calls draw nothing.
  void update(double fraction, const std::string& text);
  void finish(const std::string& text);
  // A remark that stays, within a stage or between two.
  void note(const std::string& text);

 private:
  void draw(const std::string& text);
  void print(const std::string& line);
  void erase();
  [[nodiscard]] std::string time_left() const;

  ProgressMode mode_;
  std::ostream& out_;
  Clock clock_;
  int width_;           // columns of the terminal
  bool drawn_ = false;  // there is an unfinished line on the terminal
  std::string stage_;
  double started_ = 0;  // [s]
  double seen_ = 0;     // last update [s]
  double shown_ = 0;    // last drawing [s]
  double fraction_ = 0;
  double rate_ = 0;  // smoothed [1/s]
};

}  // namespace scree
