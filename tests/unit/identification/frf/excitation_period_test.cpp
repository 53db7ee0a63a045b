#include "identification/frf/excitation_period.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "controller/scenario/prbs.hpp"

namespace levitas::identification {
namespace {

std::vector<double> PrbsSignal(int order, std::size_t samples, std::size_t divisor) {
  scenario::Prbs prbs(order);
  std::vector<double> signal;
  signal.reserve(samples);
  while (signal.size() < samples) {
    const double value = prbs.Next() ? 0.05 : -0.05;
    for (std::size_t i = 0; i < divisor && signal.size() < samples; ++i) signal.push_back(value);
  }
  return signal;
}

TEST(ExcitationPeriod, IsThatOfTheShiftRegister) {
  // 2^12 - 1 bits of two samples each.
  EXPECT_EQ(RepeatsAfter(PrbsSignal(12, 4 * 8190, 2)), 8190U);
  EXPECT_EQ(RepeatsAfter(PrbsSignal(9, 3 * 511, 1)), 511U);
}

TEST(ExcitationPeriod, IsFoundThoughAFileRounds) {
  std::vector<double> signal = PrbsSignal(9, 2000, 1);
  for (std::size_t n = 0; n < signal.size(); ++n) signal[n] += n % 3 == 0 ? 1e-9 : 0.0;
  EXPECT_EQ(RepeatsAfter(signal), 511U);
}

TEST(ExcitationPeriod, IsUnknownForOnePeriodAlone) {
  EXPECT_FALSE(RepeatsAfter(PrbsSignal(12, 8190, 2)));
}

TEST(ExcitationPeriod, IsUnknownWithoutASignal) {
  EXPECT_FALSE(RepeatsAfter(std::vector<double>(1000, 0.0)));
  EXPECT_FALSE(RepeatsAfter({}));
}

TEST(ExcitationPeriod, IsTheDistanceOfStrokes) {
  std::vector<double> signal(1000, 0.0);
  for (std::size_t n = 0; n < signal.size(); n += 250) signal[n] = 1.0;
  EXPECT_EQ(RepeatsAfter(signal), 250U);
}

}  // namespace
}  // namespace levitas::identification
