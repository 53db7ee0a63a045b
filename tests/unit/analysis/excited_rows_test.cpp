#include "analysis/excited_rows.hpp"

#include <gtest/gtest.h>

namespace levitas::analysis {
namespace {

/// Three axes and four rows: a current on axis 1 in row 1, a position on axis 2 in row 3.
session::Recording WithTwoSignals() {
  session::Recording recording;
  recording.channels = {"a", "b", "c"};
  recording.cycle = {0, 1, 2, 3};
  recording.excitation_a.resize(3);
  recording.excitation_m.resize(3);
  recording.excitation_a[1] = {0.0, -0.1, 0.0, 0.0};
  recording.excitation_m[2] = {0.0, 0.0, 0.0, 1e-9};
  return recording;
}

TEST(ExcitedRows, AreThoseOfEitherKindOfSignalOnItsOwnAxisAlone) {
  const session::Recording recording = WithTwoSignals();
  for (std::size_t row = 0; row < recording.rows(); ++row) {
    SCOPED_TRACE(row);
    EXPECT_FALSE(ExcitedAt(recording, 0, row));
    EXPECT_EQ(ExcitedAt(recording, 1, row), row == 1);
    EXPECT_EQ(ExcitedAt(recording, 2, row), row == 3);
    EXPECT_EQ(ExcitedAt(recording, row), row == 1 || row == 3) << "on any axis";
  }
}

TEST(ExcitedRows, AreNoneOfARecordThatNeverHadASignal) {
  session::Recording recording = WithTwoSignals();
  recording.excitation_a.assign(3, {});
  recording.excitation_m.assign(3, {});
  for (std::size_t row = 0; row < recording.rows(); ++row) EXPECT_FALSE(ExcitedAt(recording, row));
}

}  // namespace
}  // namespace levitas::analysis
