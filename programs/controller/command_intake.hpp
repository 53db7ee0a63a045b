#pragma once
// What the network's operators ask for on its way to the arbiter: the stop on a latch of its own,
// commands through the inbox, test signals through the intake.
//
// Thread   the handlers': the receiver's, which nothing here holds up. Arbiter: for the loop.
// Failure  what finds no room is not taken, and said at most once in kSayEvery.

#include <chrono>
#include <functional>
#include <string>

#include "common/rig_numbers.hpp"
#include "common/stop_latch.hpp"
#include "programs/controller/command_inbox.hpp"
#include "programs/controller/excitation_intake.hpp"
#include "transport/operator_receiver.hpp"

namespace levitas::controller_program {

class CommandIntake {
 public:
  static constexpr std::chrono::seconds kSayEvery{1};

  /// Keeps a reference to `rig`. `warn` is called in the receiver's thread, `refused` in that of
  /// the test signals.
  CommandIntake(const RigNumbers& rig, std::function<void(const std::string&)> warn,
                ExcitationIntake::Refused refused)
      : warn_(std::move(warn)), excitations_(rig, inbox_, stops_, std::move(refused)) {}

  [[nodiscard]] transport::OperatorHandlers Handlers(std::function<void()> enter_stop_thread);
  [[nodiscard]] StopLatch& stops() noexcept { return stops_; }
  [[nodiscard]] SpscRing<loop::RemoteCommand>& commands() noexcept { return inbox_.ring(); }

 private:
  bool Take(const transport::NetworkCommand& command);
  void Dropped();

  std::function<void(const std::string&)> warn_;
  StopLatch stops_;
  CommandInbox inbox_;
  ExcitationIntake excitations_;
  std::uint64_t dropped_{0};
  std::chrono::steady_clock::time_point said_{};
};

}  // namespace levitas::controller_program
