// Pictures of measured torsion: edges over time, lines of the half spectrum, what was lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/two_pi.hpp"
#include "report/session/pictures.hpp"
#include "tests/unit/report/session/whirling_rotor.hpp"

namespace levitas::report {
namespace {

constexpr double kTorque = 0.4;
constexpr std::size_t kLength = 8192;
constexpr std::size_t kLine = 300;  // of that length: no leakage

/// A rotor at one speed whose only coupling carries one line.
Recording Twisted() {
  Recording r = test::WhirlingRotor({.seconds = 2.0, .top_rad_per_s = 0.0});
  r.top_speed_rad_per_s = 100.0;
  std::fill(r.speed_rad_per_s.begin(), r.speed_rad_per_s.end(), 100.0F);
  r.torsion.couplings = {"motor to pinion"};
  r.torsion.torque_n_m.resize(1);
  r.torsion.twist_rad.resize(1);
  for (std::size_t i = 0; i < r.size(); ++i) {
    r.torsion.rig_session.push_back(1);
    r.torsion.cycle.push_back(i);
    r.torsion.torque_n_m[0].push_back(
        kTorque * std::sin(kTwoPi * static_cast<double>(kLine * i) / static_cast<double>(kLength)));
    r.torsion.twist_rad[0].push_back(0.0);
    r.torsion_row.push_back(static_cast<std::int64_t>(i));
  }
  return r;
}

TEST(TorsionPictures, AreNoneWithoutGauges) {
  EXPECT_TRUE(TorsionPictures(test::WhirlingRotor()).empty());
}

TEST(TorsionPictures, ShowTheAmplitudeOfALineAtItsFrequencyAndTheEdgesOverTime) {
  const Recording r = Twisted();
  const auto pictures = TorsionPictures(r);
  ASSERT_EQ(pictures.size(), 2U);
  const auto& edges = pictures[0].figure.panels.at(0).series;
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_EQ(edges[0].name, "motor to pinion");
  EXPECT_NEAR(*std::ranges::max_element(edges[0].y), kTorque, 1e-3);
  EXPECT_NEAR(*std::ranges::min_element(edges[1].y), -kTorque, 1e-3);
  const svg::Series& spectrum = pictures[1].figure.panels.at(0).series.at(0);
  const auto highest = std::ranges::max_element(spectrum.y) - spectrum.y.begin();
  const double line_hz = 1.0 / (r.rig.period_s() * static_cast<double>(kLength));
  EXPECT_NEAR(spectrum.x[static_cast<std::size_t>(highest)], kLine * line_hz, 1e-6);
  EXPECT_NEAR(*std::ranges::max_element(spectrum.y), kTorque, 1e-6);
}

TEST(TorsionPictures, ShowNoSpectrumOverWhatWasLost) {
  Recording r = Twisted();
  for (std::size_t i = 0; i < r.size(); i += 4000) r.torsion_row[i] = -1;
  const auto pictures = TorsionPictures(r);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_NEAR(*std::ranges::max_element(pictures[0].figure.panels.at(0).series.at(0).y), kTorque,
              1e-3);
}

}  // namespace
}  // namespace levitas::report
