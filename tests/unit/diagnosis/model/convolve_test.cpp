// A finite impulse response against the plain sum.

#include "diagnosis/model/convolve.hpp"

#include <gtest/gtest.h>

#include "common/random.hpp"

namespace levitas::diagnosis {
namespace {

// Lengths below, at and beyond what is done at once, and filters of one tap and of many.
TEST(Convolve, IsTheSumOverThePast) {
  Random random(6);
  for (const std::size_t taps : {1U, 2U, 7U, 41U}) {
    for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 63U, 256U}) {
      std::vector<double> filter(taps);
      std::vector<double> values(taps + count);
      for (double& weight : filter) weight = random.Normal();
      for (double& value : values) value = random.Normal();
      const double* now = values.data() + taps;
      std::vector<double> to(count + 1, -7.0);
      Convolve(filter, now, count, to.data());
      for (std::size_t n = 0; n < count; ++n) {
        double sum = 0.0;
        for (std::size_t k = 0; k < taps; ++k) sum += filter[k] * *(now + n - k);
        EXPECT_NEAR(to[n], sum, 1e-13 * static_cast<double>(taps)) << taps << " taps, value " << n;
      }
      EXPECT_EQ(to[count], -7.0) << "written beyond " << count;
    }
  }
}

}  // namespace
}  // namespace levitas::diagnosis
