// What remains after a diagnosis: whether it is noise, and if not where it belongs.

#include "diagnosis/inference/residual.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/diagnosis/trajectories.hpp"

namespace levitas::diagnosis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t kSamples = 40'000;  // 4 s

void AddTo(SamplePoint& m, std::size_t axis, double value) {
  m.innovation_m[axis] += static_cast<float>(value);
}

TEST(RemainderTest, NoiseIsKnownByItsLevelAndStandsNowhereOut) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const Residual r = AnalyseResidual(TheRig(), {NoiseRun(seed, kSamples)});
    ASSERT_EQ(r.channels.size(), TheRig().axes);
    for (const ChannelResidual& channel : r.channels) {
      EXPECT_NEAR(channel.noise_rms_m, kNoise, 0.03 * kNoise);
    }
    // The largest of a hundred bands and some hundred lines on four channels.
    EXPECT_LT(r.sigma, 6.0) << seed;
    EXPECT_EQ(r.coherent_with, "nothing") << seed;
    EXPECT_EQ(r.order, 0.0) << seed;
  }
}

TEST(RemainderTest, ALineIsFoundOnItsChannelAtItsFrequency) {
  const Residual r =
      AnalyseResidual(TheRig(), {NoiseRun(5, kSamples, [](std::size_t, SamplePoint& m) {
                        AddTo(m, 2, Sine(0.7e-6, 237.0, m.time_s));
                      })});
  EXPECT_EQ(r.worst_channel, 2U);
  EXPECT_NEAR(r.frequency_hz, 237.0, 2.0 * r.line_spacing_hz);
  EXPECT_GT(r.sigma, 10.0);
  EXPECT_EQ(r.coherent_with, "nothing");
}

TEST(RemainderTest, ALineAtMainsFrequencyIsCalledMains) {
  const Residual r =
      AnalyseResidual(TheRig(), {NoiseRun(6, kSamples, [](std::size_t, SamplePoint& m) {
                        AddTo(m, 0, Sine(1e-6, 50.0, m.time_s));
                      })});
  EXPECT_EQ(r.worst_channel, 0U);
  EXPECT_EQ(r.coherent_with, "mains");
}

TEST(RemainderTest, ALineThatTurnsWithTheShaftIsCalledByItsOrder) {
  for (const int order : {1, 2, 3}) {
    const Residual r =
        AnalyseResidual(TheRig(), {NoiseRun(7, kSamples, [order](std::size_t, SamplePoint& m) {
                          m.speed_rad_per_s = 150.0F;
                          m.angle_rad = 150.0 * m.time_s;
                          AddTo(m, 1, 0.6e-6 * std::cos(order * m.angle_rad + 1.0));
                        })});
    EXPECT_EQ(r.worst_channel, 1U);
    EXPECT_EQ(r.order, order);
    EXPECT_EQ(r.coherent_with, "rotation");
  }
}

TEST(RemainderTest, WhatFollowsTheCurrentIsToldFromWhatFollowsThePosition) {
  for (const bool current : {true, false}) {
    Random random(9);
    double slow = 0.0;
    const Residual r =
        AnalyseResidual(TheRig(), {NoiseRun(8, kSamples, [&](std::size_t, SamplePoint& m) {
                          slow += 0.05 * (random.Normal() - slow);  // below 80 Hz
                          if (current) m.command_now_a[3] += static_cast<float>(slow);
                          if (!current) m.reading_m[3] += static_cast<float>(5e-5 * slow);
                          AddTo(m, 3, 4e-6 * slow);
                        })});
    EXPECT_EQ(r.worst_channel, 3U);
    EXPECT_EQ(r.coherent_with, current ? "current" : "position");
  }
}

TEST(RemainderTest, SamplesThatDoNotCountAreNotLookedAt) {
  const Residual r =
      AnalyseResidual(TheRig(), {NoiseRun(10, kSamples, [](std::size_t n, SamplePoint& m) {
                        if (n >= 20'000) return;
                        m.settled = m.counts = false;
                        AddTo(m, 0, Sine(50e-6, 300.0, m.time_s));
                      })});
  EXPECT_LT(r.sigma, 6.0);
}

TEST(RemainderTest, OfRecordsTooShortForASpectrumIsEmpty) {
  const Residual r = AnalyseResidual(TheRig(), {NoiseRun(11, 1000)});
  EXPECT_EQ(r.sigma, 0.0);
  EXPECT_EQ(r.coherent_with, "nothing");
}

TEST(WhyNotJudged, IsSilentAboutARunThatCanBeJudged) {
  EXPECT_EQ(WhyNotJudged(TheRig(), {NoiseRun(10, kSamples)}), "");
}

TEST(WhyNotJudged, NamesTheLongestStretchAndWhatASpectrumNeeds) {
  const auto parted = [](std::size_t every) {
    return NoiseRun(11, kSamples,
                    [every](std::size_t n, SamplePoint& m) { m.restarted = n % every == 0; });
  };
  const std::string why = WhyNotJudged(TheRig(), {parted(2000)});
  EXPECT_THAT(why, AllOf(HasSubstr("1999 samples"), HasSubstr("needs 2048"),
                         HasSubstr("20 piece(s)"), HasSubstr("Record longer")));
  EXPECT_EQ(WhyNotJudged(TheRig(), {parted(2049)}), "");
}

TEST(WhyNotJudged, SaysThatTheModelLeftTheReadingsAndWhere) {
  const std::string why =
      WhyNotJudged(TheRig(), {NoiseRun(12, kSamples, [](std::size_t n, SamplePoint& m) {
                     if (n >= 30'000) m.innovation_m[2] = std::nanf("");
                   })});
  EXPECT_THAT(why, AllOf(HasSubstr("leaves the readings of nde_x"), HasSubstr("by 3.000 s"),
                         HasSubstr("without --rig")));
}

TEST(WhyNotJudged, SaysThatThereIsNoNoise) {
  const std::string why = WhyNotJudged(
      TheRig(),
      {NoiseRun(13, kSamples, [](std::size_t, SamplePoint& m) { m.innovation_m[1] = 0.0F; })});
  EXPECT_THAT(why, AllOf(HasSubstr("leaves of de_y"), HasSubstr("no noise")));
}

}  // namespace
}  // namespace levitas::diagnosis
