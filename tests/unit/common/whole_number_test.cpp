#include "common/whole_number.hpp"

#include <gtest/gtest.h>

namespace levitas {
namespace {

TEST(WholeNumber, TakesEveryNumberOf64BitsAndNoOther) {
  for (const char* text : {"0", "-1", "+7", "007", "9223372036854775807", "-9223372036854775808"}) {
    EXPECT_EQ(WhyNoWholeNumber(text), "") << text;
  }
  for (const char* text : {"", "+", "-", "+-1", "1.5", "1e3", "0x10", " 1", "1 ", "x",
                           "9223372036854775808", "-9223372036854775809"}) {
    EXPECT_NE(WhyNoWholeNumber(text), "") << text;
  }
}

TEST(WholeNumber, NamesWhatWasFound) {
  EXPECT_NE(WhyNoWholeNumber("99999999999999999999").find("'99999999999999999999'"),
            std::string::npos);
}

}  // namespace
}  // namespace levitas
