#include "dashboard/command_api.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace levitas::dashboard {
namespace {

using testing::HasSubstr;

/// Answers as told, and remembers what was asked.
struct Controller {
  CommandReply reply{CommandOutcome::kAccepted, "command lift (cycle 7)"};
  int asked{0};
  CommandRequest request{};
  [[nodiscard]] HttpAnswer Post(const std::string& body) {
    return AnswerCommand(body, [this](const CommandRequest& given) {
      ++asked;
      request = given;
      return reply;
    });
  }
};

TEST(CommandApi, PassesOnWhatTheControllerSaid) {
  Controller controller;
  const HttpAnswer answer = controller.Post(R"({"command":"lift"})");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(controller.request.command, OperatorCommand::kLift);
  const auto json = nlohmann::json::parse(answer.json);
  EXPECT_EQ(json["outcome"], "accepted");
  EXPECT_EQ(json["text"], "command lift (cycle 7)");
}

TEST(CommandApi, NeverCallsARefusedOrUnansweredCommandDone) {
  Controller controller;
  controller.reply = {CommandOutcome::kRefused, "command land refused in mode off (cycle 3)"};
  EXPECT_EQ(controller.Post(R"({"command":"land"})").status, 409);
  controller.reply = {CommandOutcome::kUnanswered, "no answer"};
  const HttpAnswer answer = controller.Post(R"({"command":"emergency_stop"})");
  EXPECT_EQ(answer.status, 504);
  EXPECT_EQ(nlohmann::json::parse(answer.json)["outcome"], "unanswered");
}

TEST(CommandApi, TurnsRevolutionsPerMinuteIntoRadiansPerSecond) {
  Controller controller;
  EXPECT_EQ(
      controller.Post(R"({"command":"spin","speed_rpm":60,"acceleration_rpm_per_s":-30})").status,
      200);
  // One turn per second is 2 pi rad/s; both are one rounding away from exact.
  EXPECT_DOUBLE_EQ(controller.request.speed_rad_per_s, 2.0 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(controller.request.acceleration_rad_per_s2, -std::numbers::pi);
}

TEST(CommandApi, SendsNothingThatItDoesNotUnderstand) {
  Controller controller;
  for (const char* bad :
       {"", "lift", "[]", "{}", R"({"command":1})", R"({"command":"none"})", R"({"command":"fly"})",
        R"({"command":"spin"})", R"({"command":"spin","speed_rpm":"3000"})",
        R"({"command":"spin","speed_rpm":3000,"acceleration_rpm_per_s":null})",
        R"({"command":"spin","speed_rpm":1e999,"acceleration_rpm_per_s":1})",
        "{\"command\":\"\xff\"}"}) {
    EXPECT_EQ(controller.Post(bad).status, 400) << bad;
  }
  EXPECT_EQ(controller.asked, 0);
  EXPECT_THAT(controller.Post(R"({"command":"fly"})").json, HasSubstr("emergency_stop"));
}

}  // namespace
}  // namespace levitas::dashboard
