#pragma once
// Takes connections and reads their requests, all in one thread that never waits for a single one.
//
// A request reaches a thread that answers only when it is whole; until then it costs a place here.
// Places    kMostGuests; who comes when all are taken gets that of the longest idle connection (of
//           the oldest one when none is idle). One request for each connection.
// Deadlines kIdle until the first byte, then kHeadWithin for the headers' end and kWholeWithin for
//           the whole request (408).
// Leaving   what a client still sends after its answer is thrown away for kLeaveWithin and at most
//           kMostThrownAway bytes, so that the answer is not lost with a reset of the connection.
// Thread    its own, in which `enter` is called: it must not wait. SeeOut may be called from any.
// Failure   none: what is refused is told so (request_reader.hpp) and closed.

#include <sys/poll.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "common/file_descriptor.hpp"
#include "dashboard/lane.hpp"
#include "dashboard/request_reader.hpp"

namespace levitas::dashboard {

class FrontDoor {
 public:
  using Clock = std::chrono::steady_clock;
  /// False, and `asked` as it was, when there is no room (503).
  using Enter = std::function<bool(Asked& asked)>;

  static constexpr std::size_t kMostGuests = 128;
  static constexpr std::size_t kMostThrownAway = std::size_t{256} * 1024;
  static constexpr std::chrono::seconds kIdle{30};
  static constexpr std::chrono::seconds kHeadWithin{2};
  static constexpr std::chrono::seconds kWholeWithin{5};
  static constexpr std::chrono::seconds kLeaveWithin{2};

  /// `listening` stays the caller's and must outlive this.
  FrontDoor(int listening, Enter enter);
  ~FrontDoor();
  FrontDoor(const FrontDoor&) = delete;
  FrontDoor& operator=(const FrontDoor&) = delete;

  /// After an answer: closes when the client has read it, or soon.
  void SeeOut(FileDescriptor connection);
  /// No `enter` after this.
  void Close();

 private:
  struct Guest {
    FileDescriptor connection;
    Clock::time_point since;  ///< accepted; then the first byte; then leaving
    RequestReader request;
    bool leaving{false};
    std::size_t thrown_away{0};
    bool gone{false};
  };

  void Run();
  void WaitForNews();
  void TakeThoseServed(Clock::time_point now);
  void Accept(Clock::time_point now);
  /// Of `full` guests one has to go.
  void MakeRoom(std::size_t full);
  void Read(Guest& guest, Clock::time_point now);
  void ThrowAway(Guest& guest);
  void Refuse(Guest& guest, int status, const char* why, Clock::time_point now);
  void Expire(Guest& guest, Clock::time_point now);

  const int listening_;
  const Enter enter_;
  const FileDescriptor wake_;
  std::vector<Guest> guests_;
  std::vector<pollfd> polled_;
  std::mutex served_mutex_;
  std::vector<FileDescriptor> served_;
  std::atomic<bool> closing_{false};
  std::thread thread_;
};

}  // namespace levitas::dashboard
