#pragma once
// Connections whose emergency stop is sent and whose answer is still to come.
//
// Bounds    at most `most` wait; who is one too many is answered at once that the stop was sent.
// Sends     an answer of a few hundred bytes to a connection that was sent nothing yet: it fits
//           what the kernel holds, and is not waited for.
// Thread    Wait: the front door's. Its result: any, also after Close.
// Failure   none: a client that has gone is not told.

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>

#include "common/file_descriptor.hpp"
#include "dashboard/http_answer.hpp"

namespace levitas::dashboard {

class StopDesk {
 public:
  using SeeOut = std::function<void(FileDescriptor connection)>;

  StopDesk(std::size_t most, SeeOut see_out);

  /// Keeps the connection until the result is called, for the first time.
  [[nodiscard]] StopRoute::Done Wait(FileDescriptor connection);
  /// After this connections are closed with their answer, and not seen out.
  void Close();

 private:
  struct Shared {
    std::mutex mutex;
    SeeOut see_out;  ///< null: closed
    std::size_t waiting{0};
  };

  std::size_t most_;
  std::shared_ptr<Shared> shared_;
};

}  // namespace levitas::dashboard
