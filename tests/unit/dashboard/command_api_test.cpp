#include "dashboard/command_api.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "configuration/excitation_request.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::dashboard {
namespace {

using testing::HasSubstr;

RigNumbers ShippedRig() {
  return configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs")).numbers;
}

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
  const auto json = nlohmann::json::parse(answer.body);
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
  EXPECT_EQ(nlohmann::json::parse(answer.body)["outcome"], "unanswered");
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
  EXPECT_THAT(controller.Post(R"({"command":"fly"})").body, HasSubstr("emergency_stop"));
}

constexpr const char* kChirp =
    R"({"hold_s":5,"orbit_limit_um":75,"excitation":[{"channel":"de_x","signal":"chirp",)"
    R"("amplitude_a":0.2,"from_hz":10,"to_hz":400,"repeat_s":2}]})";

TEST(ExcitationApi, SendsATextThatTheControllerReadsAsWhatWasAskedFor) {
  const RigNumbers rig = ShippedRig();
  std::string sent;
  const HttpAnswer answer = AnswerExcitation(kChirp, rig, [&](const std::string& step_yaml) {
    sent = step_yaml;
    return CommandReply{CommandOutcome::kAccepted, "command excite (cycle 9)"};
  });
  EXPECT_EQ(answer.status, 200);
  const scenario::Step step = configuration::ParseExcitation(sent, "test", rig);
  EXPECT_EQ(step.hold_s, 5.0);
  EXPECT_DOUBLE_EQ(step.orbit_limit_m, 75e-6);
  ASSERT_EQ(step.excitation.size(), 1U);
  EXPECT_EQ(step.excitation[0].kind, scenario::SignalKind::kChirp);
  EXPECT_EQ(step.excitation[0].axis, 0U);
  EXPECT_EQ(step.excitation[0].amplitude_a, 0.2);
  EXPECT_EQ(step.excitation[0].to_hz, 400.0);
}

TEST(ExcitationApi, SendsNothingThatTheRigCannotDo) {
  int sent = 0;
  const auto post = [&](const std::string& body) {
    return AnswerExcitation(body, ShippedRig(), [&](const std::string&) {
      ++sent;
      return CommandReply{};
    });
  };
  for (const auto& [find, instead, words] : {std::tuple{"\"de_x\"", "\"top\"", "channel"},
                                             {"0.2", "50", "amplitude_a"},
                                             {"0.2", "-1", "amplitude_a"},
                                             {"0.2", "\"much\"", "amplitude_a"},
                                             {"400", "1e5", "to_hz"},
                                             {"\"chirp\"", "\"noise\"", "signal"},
                                             {"\"hold_s\":5", "\"hold_s\":0", "hold_s"},
                                             {"\"hold_s\":5", "\"hold_s\":1e5", "hold_s"},
                                             {"75", "5000", "orbit_limit_um"},
                                             {"\"hold_s\"", "\"do\"", "'do' is not known"},
                                             {"repeat_s", "repeat_m", "repeat_m"}}) {
    std::string body = kChirp;
    body.replace(body.find(find), std::string(find).size(), instead);
    const HttpAnswer answer = post(body);
    EXPECT_EQ(answer.status, 400) << body;
    EXPECT_THAT(answer.body, HasSubstr(words)) << body;
  }
  for (const char* bad : {"", "[]", "{}", R"({"hold_s":1,"excitation":[]})",
                          R"({"hold_s":1,"excitation":"all"})", R"({"excitation":[[[[[[]]]]]]})"}) {
    EXPECT_EQ(post(bad).status, 400) << bad;
  }
  EXPECT_EQ(sent, 0);
}

TEST(ExcitationApi, RefusesWhileNoRigIsKnown) {
  EXPECT_EQ(AnswerExcitation(kChirp, std::nullopt, {}).status, 409);
}

TEST(ExcitationApi, CannotBeHadAsAPlainCommandWithoutASignal) {
  Controller controller;
  EXPECT_EQ(controller.Post(R"({"command":"excite"})").status, 400);
  EXPECT_EQ(controller.Post(R"({"command":"end_excitation"})").status, 200);
}

}  // namespace
}  // namespace levitas::dashboard
