#pragma once
// Threads of their own for one kind of request, so that no other kind can hold them.
//
// Bounds    `most_waiting` requests wait for a thread; Put refuses the next.
// Thread    Put from any; `serve` is called in the lane's threads.
// Ends      with the requests that are being served; those that wait are closed unanswered.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "common/file_descriptor.hpp"
#include "dashboard/request_reader.hpp"

namespace levitas::dashboard {

struct Asked {
  FileDescriptor connection;
  RequestReader request;  ///< whole
};

class Lane {
 public:
  using Serve = std::function<void(Asked asked)>;

  Lane(std::size_t threads, std::size_t most_waiting, Serve serve);
  ~Lane();
  Lane(const Lane&) = delete;
  Lane& operator=(const Lane&) = delete;

  /// False, and `asked` as it was, when too many wait already.
  [[nodiscard]] bool Put(Asked& asked);

 private:
  void Run();

  const std::size_t most_waiting_;
  const Serve serve_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Asked> waiting_;
  bool ending_{false};
  std::vector<std::thread> threads_;
};

}  // namespace levitas::dashboard
