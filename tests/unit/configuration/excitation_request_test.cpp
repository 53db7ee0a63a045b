#include "configuration/excitation_request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "controller/scenario/excitation_guard.hpp"
#include "controller/scenario/scenario_player.hpp"

namespace levitas::configuration {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RigNumbers Rig() { return LoadRig(FindConfig("flexible_rotor", "rigs")).numbers; }

std::string Problems(const std::string& text) {
  try {
    (void)ParseExcitation(text, "request", Rig());
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return {};
}

std::string Multisine(const std::string& to_hz, const std::string& repeat_s) {
  return "kind: excitation\nhold_s: 1\nexcitation:\n  - {channel: de_x, signal: multisine, "
         "amplitude_a: 0.1, from_hz: 1, to_hz: " +
         to_hz + ", repeat_s: " + repeat_s + "}\n";
}

TEST(ExcitationRequest, ReadsAStepThatOnlyExcites) {
  const scenario::Step step = ParseExcitation(Multisine("500", "1"), "request", Rig());
  EXPECT_EQ(step.command, OperatorCommand::kNone);
  EXPECT_EQ(step.wait, scenario::Wait::kNothing);
  EXPECT_EQ(step.hold_s, 1.0);
  ASSERT_EQ(step.excitation.size(), 1U);
  EXPECT_EQ(step.excitation[0].kind, scenario::SignalKind::kMultisine);
}

TEST(ExcitationRequest, ReadsTheJsonOfAPageAsWell) {
  const scenario::Step step = ParseExcitation(
      "kind: excitation\nhold_s: 2.0\nexcitation: [{\"amplitude_a\":0.1,\"channel\":\"nde_y\","
      "\"signal\":\"prbs\",\"order\":7}]\n",
      "request", Rig());
  EXPECT_EQ(step.excitation.at(0).axis, 3U);
  EXPECT_EQ(step.excitation.at(0).order, 7);
}

TEST(ExcitationRequest, CutsTheSignalBackAtZoneAUnlessToldOtherwise) {
  const RigNumbers rig = Rig();
  const scenario::Step step = ParseExcitation(Multisine("500", "1"), "request", rig);
  EXPECT_DOUBLE_EQ(step.orbit_limit_m, 0.3 * rig.clearance_m);  // ISO 14839-2
}

TEST(ExcitationRequest, MayNeitherCommandNorWait) {
  EXPECT_THAT(Problems("do: lift\n" + Multisine("500", "1")), HasSubstr("do"));
  EXPECT_THAT(Problems("until: tripped\n" + Multisine("500", "1")), HasSubstr("until"));
}

TEST(ExcitationRequest, EndsWithinAnHourAndIsNotEmpty) {
  EXPECT_THAT(Problems("kind: excitation\nhold_s: 1e5\nexcitation: []\n"), HasSubstr("3600"));
  EXPECT_THAT(Problems("kind: excitation\nhold_s: 1\n"), HasSubstr("no test signal"));
}

TEST(ExcitationRequest, IsNoMultisineThatWouldTakeTheControllerLongToMake) {
  // Lines times samples of a period of this rig at 10 kHz: 499 x 1e4 passes, 4.99e5 x 1e7 does not.
  EXPECT_EQ(Problems(Multisine("500", "1")), "");
  EXPECT_THAT(Problems(Multisine("500", "1000")), HasSubstr("shorter repeat_s"));
}

// The work of a request is bounded, not that of a signal: what one multisine may take, two may not.
TEST(ExcitationRequest, CountsTheWorkOfAllItsSignalsTogether) {
  const auto many = [](int count, const std::string& to_hz) {
    std::string text = "kind: excitation\nhold_s: 1\nexcitation:\n";
    for (int i = 0; i < count; ++i) {
      text +=
          "  - {channel: de_x, signal: multisine, amplitude_a: 0.01, from_hz: 10, to_hz: " + to_hz +
          ", repeat_s: 1.5}\n";
    }
    return text;
  };
  // 1.5e4 samples: 2190 Hz are 3285 lines, 4.9e7 in all.
  EXPECT_EQ(Problems(many(1, "2200")), "");
  EXPECT_THAT(Problems(many(2, "2200")), HasSubstr("fewer multisines"));
  EXPECT_THAT(Problems(many(8, "2200")), HasSubstr("3.97e+08"));  // 8 x 1.5e4 x (3285 + 20)
  EXPECT_EQ(Problems(many(8, "250")), "");
}

TEST(ExcitationRequest, IsNoLongTableOfFewLinesEither) {
  // One line, but 1e7 samples, each with its two cosines.
  EXPECT_THAT(Problems("kind: excitation\nhold_s: 1\nexcitation:\n  - {channel: de_x, signal: "
                       "multisine, amplitude_a: 0.1, from_hz: 1, to_hz: 1.001, repeat_s: 1000}\n"),
              HasSubstr("shorter repeat_s"));
}

TEST(ExcitationRequest, HasNoMoreSignalsThanTheLimit) {
  std::string text = "kind: excitation\nhold_s: 1\nexcitation:\n";
  for (std::size_t i = 0; i <= kMostSignals; ++i) {
    text += "  - {channel: de_x, signal: prbs, amplitude_a: 0.01}\n";
  }
  EXPECT_THAT(Problems(text), HasSubstr("9 signals"));
}

TEST(ExcitationRequest, OfAnotherKindOfFileIsRefused) {
  EXPECT_THAT(Problems("kind: scenario\n"), HasSubstr("excitation"));
  EXPECT_NE(Problems(""), "");
  EXPECT_NE(Problems("\t\x01: ["), "");
}

std::string Prbs(const std::vector<std::string>& channels_and_starts) {
  std::string text = "kind: excitation\nhold_s: 1\nexcitation:\n";
  for (const std::string& which : channels_and_starts) {
    text += "  - {channel: " + which + ", amplitude_a: 1, order: 9}\n";
  }
  return text;
}

/// The largest sum of a bearing that reaches the coils within a second, as a share of what its law
/// has left: what is asked for, or, with the guard, what it lets through.
double LargestSum(const scenario::Step& step, bool guarded) {
  const RigNumbers rig = Rig();
  scenario::ScenarioPlayer player({"test", {step}, {}}, rig.period_s(), 0.5);
  scenario::ExcitationGuard guard(scenario::LimitsOf(rig, rig.bias_current_a));
  double largest = 0.0;
  for (int cycle = 0; cycle < 5000; ++cycle) {
    auto given = player.Next(Mode::kLevitating, 0.0, Fault::kNone, false, 0.0, true);
    if (guarded) guard.Limit({}, given.excitation_a, given.excitation_m);
    for (std::size_t x = 0; x < rig.axes(); x += 2) {
      largest = std::max(largest, std::hypot(given.excitation_a[x], given.excitation_a[x + 1]));
    }
  }
  return largest / rig.bias_current_a;
}

TEST(ExcitationRequest, OnAllAxesIsWhatOneSignalPerAxisWouldBe) {
  const scenario::Step all = ParseExcitation(Prbs({"all"}), "request", Rig());
  const scenario::Step each = ParseExcitation(
      Prbs({"de_x", "de_y, start: 0.25", "nde_x, start: 0.5", "nde_y, start: 0.75"}), "request",
      Rig());
  ASSERT_EQ(all.excitation.size(), 4U);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_EQ(all.excitation[axis].channel, Rig().channels[axis]);
    EXPECT_EQ(all.excitation[axis].axis, axis);
    EXPECT_EQ(all.excitation[axis].start, each.excitation[axis].start);
    EXPECT_EQ(all.excitation[axis].order, each.excitation[axis].order);
  }
  EXPECT_EQ(all.orbit_limit_m, each.orbit_limit_m);
}

// 1 A of 1 A on both axes of a bearing: sqrt(2) of what there is, of which the guard leaves 60 %.
TEST(ExcitationRequest, OnAllAxesIsHeldToTheSumThatSeveralSignalsAreHeldTo) {
  const scenario::Step all = ParseExcitation(Prbs({"all"}), "request", Rig());
  EXPECT_NEAR(LargestSum(all, false), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(LargestSum(all, true), 0.6, 1e-12);
}

TEST(ExcitationRequest, OnAllAxesCountsAsAsManySignals) {
  EXPECT_EQ(Problems(Prbs({"all", "all"})), "");
  EXPECT_THAT(Problems(Prbs({"all", "all", "all"})), HasSubstr("12 signals"));
}

TEST(ExcitationRequest, NamesTheAxesAndTheWordForAllWhereItKnowsNeither) {
  EXPECT_THAT(Problems(Prbs({"every"})), AllOf(HasSubstr("de_x"), HasSubstr("all")));
}

}  // namespace
}  // namespace levitas::configuration
