#include "programs/controller/command_intake.hpp"

#include <fmt/core.h>

namespace levitas::controller_program {

transport::OperatorHandlers CommandIntake::Handlers(std::function<void()> enter_stop_thread) {
  return {.take = [this](const auto& command) { return Take(command); },
          .excite = [this](const auto& request) { return excitations_.Take(request); },
          .dropped = [this] { Dropped(); },
          .enter_stop_thread = std::move(enter_stop_thread)};
}

bool CommandIntake::Take(const transport::NetworkCommand& command) {
  if (command.command == OperatorCommand::kEndExcitation) excitations_.EndWaiting();
  return inbox_.Post({.command = command.command,
                      .speed_rad_per_s = command.speed_rad_per_s,
                      .acceleration_rad_per_s2 = command.acceleration_rad_per_s2,
                      .origin = command.origin,
                      .stops_before = command.stops_before});
}

void CommandIntake::Dropped() {
  ++dropped_;
  const auto now = std::chrono::steady_clock::now();
  if (now - said_ < kSayEvery) return;
  said_ = now;
  warn_(
      fmt::format("requests come faster than they are served: {} found no room so far", dropped_));
}

}  // namespace levitas::controller_program
