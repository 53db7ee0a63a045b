#include "configuration/schema/unit.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/random.hpp"

namespace levitas::configuration {
namespace {

TEST(IsDecimal, AcceptsPlainNumbersOnly) {
  for (const char* text : {"0", "-1", "+2", "3.5", ".5", "5.", "1e3", "1.5E-7", "-.5e+2"}) {
    EXPECT_TRUE(IsDecimal(text)) << text;
  }
  for (const char* text : {"", "-", ".", "e5", "1e", "0x10", "1_000", "1,5", "nan", ".inf", "1 mm",
                           " 1", "1 ", "1e5.0", "--1", "1.2.3", "0b1", "1d3"}) {
    EXPECT_FALSE(IsDecimal(text)) << text;
  }
}

TEST(ToSi, OfAPowerOfTenIsTheNearestDoubleOfTheWrittenNumber) {
  EXPECT_EQ(ToSi("457.2", unit::kMillimetre), 0.4572);
  EXPECT_EQ(ToSi("0.381", unit::kMillimetre), 0.381e-3);
  EXPECT_EQ(ToSi("190", unit::kMicrometre), 190e-6);
  EXPECT_EQ(ToSi("193", unit::kGigapascal), 193e9);
  EXPECT_EQ(ToSi("18", unit::kGramMillimetre), 18e-6);
  EXPECT_EQ(ToSi("1.2e2", unit::kMillisecond), 0.12);
}

TEST(ToSi, OfRpmAndDegreesIsRoundedOnce) {
  // pi to twice the digits of a double: 6000 rpm = 200 pi rad/s.
  EXPECT_EQ(ToSi("6000", unit::kRpm), 628.318530717958647692528676656);
  EXPECT_EQ(ToSi("180", unit::kDegree), std::numbers::pi);
  EXPECT_EQ(ToSi("225", unit::kDegree), 3.92699081698724154807830422910);
  EXPECT_EQ(ToSi("1", unit::kTurnsPerSecond), 2.0 * std::numbers::pi);
}

TEST(ToSi, RefusesWhatADoubleCannotHold) {
  for (const char* text : {"1e400", "-1e999", "1e-400", "1e99999999999", "1e2147483648"}) {
    EXPECT_FALSE(ToSi(text, unit::kOne)) << text;
    EXPECT_FALSE(ToSi(text, unit::kRpm)) << text;
  }
}

TEST(FromSi, KeepsRoundNumbersReadable) {
  EXPECT_EQ(FromSi(0.4572, unit::kMillimetre), "457.2");
  EXPECT_EQ(FromSi(0.381e-3, unit::kMillimetre), "0.381");
  EXPECT_EQ(FromSi(0.0, unit::kMicrometre), "0");
  EXPECT_EQ(FromSi(-1.0, unit::kOne), "-1");
  EXPECT_EQ(FromSi(628.318530717958647692528676656, unit::kRpm), "6000");
  EXPECT_EQ(FromSi(2e7, unit::kStiffness), "2e7");
  EXPECT_EQ(FromSi(300000.0, unit::kOne), "300000");
  EXPECT_EQ(FromSi(1.45161e-6, unit::kOne), "1.45161e-6");
  EXPECT_EQ(FromSi(0.00183, unit::kOne), "0.00183");
}

TEST(FromSi, ReadsBackToTheSameBitsInEveryUnit) {
  Random random(20261121);
  for (const Unit& unit : AllUnits()) {
    for (int i = 0; i < 1000; ++i) {
      // Mantissa of random bits, magnitude 1e-9 .. 1e9: more than any key allows.
      const double si = (random.Bits() % 2 == 0 ? 1.0 : -1.0) * (0.5 + random.Uniform()) *
                        std::pow(10.0, 18.0 * random.Uniform() - 9.0);
      const auto back = ToSi(FromSi(si, unit), unit);
      ASSERT_TRUE(back) << unit.suffix << " " << si;
      ASSERT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(si))
          << unit.suffix << " " << FromSi(si, unit);
    }
  }
}

TEST(FromSi, ReadsBackAtTheEndsOfTheRange) {
  for (const double si : {std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
                          std::numeric_limits<double>::denorm_min(), -0.0, 0.1, 1.0 / 3.0}) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*ToSi(FromSi(si, unit::kOne), unit::kOne)),
              std::bit_cast<std::uint64_t>(si));
  }
}

}  // namespace
}  // namespace levitas::configuration
