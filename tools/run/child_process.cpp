#include "tools/run/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::run {

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log)
    : start_(std::chrono::steady_clock::now()) {
  std::vector<std::string> words{"scree"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  const int failure = posix_spawn(&process_, "/proc/self/exe", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw RunError(fmt::format("scree could not start itself: {}", std::strerror(failure)));
}

std::optional<ChildEnd> ChildProcess::collect(int options) {
  int status = 0;
  rusage usage{};
  pid_t ended = 0;
  while ((ended = wait4(process_, &status, options, &usage)) < 0) {
    if (errno != EINTR) throw RunError(fmt::format("lost the run that was started: {}", std::strerror(errno)));
  }
  if (ended == 0) return std::nullopt;
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ChildEnd{code, wall.count(), static_cast<std::int64_t>(usage.ru_maxrss) * 1024};
}

std::optional<ChildEnd> ChildProcess::poll() {
  return collect(WNOHANG);
}

ChildEnd ChildProcess::wait() {
  return *collect(0);
}

void ChildProcess::interrupt() const {
  ::kill(process_, SIGTERM);
}

}  // namespace scree::run
