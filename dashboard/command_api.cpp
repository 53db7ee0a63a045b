#include "dashboard/command_api.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "common/enums.hpp"

namespace levitas::dashboard {
namespace {

using nlohmann::json;

constexpr double kRadPerSPerRpm = std::numbers::pi / 30.0;
constexpr int kOk = 200;
constexpr int kBadRequest = 400;
constexpr int kConflict = 409;
constexpr int kGatewayTimeout = 504;

double FiniteNumber(const json& request, const char* key) {
  if (!request.contains(key) || !request[key].is_number()) {
    throw std::invalid_argument(fmt::format("{} is missing or no number", key));
  }
  const double value = request[key].get<double>();
  if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("{} is not finite", key));
  return value;
}

CommandRequest Understand(const std::string& body) {
  const json request = json::parse(body);
  if (!request.is_object() || !request.contains("command") || !request["command"].is_string()) {
    throw std::invalid_argument("no \"command\"");
  }
  const auto& name = request["command"].get_ref<const std::string&>();
  CommandRequest understood;
  for (std::uint8_t i = 1; i < kOperatorCommandCount; ++i) {
    if (Name(static_cast<OperatorCommand>(i)) == name) {
      understood.command = static_cast<OperatorCommand>(i);
    }
  }
  if (understood.command == OperatorCommand::kNone) {
    throw std::invalid_argument(fmt::format(
        "no command '{}'; there are lift, spin, coast_down, land, emergency_stop, reset", name));
  }
  if (understood.command == OperatorCommand::kSpin) {
    understood.speed_rad_per_s = FiniteNumber(request, "speed_rpm") * kRadPerSPerRpm;
    understood.acceleration_rad_per_s2 =
        FiniteNumber(request, "acceleration_rpm_per_s") * kRadPerSPerRpm;
  }
  return understood;
}

}  // namespace

HttpAnswer AnswerCommand(const std::string& body, const SendCommand& send) {
  CommandRequest request;
  try {
    request = Understand(body);
  } catch (const std::exception& problem) {
    return {kBadRequest, json{{"outcome", "not understood"}, {"text", problem.what()}}.dump(
                             -1, ' ', false, json::error_handler_t::replace)};
  }
  const CommandReply reply = send(request);
  const auto answer = [&reply](int status, const char* outcome) -> HttpAnswer {
    return {status, json{{"outcome", outcome}, {"text", reply.text}}.dump()};
  };
  switch (reply.outcome) {
    case CommandOutcome::kAccepted:
      return answer(kOk, "accepted");
    case CommandOutcome::kRefused:
      return answer(kConflict, "refused");
    case CommandOutcome::kUnanswered:
      break;
  }
  return answer(kGatewayTimeout, "unanswered");
}

}  // namespace levitas::dashboard
