#pragma once
// POST /api/command: what the page asks for, as JSON, checked before it becomes a command.
//
//   {"command": "spin", "speed_rpm": 3000, "acceleration_rpm_per_s": 300}
//
// Answer   200 the controller accepted it, 409 it refused, 504 it did not answer, 400 the request
//          cannot be understood. {"outcome": "accepted", "text": "command lift (cycle 4711)"}
// Thread   any.

#include <functional>
#include <string>

#include "dashboard/commander.hpp"

namespace levitas::dashboard {

struct HttpAnswer {
  int status{};
  std::string json;
};

using SendCommand = std::function<CommandReply(const CommandRequest&)>;

[[nodiscard]] HttpAnswer AnswerCommand(const std::string& body, const SendCommand& send);

}  // namespace levitas::dashboard
