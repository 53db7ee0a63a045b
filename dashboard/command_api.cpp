#include "dashboard/command_api.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/enums.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/excitation_request.hpp"
#include "dashboard/request_fields.hpp"

namespace levitas::dashboard {
namespace {

using nlohmann::json;

// Wider than any rig: what is too fast for this one is the controller's to refuse.
constexpr double kMostRpm = 1e7;
constexpr double kMostRpmPerS = 1e9;

bool IsGivenByName(OperatorCommand command) {
  return command != OperatorCommand::kNone && command != OperatorCommand::kExcite;
}

CommandRequest Understand(const std::string& body) {
  const json request = ParseRequest(body);
  RefuseUnknownKeys(request, {"command", "speed_rpm", "acceleration_rpm_per_s"});
  const std::string name = TextIn(request, "command");
  CommandRequest understood;
  std::string names;
  for (std::uint8_t i = 1; i < kOperatorCommandCount; ++i) {
    const auto command = static_cast<OperatorCommand>(i);
    if (!IsGivenByName(command)) continue;
    if (Name(command) == name) understood.command = command;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", Name(command));
  }
  if (understood.command == OperatorCommand::kNone) {
    throw std::invalid_argument(fmt::format("no command '{}'; there are {}", name, names));
  }
  if (understood.command == OperatorCommand::kSpin) {
    understood.speed_rad_per_s = RpmToRadPerS(NumberIn(request, "speed_rpm", -kMostRpm, kMostRpm));
    understood.acceleration_rad_per_s2 =
        RpmToRadPerS(NumberIn(request, "acceleration_rpm_per_s", -kMostRpmPerS, kMostRpmPerS));
  }
  return understood;
}

HttpAnswer NotUnderstood(const std::exception& problem) {
  return Answer(kHttpBadRequest, "not understood", problem.what());
}

/// JSON is YAML: a key a line, so that a problem's line tells which one.
std::string StepYaml(const json& request) {
  std::string yaml = "kind: excitation\n";
  for (const auto& [key, value] : request.items()) yaml += key + ": " + value.dump() + '\n';
  return yaml;
}

}  // namespace

HttpAnswer Told(const CommandReply& reply) {
  switch (reply.outcome) {
    case CommandOutcome::kAccepted:
      return Answer(kHttpOk, "accepted", reply.text);
    case CommandOutcome::kRefused:
      return Answer(kHttpConflict, "refused", reply.text);
    case CommandOutcome::kUnanswered:
      break;
  }
  return Answer(kHttpGatewayTimeout, "unanswered", reply.text);
}

bool AsksForStop(const std::string& body) {
  try {
    return Understand(body).command == OperatorCommand::kEmergencyStop;
  } catch (const std::exception&) {
    return false;  // AnswerCommand says what is wrong with it
  }
}

HttpAnswer AnswerCommand(const std::string& body, const SendCommand& send) {
  CommandRequest request;
  try {
    request = Understand(body);
  } catch (const std::exception& problem) {
    return NotUnderstood(problem);
  }
  return Told(send(request));
}

HttpAnswer AnswerExcitation(const std::string& body, const std::optional<RigNumbers>& rig,
                            const SendExcitation& send) {
  std::string yaml;
  try {
    const json request = ParseRequest(body);
    RefuseUnknownKeys(request, {"hold_s", "orbit_limit_um", "excitation"});
    if (!rig) return Answer(kHttpConflict, "refused", "no controller was heard yet");
    yaml = StepYaml(request);
    (void)configuration::ParseExcitation(yaml, "request", *rig);
  } catch (const std::exception& problem) {
    return NotUnderstood(problem);
  }
  return Told(send(yaml));
}

}  // namespace levitas::dashboard
