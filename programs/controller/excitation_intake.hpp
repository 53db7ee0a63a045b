#pragma once
// Makes the test signals that are asked for over the network, in a thread of its own, and hands
// them to the command arbiter. The cost of one signal is bounded by
// configuration/excitation_request.hpp, the number of waiting signals by kWaiting, and nobody waits
// for either.
//
// Order    one after the other. One that waits when an emergency stop or the command to end the
//          test signal comes is not begun any more.
// Thread   Take and EndWaiting: any but the loop's; they lock for the length of a copy. The arbiter
//          plays what lies on the shelf.
// Failure  a request that cannot be met is told, and nothing else happens. Take returns false when
//          kWaiting wait already.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "common/rig_numbers.hpp"
#include "common/stop_latch.hpp"
#include "controller/loop/excitation_pool.hpp"
#include "programs/controller/command_inbox.hpp"
#include "transport/operator_message.hpp"

namespace levitas::controller_program {

class ExcitationIntake {
 public:
  static constexpr std::size_t kWaiting = 4;
  using Refused = std::function<void(const std::string& why, const CommandOrigin& origin)>;

  /// Keeps references to the first three. `refused` is called in the intake's thread.
  ExcitationIntake(const RigNumbers& rig, CommandInbox& inbox, const StopLatch& stops,
                   Refused refused);
  /// What waits is left.
  ~ExcitationIntake();
  ExcitationIntake(const ExcitationIntake&) = delete;
  ExcitationIntake& operator=(const ExcitationIntake&) = delete;

  /// False: no room.
  bool Take(const transport::NetworkExcitation& request);
  /// Whatever waits now is refused.
  void EndWaiting();

 private:
  void Run();
  [[nodiscard]] std::string Try(const transport::NetworkExcitation& request);
  [[nodiscard]] std::string HandOver(const transport::NetworkExcitation& request,
                                     loop::ExcitationPool::Slot* place);
  [[nodiscard]] bool Ended() noexcept;

  const RigNumbers& rig_;
  CommandInbox& inbox_;
  const StopLatch& stops_;
  Refused refused_;
  loop::ExcitationPool shelf_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<transport::NetworkExcitation> waiting_;
  std::size_t to_end_{0};  ///< how many of the first ones, the one at work included, are refused
  bool at_work_{false};
  bool closing_{false};
  std::thread thread_;
};

}  // namespace levitas::controller_program
