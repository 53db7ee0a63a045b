#include "dashboard/lane.hpp"

#include <utility>

namespace levitas::dashboard {

Lane::Lane(std::size_t threads, std::size_t most_waiting, Serve serve)
    : most_waiting_(most_waiting), serve_(std::move(serve)) {
  threads_.reserve(threads);
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { Run(); });
}

Lane::~Lane() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    waiting_.clear();
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

bool Lane::Put(Asked& asked) {
  {
    const std::lock_guard lock(mutex_);
    if (ending_ || waiting_.size() >= most_waiting_) return false;
    waiting_.push_back(std::move(asked));
  }
  changed_.notify_one();
  return true;
}

void Lane::Run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) return;
    Asked asked = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    serve_(std::move(asked));
    lock.lock();
  }
}

}  // namespace levitas::dashboard
