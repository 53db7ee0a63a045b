// Series from files, and data that no model can come of.
#include "identification/nonlinear/series.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <functional>

#include "common/problem.hpp"
#include "identification/nonlinear/grey_box.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/identification/nonlinear/synthetic_series.hpp"

namespace levitas::identification {
namespace {

using testing::HasSubstr;

template <class Work>
std::string Refusal(const Work& work) {
  try {
    work();
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "accepted";
}

class SeriesFile : public testing::Test {
 protected:
  std::string Write(const std::string& text) {
    const std::string path = folder_ / "data.csv";
    std::ofstream(path) << text;
    return path;
  }
  test::ScratchFolder folder_;
};

TEST_F(SeriesFile, NamedColumnsAreReadWhateverTheirOrder) {
  const std::string path = Write("\"b\",\"x\",\"a\",\n1,9,2,\n3,9,4,\n5,9,7,\n");
  const Series s = ReadSeries(path, {{"a"}, {"b"}}, 0.5);
  EXPECT_EQ(s.input, Eigen::Vector3d(2, 4, 7));
  EXPECT_EQ(s.output, Eigen::Vector3d(1, 3, 5));
  EXPECT_EQ(s.period_s, 0.5);
}

TEST_F(SeriesFile, ATimeColumnGivesThePeriod) {
  const std::string path = Write("time_s;u;y\n0,5;1;1\n0,75;2,5;2\n1,0;3;4\n");
  const Series s = ReadSeries(path, {{"u"}, {"y"}}, 0.0);
  EXPECT_DOUBLE_EQ(s.period_s, 0.25);
  EXPECT_DOUBLE_EQ(s.input(1, 0), 2.5);
}

TEST_F(SeriesFile, AMissingColumnIsNamedWithThoseThatAreThere) {
  const std::string path = Write("u,y\n1,2\n3,4\n");
  const std::string text = Refusal([&] { (void)ReadSeries(path, {{"v"}, {"y"}}, 1.0); });
  EXPECT_THAT(text, HasSubstr("no column 'v'; there are: u, y"));
}

TEST_F(SeriesFile, ACellThatIsNoNumberIsNamedWithItsLine) {
  const std::string path = Write("u,y\n1,2\n3,nan\n");
  const std::string text = Refusal([&] { (void)ReadSeries(path, {{"u"}, {"y"}}, 1.0); });
  EXPECT_THAT(text, HasSubstr("line 3: column 2: 'nan' is no finite number"));
}

TEST_F(SeriesFile, WithoutTimeARateIsNeeded) {
  const std::string path = Write("u,y\n1,2\n3,4\n");
  const std::string text = Refusal([&] { (void)ReadSeries(path, {{"u"}, {"y"}}, 0.0); });
  EXPECT_THAT(text, HasSubstr("no column time_s: give the sampling rate"));
}

TEST_F(SeriesFile, ATimeThatFallsStandsOrLeapsIsRefusedWithItsRow) {
  const auto refusal = [this](const std::string& rows) {
    const std::string path = Write("time_s,u,y\n" + rows);
    return Refusal([&] { (void)ReadSeries(path, {{"u"}, {"y"}}, 1.0); });
  };
  EXPECT_THAT(refusal("3,1,1\n2,2,2\n1,3,4\n"), HasSubstr("time_s: a step of -1 s at row 1"));
  EXPECT_THAT(refusal("0,1,1\n1,2,2\n1,3,4\n2,5,6\n"), HasSubstr("a step of 0 s at row 2"));
  // 1 ms throughout, one row missing.
  EXPECT_THAT(refusal("0,1,1\n0.001,2,2\n0.002,3,4\n0.004,5,6\n0.005,1,2\n"),
              HasSubstr("a step of 0.002 s at row 3, the usual step is 0.001 s"));
}

TEST_F(SeriesFile, ATimeRoundedToItsDigitsIsTaken) {
  // 1/3 ms in whole tenths of a millisecond: steps of 0.3 and 0.4 ms.
  const std::string path = Write("time_s,u,y\n0,1,1\n0.0003,2,2\n0.0007,3,4\n0.0010,5,6\n");
  EXPECT_NEAR(ReadSeries(path, {{"u"}, {"y"}}, 0.0).period_s, 1e-3 / 3.0, 1e-12);
}

TEST(Ranges, AreHalfOpenAndMayBeOpenEnded) {
  EXPECT_EQ(ParseRange("10:20", 100).begin, 10U);
  EXPECT_EQ(ParseRange("10:", 100).end, 100U);
  EXPECT_EQ(ParseRange(":7", 100).end, 7U);
  EXPECT_THAT(Refusal([] { (void)ParseRange("20:10", 100); }), HasSubstr("rows 0 to 100"));
  EXPECT_THAT(Refusal([] { (void)ParseRange("0:101", 100); }), HasSubstr("rows 0 to 100"));
  EXPECT_THAT(Refusal([] { (void)ParseRange("ten", 100); }), HasSubstr("FIRST:END"));
}

std::string Spoilt(const std::function<void(Series&)>& spoil, std::size_t unknowns = 5) {
  Series s = test::CubicSystem(1000, 0.01, 41);
  spoil(s);
  return Refusal([&] { RefuseUnfit(s, unknowns); });
}

TEST(UnfitSeries, GoodDataAreAccepted) {
  EXPECT_EQ(Spoilt([](Series&) {}), "accepted");
}

TEST(UnfitSeries, NoExcitationIsSaid) {
  EXPECT_THAT(Spoilt([](Series& s) { s.input.setConstant(0.3); }),
              HasSubstr("input 'u1' never changes: nothing was excited"));
}

TEST(UnfitSeries, ADeadOutputIsNamed) {
  EXPECT_THAT(Spoilt([](Series& s) { s.output.setConstant(0.3); }),
              HasSubstr("output 'y1' is dead"));
}

TEST(UnfitSeries, ColumnsWithoutNamesAreToldByTheirNumbers) {
  EXPECT_THAT(Spoilt([](Series& s) {
                s.input_names.clear();
                s.output_names.clear();
                s.output.setConstant(0.3);
              }),
              HasSubstr("output '1' is dead"));
}

TEST(UnfitSeries, AClippedOutputIsNamed) {
  EXPECT_THAT(Spoilt([](Series& s) { s.output = s.output.cwiseMin(0.1); }),
              HasSubstr("output 'y1' is clipped"));
}

TEST(UnfitSeries, TooFewRowsAreRefused) {
  EXPECT_THAT(Spoilt([](Series&) {}, 101), HasSubstr("1000 rows for 101 unknowns"));
}

TEST(UnfitSeries, ASignOfTheOtherWayIsAFactOfTheModelAndNoRefusal) {
  // Nothing in an input and an output says which sign is right: the model shows it as a gain.
  Series s = test::CubicSystem(2000, 0.0, 42);
  const Oscillator right = FitOscillator(s, {});
  s.input = -s.input;
  const Oscillator wrong = FitOscillator(s, {});
  EXPECT_NEAR(right.spring[1], -wrong.spring[1], 1e-6 * std::abs(right.spring[1]));
}

}  // namespace
}  // namespace levitas::identification
