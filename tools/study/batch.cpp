#include "tools/study/batch.h"

#include <fmt/format.h>

#include "engine/base/check.h"

namespace scree::study {

namespace {

namespace fs = std::filesystem;

// For a POSIX shell.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) {
    if (c == '\'') safe += "'\\'";
    safe += c;
  }
  safe += '\'';
  return safe;
}

// A file's name between double quotes in a line of #SBATCH, which sbatch reads by rules of its own. A percent sign is doubled
// where it stands for itself.
std::string in_sbatch(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '%') safe += '%';
    if (c == '"') safe += '\\';
    safe += c;
  }
  return safe;
}

std::string command_of(const Batch& batch, const std::string& what) {
  const std::string program = fs::read_symlink("/proc/self/exe").string();
  return fmt::format("{} study {} --out {} {}", quoted(program), quoted(fs::absolute(batch.study).string()),
                     quoted(fs::absolute(batch.directory).string()), what);
}

void refuse(const std::string& option, const std::string& value, const std::string& rule) {
  Problem problem;
  problem.key = option;
  problem.value = value;
  problem.rule = rule;
  problem.suggestion = "Rename the folder or the file";
  throw InputError(problem);
}

// GNU parallel puts a task's number wherever a replacement string such as {} or {.} stands, quoted or not.
void refuse_braces(const std::string& command) {
  if (command.find('{') == std::string::npos) return;
  refuse("--parallel", command, "must name no file with { in it, for GNU parallel replaces what stands in braces");
}

// A name with a backslash has no pattern such as %a for sbatch, and a comment ends with its line.
void refuse_backslashes(const std::string& command) {
  if (command.find_first_of("\\\n") == std::string::npos) return;
  refuse("--slurm", command, "must name no file with a backslash or a line break in it, which sbatch takes for its own");
}

}  // namespace

std::string slurm_script(const Batch& batch) {
  // Of the names alone: what quotes a quote has a backslash, too.
  for (const fs::path& name : {batch.study, batch.directory}) refuse_backslashes(fs::absolute(name).string());
  const std::string log = fmt::format("\"{}/slurm-%a.log\"", in_sbatch(fs::absolute(batch.directory).string()));
  return fmt::format(
      "#!/bin/sh\n"
      "# Runs {count} runs of a study as a job array. Submit it with its limits, and gather the results when it has ended:\n"
      "#   job=$(sbatch --parsable --time=02:00:00 --mem=4G FILE)\n"
      "#   sbatch --dependency=afterany:$job --wrap {gather}\n"
      "#SBATCH --job-name=scree-study\n"
      "#SBATCH --array=1-{count}\n"
      "#SBATCH --cpus-per-task={threads}\n"
      "#SBATCH --output={log}\n"
      "exec {task}\n",
      fmt::arg("count", batch.tasks), fmt::arg("gather", quoted(command_of(batch, "--gather"))),
      fmt::arg("threads", batch.threads.value_or(1)), fmt::arg("log", log),
      fmt::arg("task", command_of(batch, fmt::format("--quiet --task \"$SLURM_ARRAY_TASK_ID\" --threads {}",
                                                     batch.threads.value_or(1)))));
}

std::string parallel_script(const Batch& batch) {
  const int threads = batch.threads.value_or(1);
  refuse_braces(command_of(batch, ""));
  return fmt::format(
      "#!/bin/sh\n"
      "# Runs {} runs of a study by GNU parallel, one on a processor unless its options say otherwise, and gathers the "
      "results.\n"
      "seq {} | parallel \"$@\" {}\n"
      "{}\n",
      batch.tasks, batch.tasks, quoted(command_of(batch, fmt::format("--quiet --threads {} --task {{}}", threads))),
      command_of(batch, "--gather"));
}

}  // namespace scree::study
