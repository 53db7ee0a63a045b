// Pictures of test signals: where each begins, its points, and what correlates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/random.hpp"
#include "report/session/pictures.hpp"
#include "tests/unit/report/session/whirling_rotor.hpp"

namespace levitas::report {
namespace {

constexpr std::size_t kHold = 5;
constexpr std::size_t kBegin = 1000;

/// Two binary signals of 0.2 A, a point every five periods; the second is the first, `late` points
/// later, or one of its own.
Recording Excited(std::optional<std::size_t> late) {
  Recording r = test::WhirlingRotor({.seconds = 2.0, .top_rad_per_s = 0.0});
  r.excitation.assign(2, std::vector<float>(r.size(), 0.0F));
  Random random(3);
  std::vector<float> bits;
  for (std::size_t i = 0; i < 4'000; ++i) bits.push_back(random.Normal() > 0.0 ? 0.2F : -0.2F);
  for (std::size_t row = kBegin; row < r.size(); ++row) {
    const std::size_t point = (row - kBegin) / kHold;
    r.excitation[0][row] = bits[point + 100];
    r.excitation[1][row] = late ? bits[point + 100 - *late] : bits[bits.size() - 1 - point / 2];
  }
  return r;
}

const NamedPicture& Named(const std::vector<NamedPicture>& pictures, const std::string& name) {
  const auto found = std::ranges::find(pictures, name, &NamedPicture::name);
  if (found == pictures.end()) throw std::out_of_range("no picture " + name);
  return *found;
}

TEST(ExcitationPictures, AreNoneWithoutATestSignal) {
  EXPECT_TRUE(ExcitationPictures(test::WhirlingRotor()).empty());
}

TEST(ExcitationPictures, ShowTheFirstTwoHundredPointsOfEachSignal) {
  const Recording r = Excited(7);
  const auto pictures = ExcitationPictures(r);
  const svg::Figure& figure = Named(pictures, "test_signals").figure;
  ASSERT_EQ(figure.panels.size(), 2U);
  EXPECT_EQ(figure.panels[0].title, "de_x at the current, from 0.100 s, 0.5 ms a point");
  const svg::Series& drawn = figure.panels[0].series.at(0);
  EXPECT_EQ(drawn.x.front(), 0.0);
  EXPECT_NEAR(drawn.x.back(), 100.0, 0.2);  // 200 points of 0.5 ms
  for (std::size_t i = 0; i < drawn.x.size(); ++i) {
    EXPECT_NEAR(std::abs(drawn.y[i]), 0.2, 1e-6);
    // The last of two values at one time is the one that is held.
    if (i + 1 < drawn.x.size() && drawn.x[i + 1] == drawn.x[i]) continue;
    const auto row = kBegin + static_cast<std::size_t>(std::lround(10.0 * drawn.x[i]));
    EXPECT_EQ(static_cast<float>(drawn.y[i]), r.excitation[0][row]) << drawn.x[i];
  }
}

TEST(ExcitationPictures, ShowASignalThatIsAnothersLater) {
  const auto pictures = ExcitationPictures(Excited(7));
  const svg::Series& drawn =
      Named(pictures, "test_signal_correlation").figure.panels[0].series.at(0);
  ASSERT_EQ(drawn.x.size(), 41U);
  for (std::size_t i = 0; i < drawn.x.size(); ++i) {
    // 3800 independent points: 0.016 each, four of them.
    EXPECT_NEAR(drawn.y[i], drawn.x[i] == 7.0 ? 1.0 : 0.0, 0.07) << drawn.x[i];
  }
}

TEST(ExcitationPictures, OfSignalsThatActOneAfterTheOtherHaveNoCorrelation) {
  Recording r = Excited({});
  // In turn, 0.3 s each: de_x, de_y, de_x, de_y ...
  for (std::size_t row = 0; row < r.size(); ++row) r.excitation[row / 3'000 % 2][row] = 0.0F;
  const auto pictures = ExcitationPictures(r);
  EXPECT_EQ(pictures.size(), 1U);
}

TEST(ExcitationPictures, OfSignalsAtTheReadingAreInMicrometres) {
  Recording r = Excited(7);
  r.excitation_at_reading = true;
  for (float& value : r.excitation[0]) value *= 1e-5F;
  const auto pictures = ExcitationPictures(r);
  const svg::Panel& panel = Named(pictures, "test_signals").figure.panels.front();
  EXPECT_EQ(panel.y_label, "signal, µm");
  EXPECT_NE(panel.title.find("at the reading"), std::string::npos);
  EXPECT_NEAR(std::abs(panel.series.front().y.front()), 2.0, 1e-5);
}

}  // namespace
}  // namespace levitas::report
