// How far a run has come, for whoever waits for it.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace scree {

enum class ProgressMode {
  terminal,  // one line that renews itself
  lines,     // for a log: a line at the start and end of a stage and every ten seconds between
  quiet,     // nothing
  json,      // for a program: one JSON object a line, an update each second
};

// `quiet` if asked for, `terminal` if standard error is one that can erase a line, else `lines`.
ProgressMode progress_mode(bool quiet);

// "8 s", "3 min 20 s", "2 h 05 min".
std::string format_duration(double seconds);

struct Ending {
  std::string status;
  int exit_status = 0;
  std::string directory;
  std::vector<std::string> reasons;  // why the exit status is not 0; only JSON tells them
};

// One stage at a time: start, any number of updates, finish. A stage left by an exception is simply not finished.
class Progress {
 public:
  using Clock = std::function<double()>;  // [s]

  // Writes to standard error, JSON to standard output.
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
  // How the run ended, after its last stage; on a terminal the status is green or red unless NO_COLOR is set and not empty.
  void end(const Ending& ending);

 private:
  void draw(const std::string& text);
  // In JSON: `event` and what it is about.
  void tell_start(const std::string& text);
  void tell_update(const std::string& text);
  void tell_finish(const std::string& text);
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
