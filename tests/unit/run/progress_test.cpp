#include "cli/run/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace levitas::cli {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;

/// What was written.
class Written {
 public:
  [[nodiscard]] Progress::Out out() {
    return [this](const std::string& part) { text_ += part; };
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

ProgressSample At(std::uint64_t cycle, Mode mode, double radius_m) {
  return {cycle, mode, 300.0, {radius_m, 0.0, 0.0, 2.0 * radius_m}};
}

constexpr double kPeriod_s = 1e-4;
const Progress::Clock::time_point kStart{};

TEST(Progress, WritesOneLinePerModeChangeWhenItIsNoTerminal) {
  Written written;
  Progress progress({"de", "nde"}, kPeriod_s, written.out(), false);
  for (int i = 0; i < 50; ++i) {
    const Mode mode = i < 20 ? Mode::kLift : Mode::kLevitating;
    progress.Show(At(static_cast<std::uint64_t>(i) * 1000, mode, 1e-6),
                  kStart + milliseconds(100 * i));
  }
  progress.Close();
  std::istringstream lines(written.text());
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, testing::StartsWith("lift "));
  std::getline(lines, line);
  EXPECT_THAT(line, testing::StartsWith("levitating "));
  EXPECT_FALSE(std::getline(lines, line));
  EXPECT_THAT(written.text(), Not(HasSubstr("\r")));
}

TEST(Progress, TellsInALogWhatTheModeBeforeHasSeen) {
  Written written;
  Progress progress({"de", "nde"}, kPeriod_s, written.out(), false);
  progress.Show(At(0, Mode::kLift, 90e-6), kStart);
  progress.Show(At(1000, Mode::kLift, 80e-6), kStart + milliseconds(100));
  progress.Show(At(2000, Mode::kSpinning, 7e-6), kStart + milliseconds(200));
  progress.Show(At(3000, Mode::kLanding, 3e-6), kStart + milliseconds(300));
  std::istringstream lines(written.text());
  std::string lift, spinning, landing;
  std::getline(lines, lift);
  std::getline(lines, spinning);
  std::getline(lines, landing);
  EXPECT_THAT(lift, Not(HasSubstr("before")));
  EXPECT_THAT(spinning, HasSubstr("lift before: up to 2865 rpm,  de  90.0 um  nde 180.0 um"));
  EXPECT_THAT(landing, HasSubstr("spinning before: up to 2865 rpm,  de   7.0 um  nde  14.0 um"));
}

TEST(Progress, RedrawsOneLineOnATerminalAndEndsItOnce) {
  Written written;
  Progress progress({"de", "nde"}, kPeriod_s, written.out(), true);
  progress.Show(At(0, Mode::kLevitating, 1e-6), kStart);
  progress.Show(At(500, Mode::kLevitating, 1e-6), kStart + milliseconds(50));  // too soon
  progress.Show(At(1000, Mode::kLevitating, 1e-6), kStart + milliseconds(100));
  const std::string text = written.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 2);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 0);
  progress.Close();
  progress.Close();
  const std::string closed = written.text();
  EXPECT_EQ(std::count(closed.begin(), closed.end(), '\n'), 1);
}

// 300 rad/s are 2864.8 rpm; the larger of two orbits seen between redraws is shown.
TEST(Progress, ShowsModeSpeedTimeAndTheLargestOrbitSinceTheLastLine) {
  Written written;
  Progress progress({"de", "nde"}, kPeriod_s, written.out(), true);
  progress.Show(At(0, Mode::kSpinning, 1e-6), kStart);
  progress.Show(At(100, Mode::kSpinning, 5e-6), kStart + milliseconds(10));
  progress.Show(At(20'000, Mode::kSpinning, 2e-6), kStart + milliseconds(200));
  const std::string text = written.text();
  const std::string last = text.substr(text.rfind('\r'));
  EXPECT_THAT(last, HasSubstr("spinning"));
  EXPECT_THAT(last, HasSubstr("2865 rpm"));
  EXPECT_THAT(last, HasSubstr("de   5.0 um"));
  EXPECT_THAT(last, HasSubstr("nde  10.0 um"));
  EXPECT_THAT(last, HasSubstr("2.00 s"));
}

// 20 000 cycles of 100 us in one second of wall-clock time: twice real time.
TEST(Progress, SaysHowFastTheRigsTimePasses) {
  Written written;
  Progress progress({"de", "nde"}, kPeriod_s, written.out(), true);
  progress.Show(At(0, Mode::kSpinning, 1e-6), kStart);
  progress.Show(At(20'000, Mode::kSpinning, 1e-6), kStart + milliseconds(1000));
  EXPECT_THAT(written.text(), HasSubstr("2.00 x real time"));
}

TEST(Progress, SurvivesAControllerThatCountsFromZeroAgain) {
  Written written;
  Progress progress({"de", "nde"}, kPeriod_s, written.out(), true);
  progress.Show(At(1'000'000, Mode::kSpinning, 1e-6), kStart);
  progress.Show(At(0, Mode::kOff, 1e-6), kStart + milliseconds(1000));
  progress.Show(At(10'000, Mode::kOff, 1e-6), kStart + milliseconds(2000));
  EXPECT_THAT(written.text(), HasSubstr("1.00 x real time"));
}

}  // namespace
}  // namespace levitas::cli
