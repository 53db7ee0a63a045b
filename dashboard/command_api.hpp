#pragma once
// What the page asks of the controller, as JSON, checked before it becomes a message.
//
//   POST /api/command     {"command": "spin", "speed_rpm": 3000, "acceleration_rpm_per_s": 300}
//   POST /api/excitation  {"hold_s": 5, "orbit_limit_um": 75, "excitation": [{"channel": "de_x",
//                          "signal": "chirp", "amplitude_a": 0.2, "from_hz": 10, "to_hz": 400,
//                          "repeat_s": 2}]}: keys, units and ranges of a scenario's step
//                          (configuration/excitation_request.hpp)
//
// Answer   200 the controller accepted it, 409 it refused, 504 it did not answer, 400 the request
//          cannot be understood. {"outcome": "accepted", "text": "command lift (cycle 4711)"}
// Thread   any.

#include <functional>
#include <optional>
#include <string>

#include "common/rig_numbers.hpp"
#include "dashboard/commander.hpp"
#include "dashboard/http_answer.hpp"

namespace levitas::dashboard {

using SendCommand = std::function<CommandReply(const CommandRequest&)>;
using SendExcitation = std::function<CommandReply(const std::string& step_yaml)>;

[[nodiscard]] HttpAnswer AnswerCommand(const std::string& body, const SendCommand& send);

/// Whether a body of /api/command asks for an emergency stop, however it is written.
[[nodiscard]] bool AsksForStop(const std::string& body);
/// What became of a command, for the page.
[[nodiscard]] HttpAnswer Told(const CommandReply& reply);

/// `rig`: of the run; without one nothing can be checked, and nothing is sent.
[[nodiscard]] HttpAnswer AnswerExcitation(const std::string& body,
                                          const std::optional<RigNumbers>& rig,
                                          const SendExcitation& send);

}  // namespace levitas::dashboard
