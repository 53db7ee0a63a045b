#include "dashboard/scope.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "batches.hpp"

namespace levitas::dashboard {
namespace {

constexpr std::int64_t kStepAt = 1000;  // cycle of the first sample beyond any level below

/// 0 before the step, 10 um from it on; y mirrored.
double Step(std::int64_t cycle, int axis) {
  const double height = cycle >= kStepAt ? 10e-6 : 0.0;
  return axis == 0 ? height : -height;
}

ScopeSettings RisingOnX(std::size_t samples, std::size_t before) {
  return {.source = ScopeSource::kPosition,
          .axis = 0,
          .level = 5e-6,
          .samples = samples,
          .before = before};
}

/// A scope on a store that is fed batch by batch, as the network does.
struct Bench {
  SampleStore store{SmallRig()};
  Scope scope;
  void Feed(std::int64_t from, std::int64_t to,
            const std::function<double(std::int64_t, int)>& position = Step) {
    constexpr std::int64_t kBatch = 128;
    for (std::int64_t first = from; first < to; first += kBatch) {
      const auto samples = static_cast<std::int32_t>(std::min(kBatch, to - first));
      ASSERT_TRUE(store.Add(Batch(first, samples, position)));
      scope.Advance(store);
    }
  }
  void Arm(const ScopeSettings& settings) {
    scope.Arm(settings);
    scope.Advance(store);
  }
};

TEST(Scope, KeepsWhatLayBeforeAndAfterTheTriggerAtFullRate) {
  Bench bench;
  bench.Arm(RisingOnX(300, 100));
  bench.Feed(0, 2000);
  ASSERT_EQ(bench.scope.state(), ScopeState::kCaptured);
  const Capture& capture = *bench.scope.newest();
  EXPECT_EQ(capture.trigger_cycle, static_cast<std::uint64_t>(kStepAt));
  ASSERT_EQ(capture.position_m.size(), 2U);
  ASSERT_EQ(capture.position_m[0].size(), 300U);
  for (std::size_t i = 0; i < 300; ++i) {
    const auto cycle = kStepAt - 100 + static_cast<std::int64_t>(i);
    ASSERT_EQ(capture.position_m[0][i], static_cast<float>(Step(cycle, 0))) << i;
    ASSERT_EQ(capture.position_m[1][i], static_cast<float>(Step(cycle, 1))) << i;
    ASSERT_EQ(capture.current_a[0][i], static_cast<float>(1000.0 * Step(cycle, 0))) << i;
  }
}

TEST(Scope, TriggersOnTheEdgeThatWasAskedForOnly) {
  for (const auto& [edge, axis, triggers] : {std::tuple{ScopeEdge::kRising, 0, true},
                                             {ScopeEdge::kFalling, 0, false},
                                             {ScopeEdge::kEither, 0, true},
                                             {ScopeEdge::kRising, 1, false},
                                             {ScopeEdge::kFalling, 1, true},
                                             {ScopeEdge::kEither, 1, true}}) {
    Bench bench;
    ScopeSettings settings = RisingOnX(100, 10);
    settings.edge = edge;
    settings.axis = static_cast<std::size_t>(axis);
    settings.level = axis == 0 ? 5e-6 : -5e-6;
    bench.Arm(settings);
    bench.Feed(0, 2000);
    EXPECT_EQ(bench.scope.state() == ScopeState::kCaptured, triggers)
        << static_cast<int>(edge) << " on axis " << axis;
  }
}

TEST(Scope, TriggersOnACurrent) {
  Bench bench;
  ScopeSettings settings = RisingOnX(100, 10);
  settings.source = ScopeSource::kCurrent;
  settings.level = 5e-3;  // batches carry a thousand amperes per metre
  bench.Arm(settings);
  bench.Feed(0, 2000);
  ASSERT_EQ(bench.scope.state(), ScopeState::kCaptured);
  EXPECT_EQ(bench.scope.newest()->trigger_cycle, static_cast<std::uint64_t>(kStepAt));
}

TEST(Scope, TriggersAtOnceWhenAskedTo) {
  Bench bench;
  bench.Feed(0, 512);
  bench.Arm({.source = ScopeSource::kNow, .samples = 50, .before = 20});
  bench.Feed(512, 1024);
  ASSERT_EQ(bench.scope.state(), ScopeState::kCaptured);
  EXPECT_EQ(bench.scope.newest()->trigger_cycle, 512U);
}

TEST(Scope, TriggersOnATripWhicheverArrivesFirstTheWordOrTheSamples) {
  for (const bool word_first : {true, false}) {
    Bench bench;
    bench.Feed(0, 512);
    bench.Arm({.source = ScopeSource::kTrip, .samples = 100, .before = 50});
    if (word_first) bench.scope.Tripped(600);
    bench.Feed(512, 1024);
    if (!word_first) bench.scope.Tripped(600);
    bench.Feed(1024, 1100);
    ASSERT_EQ(bench.scope.state(), ScopeState::kCaptured) << word_first;
    EXPECT_EQ(bench.scope.newest()->trigger_cycle, 600U);
  }
}

TEST(Scope, WaitsForEnoughSamplesBeforeTheTrigger) {
  Bench bench;
  bench.Arm(RisingOnX(2000, 1500));
  bench.Feed(0, 4000);  // the step comes when only 1000 samples lie behind it
  EXPECT_EQ(bench.scope.state(), ScopeState::kArmed);
}

TEST(Scope, IsNotTriggeredByAGapAcrossWhichTheLevelIsPassed) {
  Bench bench;
  bench.Arm(RisingOnX(100, 10));
  bench.Feed(0, 900);
  bench.Feed(1100, 2000);  // the step lay in what is missing
  EXPECT_EQ(bench.scope.state(), ScopeState::kArmed);
  EXPECT_EQ(bench.scope.newest(), nullptr);
}

TEST(Scope, GivesUpACaptureThatAGapCutsAndWaitsForTheNextTrigger) {
  Bench bench;
  bench.Arm(RisingOnX(1000, 100));
  bench.Feed(0, 1200);
  ASSERT_EQ(bench.scope.state(), ScopeState::kTriggered);
  bench.Feed(3000, 3128);
  EXPECT_EQ(bench.scope.state(), ScopeState::kArmed);
  EXPECT_EQ(bench.scope.given_up(), 1U);
  bench.Feed(3128, 6000, [](std::int64_t cycle, int) { return cycle >= 4000 ? 9e-6 : 0.0; });
  ASSERT_EQ(bench.scope.state(), ScopeState::kCaptured);
  EXPECT_EQ(bench.scope.newest()->trigger_cycle, 4000U);
}

TEST(Scope, IsNotTriggeredByReadingsThatAreNoNumbers) {
  Bench bench;
  ScopeSettings settings = RisingOnX(100, 10);
  settings.edge = ScopeEdge::kEither;
  bench.Arm(settings);
  bench.Feed(0, 2000, [](std::int64_t cycle, int) {
    return cycle % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : 10e-6;
  });
  EXPECT_EQ(bench.scope.state(), ScopeState::kArmed);
}

TEST(Scope, IgnoresWhatLayBeforeItWasArmed) {
  Bench bench;
  bench.Feed(0, 2000);
  bench.Arm(RisingOnX(100, 10));
  bench.Feed(2000, 3000);
  EXPECT_EQ(bench.scope.state(), ScopeState::kArmed);
}

TEST(Scope, KeepsNoMoreThanHalfTheRingHowMuchIsAskedFor) {
  Bench bench;
  bench.Arm({.source = ScopeSource::kNow, .samples = 1U << 30U, .before = 1U << 29U});
  EXPECT_EQ(bench.scope.settings().samples, Scope::kMostSamples);
  EXPECT_LT(bench.scope.settings().before, Scope::kMostSamples);
}

}  // namespace
}  // namespace levitas::dashboard
