// Which difference is named, and in which words. That every field is compared, replay_test.cpp
// shows.

#include "session/replay/output_difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace levitas::session {
namespace {

const std::vector<std::string> kTwoChannels{"de_x", "de_y"};

TEST(OutputDifference, IsOfBitsSoThatTheSameNanIsNoneAndAnotherSignOfZeroIsOne) {
  cycle::CycleOutputs recorded;
  recorded.fault_value = std::numeric_limits<double>::quiet_NaN();
  cycle::CycleOutputs computed = recorded;
  EXPECT_FALSE(FirstDifference(recorded, computed, kTwoChannels));

  computed.reference_m[1] = -0.0;
  const auto found = FirstDifference(recorded, computed, kTwoChannels);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->field, "reference_m de_y");
  EXPECT_FALSE(std::signbit(std::stod(found->recorded)));
  EXPECT_TRUE(std::signbit(std::stod(found->computed))) << "the sign is the difference";
}

TEST(OutputDifference, IsTheFirstOfSeveralAndOfTheFirstAxis) {
  cycle::CycleOutputs computed;
  computed.current.control_current_a = {1.0, 2.0};
  computed.current.bias_current_a = 3.0;
  const auto of_current = FirstDifference({}, computed, kTwoChannels);
  ASSERT_TRUE(of_current);
  EXPECT_EQ(of_current->field, "control_current_a de_x");
  EXPECT_EQ(std::stod(of_current->recorded), 0.0);
  EXPECT_EQ(std::stod(of_current->computed), 1.0);

  computed.mode = Mode::kLevitating;  // what the supervisor decided comes before what it commands
  const auto of_mode = FirstDifference({}, computed, kTwoChannels);
  ASSERT_TRUE(of_mode);
  EXPECT_EQ(of_mode->field, "mode");
  EXPECT_EQ(of_mode->recorded, Name(Mode::kOff));
  EXPECT_EQ(of_mode->computed, Name(Mode::kLevitating));
}

TEST(OutputDifference, OfOneBitIsWrittenWithAllItsDigits) {
  cycle::CycleOutputs recorded;
  recorded.current.bias_current_a = 0.1;
  cycle::CycleOutputs computed = recorded;
  computed.current.bias_current_a = std::nextafter(0.1, 1.0);
  const auto found = FirstDifference(recorded, computed, kTwoChannels);
  ASSERT_TRUE(found);
  EXPECT_EQ(std::stod(found->recorded), 0.1);
  EXPECT_EQ(std::stod(found->computed), std::nextafter(0.1, 1.0));
}

}  // namespace
}  // namespace levitas::session
