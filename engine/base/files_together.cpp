#include "engine/base/files_together.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/base/file_naming.h"
#include "engine/base/file_parts.h"

namespace scree {

namespace {

thread_local FilesTogether* together = nullptr;

}  // namespace

FilesTogether* FilesTogether::of_this_thread() {
  return together;
}

FilesTogether::Scope::Scope(FilesTogether& files) : outer_(std::exchange(together, &files)) {}

FilesTogether::Scope::~Scope() {
  together = outer_;
}

FilesTogether::~FilesTogether() {
  try {
    publish();
  } catch (...) {
  }
}

void FilesTogether::keep_earlier(const std::filesystem::path& file) {
  for (Waiting& each : waiting_) {
    if (each.file == file) std::filesystem::rename(std::exchange(each.temporary, earlier_of(file)), earlier_of(file));
  }
}

void FilesTogether::add(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  const auto replaced = std::erase_if(waiting_, [&](const Waiting& earlier) { return earlier.file == file; });
  std::error_code ignored;
  if (replaced > 0) std::filesystem::remove(earlier_of(file), ignored);
  waiting_.push_back({temporary, file});
  if (!since_) since_ = std::chrono::steady_clock::now();
  begin_to_flush(temporary);  // or the disk does nothing meanwhile
}

void FilesTogether::pass_on(FilesTogether& others) {
  if (since_ && !others.since_) others.since_ = since_;
  since_.reset();
  std::move(waiting_.begin(), waiting_.end(), std::back_inserter(others.waiting_));
  waiting_.clear();
}

void FilesTogether::publish() {
  const std::vector<Waiting> files = std::exchange(waiting_, {});
  since_.reset();
  try {
    for (const Waiting& each : files) flush(each.temporary, each.file);
    for (const Waiting& each : files) name_written(each.temporary, each.file);
  } catch (...) {
    std::error_code ignored;
    for (const Waiting& each : files) std::filesystem::remove(each.temporary, ignored);
    throw;
  }
}

}  // namespace scree
