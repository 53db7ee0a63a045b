// Records in another unit than their columns say are refused; what a rig can do is not.

#include "diagnosis/records/input_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "common/problem.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const RigView& Rig() {
  static const RigView view(FlexibleRotor().numbers, FlexibleRotor().plant);
  return view;
}

/// White readings and currents of these deviations, at every axis.
Record Noise(double position_m, double current_a) {
  std::mt19937_64 draw{20261122};
  std::normal_distribution<double> normal;
  Record record;
  record.name = "standing.csv";
  record.rows.resize(2000);
  for (auto& row : record.rows) {
    row.levitated = true;
    for (std::size_t a = 0; a < Rig().axes; ++a) {
      row.sample.position_m[a] = 20e-6 * static_cast<double>(a) + position_m * normal(draw);
      row.sample.command.control_current_a[a] = current_a * normal(draw);
    }
  }
  return record;
}

std::string Refusal(const Record& record) {
  try {
    RefuseWrongUnits(Rig(), record);
  } catch (const BadInput& refused) {
    return refused.what();
  }
  return "taken";
}

TEST(PlausibleTest, ReadingsOfMetresInAColumnOfMicrometresAreRefused) {
  EXPECT_EQ(Refusal(Noise(2e-6, 0.3)), "taken");
  EXPECT_THAT(Refusal(Noise(2e-12, 0.3)),
              AllOf(HasSubstr("standing.csv: position de_x scatters by"), HasSubstr("allowed"),
                    HasSubstr("_m, _mm, _um")));
}

TEST(PlausibleTest, AReadingMayBeQuieterThanTheFileSaysButNotByATenth) {
  EXPECT_EQ(Refusal(Noise(0.2e-6, 0.3)), "taken");  // the file says 1 um and steps of 0.05
  EXPECT_NE(Refusal(Noise(0.05e-6, 0.3)), "taken");
}

TEST(PlausibleTest, AmperesInAColumnOfMilliamperesAreRefusedAndTheOtherWayRound) {
  EXPECT_THAT(Refusal(Noise(2e-6, 0.3e-3)),
              AllOf(HasSubstr("control currents are 0.0003"), HasSubstr("bias current of 1 A"),
                    HasSubstr("_a, _ma")));
  EXPECT_THAT(Refusal(Noise(2e-6, 300.0)),
              AllOf(HasSubstr("control current de_x is"), HasSubstr("its coils take 2 A")));
}

TEST(PlausibleTest, AQuietRigAndAmplifiersThatAreOffAreNoWrongUnit) {
  EXPECT_EQ(Refusal(Noise(1e-6, 5e-3)), "taken");
  EXPECT_EQ(Refusal(Noise(1e-6, 0.0)), "taken")
      << "levitated_interval.hpp says that it does not fly";
  Record lying = Noise(1e-6, 1e-6);
  for (auto& row : lying.rows) row.levitated = false;
  EXPECT_EQ(Refusal(lying), "taken");
}

}  // namespace
}  // namespace levitas::diagnosis
