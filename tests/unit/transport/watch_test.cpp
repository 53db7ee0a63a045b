#include <gtest/gtest.h>

#include "transport/partner_watch.hpp"
#include "transport/sequence_watch.hpp"

namespace levitas::transport {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
using Say = PartnerWatch::Say;

TEST(PartnerWatch, SaysOnceThatThePartnerIsMissingAfterTwoSeconds) {
  PartnerWatch watch(0, 30 * kSecond);
  EXPECT_EQ(watch.Check(2 * kSecond - 1, 0), Say::kNothing);
  EXPECT_EQ(watch.Check(2 * kSecond, 0), Say::kMissing);
  EXPECT_EQ(watch.Check(3 * kSecond, 0), Say::kNothing);
  EXPECT_EQ(watch.Check(29 * kSecond, 0), Say::kNothing);
}

TEST(PartnerWatch, GivesUpAtTheTimeOut) {
  PartnerWatch watch(0, 30 * kSecond);
  EXPECT_EQ(watch.Check(30 * kSecond, 0), Say::kGiveUp);
  PartnerWatch hasty(0, kSecond);  // shorter than the patience of the message
  EXPECT_EQ(hasty.Check(kSecond, 0), Say::kGiveUp);
}

TEST(PartnerWatch, AnnouncesThePartnerWhenItComesAndAgainWhenItComesBack) {
  PartnerWatch watch(0, 30 * kSecond);
  EXPECT_EQ(watch.Check(1, 1), Say::kFound);
  EXPECT_EQ(watch.Check(2, 2), Say::kNothing);
  EXPECT_TRUE(watch.present());
  EXPECT_EQ(watch.Check(2 + 2 * kSecond, 2), Say::kMissing);
  EXPECT_FALSE(watch.present());
  EXPECT_EQ(watch.Check(20 * kSecond, 3), Say::kFound);
  EXPECT_EQ(watch.Check(22 * kSecond, 3), Say::kMissing);
}

TEST(PartnerWatch, CountsSilenceFromTheLastMessage) {
  PartnerWatch watch(0, 5 * kSecond);
  (void)watch.Check(4 * kSecond, 1);
  EXPECT_EQ(watch.Check(8 * kSecond, 1), Say::kMissing);
  EXPECT_EQ(watch.Check(9 * kSecond, 1), Say::kGiveUp);
}

TEST(SequenceWatch, CountsTheMessagesBetween) {
  SequenceWatch watch;
  watch.Saw(1, 10);
  watch.Saw(1, 11);
  EXPECT_EQ(watch.lost(), 0U);
  watch.Saw(1, 15);
  EXPECT_EQ(watch.lost(), 3U);
}

TEST(SequenceWatch, LosesNothingWhereTheCountWrapsRound) {
  SequenceWatch watch;
  watch.Saw(1, 0xFFFFFFFF);
  watch.Saw(1, 0);
  EXPECT_EQ(watch.lost(), 0U);
}

TEST(SequenceWatch, LosesNothingByANewSenderOrARepetition) {
  SequenceWatch watch;
  watch.Saw(1, 500);
  watch.Saw(2, 0);
  watch.Saw(2, 1);
  watch.Saw(2, 1);
  EXPECT_EQ(watch.lost(), 0U);
}

}  // namespace
}  // namespace levitas::transport
