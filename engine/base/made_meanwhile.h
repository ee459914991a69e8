// What is wanted later is made on a thread of its own while the others go on; with one thread to work with, when it is wanted.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <utility>

#include "engine/base/threads.h"

namespace scree {

template <class Result>
class MadeMeanwhile {
 public:
  // Begins at once if there is a thread to spare. What `make` reads must not be written before it is done; the end of this
  // object waits for it.
  explicit MadeMeanwhile(std::function<Result()> make)
      : result_(std::async(threads_in_use() > 1 ? std::launch::async : std::launch::deferred, [make = std::move(make)] {
                  const ThreadsInScope one(1);
                  return make();
                }).share()) {}

  // That is made already.
  explicit MadeMeanwhile(Result made) {
    std::promise<Result> result;
    result.set_value(std::move(made));
    result_ = result.get_future().share();
  }

  // Whether a thread is at it.
  [[nodiscard]] bool under_way() const { return result_.wait_for(std::chrono::seconds(0)) == std::future_status::timeout; }

  // Waits for it. Throws what making it threw, every time.
  [[nodiscard]] const Result& get() const { return result_.get(); }

 private:
  std::shared_future<Result> result_;
};

}  // namespace scree
