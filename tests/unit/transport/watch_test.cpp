#include <gtest/gtest.h>

#include "common/random.hpp"
#include "transport/partner_lock.hpp"
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

TEST(SequenceWatch, CountsAnOvertakenMessageOnceAndAnOldRepetitionNotAtAll) {
  SequenceWatch watch;
  watch.Saw(1, 10);
  watch.Saw(1, 12);  // 11 was overtaken: lost to a reader of the newest
  watch.Saw(1, 11);
  watch.Saw(1, 13);
  EXPECT_EQ(watch.lost(), 1U);
  watch.Saw(1, 10);  // repeated by the network
  watch.Saw(1, 14);
  EXPECT_EQ(watch.lost(), 1U);
}

TEST(SequenceWatch, FollowsASenderThatCountsAnewFromTheSameAddress) {
  SequenceWatch watch;
  watch.Saw(1, 5000);
  watch.Saw(1, 0);
  watch.Saw(1, 1);
  EXPECT_EQ(watch.lost(), 0U);
  watch.Saw(1, 4);
  EXPECT_EQ(watch.lost(), 2U);
}

TEST(SequenceWatch, CountsExactlyTheGapsOfARandomLossAcrossTheWrap) {
  Random random(20261121);
  SequenceWatch watch;
  std::uint64_t lost = 0;
  std::uint32_t sequence = 0xFFFFFFFF - 5000;
  watch.Saw(1, sequence);
  for (int message = 0; message < 10'000; ++message) {
    ++sequence;
    if (message < 9'999 && random.Uniform() < 0.2) {
      ++lost;
    } else {
      watch.Saw(1, sequence);
    }
  }
  EXPECT_EQ(watch.lost(), lost);
}

constexpr std::int64_t kMs = 1'000'000;

/// Without a key: who it is and where it speaks from are one.
Speaker At(std::uint64_t address) { return {address, address}; }

TEST(PartnerLock, RefusesASecondSenderForAsLongAsTheFirstIsHeard) {
  PartnerLock lock;
  EXPECT_FALSE(lock.Refuses(At(1), 0));
  lock.Heard(At(1), 0);
  for (std::int64_t at_ns = 100 * kMs; at_ns <= 10'000 * kMs; at_ns += 100 * kMs) {
    EXPECT_TRUE(lock.Refuses(At(2), at_ns));
    EXPECT_FALSE(lock.Refuses(At(1), at_ns));
    lock.Heard(At(1), at_ns);
  }
  EXPECT_EQ(lock.refused(), 100U);
  EXPECT_EQ(lock.TakeNews(), 2U);
}

TEST(PartnerLock, TakesAnotherSenderAfterTheFirstFellSilentAndIsNoNewsThen) {
  PartnerLock lock;
  lock.Heard(At(1), 0);
  EXPECT_TRUE(lock.Refuses(At(2), PartnerLock::kSilenceNs));
  EXPECT_FALSE(lock.Refuses(At(2), PartnerLock::kSilenceNs + 1));
  lock.Heard(At(2), PartnerLock::kSilenceNs + 1);
  EXPECT_TRUE(lock.Refuses(At(1), PartnerLock::kSilenceNs + 2));
  EXPECT_EQ(lock.TakeNews(), std::nullopt);
}

// Both live: however long the machine holds the first one up, the second is another rig.
TEST(PartnerLock, NeverTakesWhoWasHeardBesideThePartnerForItsNextSelf) {
  PartnerLock lock;
  lock.Heard(At(1), 0);
  EXPECT_TRUE(lock.Refuses(At(2), kMs));
  lock.Heard(At(1), 2 * kMs);
  constexpr std::int64_t kLate = 3600'000 * kMs;
  EXPECT_TRUE(lock.Refuses(At(2), kLate));
  // Another one may be the partner started again; then the second is as good as anybody.
  EXPECT_FALSE(lock.Refuses(At(3), kLate));
  lock.Heard(At(3), kLate);
  EXPECT_FALSE(lock.Refuses(At(2), kLate + PartnerLock::kSilenceNs + 1));
}

TEST(PartnerLock, ForgetsWhoWasBesideWhenThePartnerSaysGoodbye) {
  PartnerLock lock;
  lock.Heard(At(1), 0);
  EXPECT_TRUE(lock.Refuses(At(2), kMs));
  lock.Heard(At(1), 2 * kMs);
  lock.Release();
  EXPECT_FALSE(lock.Refuses(At(2), 3 * kMs));
}

TEST(PartnerLock, TellsEachStrangerOnce) {
  PartnerLock lock;
  lock.Heard(At(1), 0);
  for (const std::uint64_t stranger : {2U, 3U}) {
    for (int time = 0; time < 3; ++time) {
      EXPECT_TRUE(lock.Refuses(At(stranger), kMs));
      lock.Heard(At(1), kMs);
    }
    EXPECT_EQ(lock.TakeNews(), stranger);
    EXPECT_EQ(lock.TakeNews(), std::nullopt);
  }
}

TEST(PartnerLock, IsOpenAgainAfterARelease) {
  PartnerLock lock;
  lock.Heard(At(1), 0);
  lock.Release();
  EXPECT_FALSE(lock.Refuses(At(2), 1));
}

// With a key the seal says who speaks: who forges the partner's address is somebody else, and the
// partner itself may speak from another one.
TEST(PartnerLock, TellsPartnersApartByIdentityAndNamesTheirAddress) {
  PartnerLock lock;
  lock.Heard({.identity = 7, .address = 100}, 0);
  EXPECT_TRUE(lock.Refuses({.identity = 8, .address = 100}, kMs));
  EXPECT_FALSE(lock.Refuses({.identity = 7, .address = 200}, kMs));
  lock.Heard({.identity = 7, .address = 200}, kMs);
  EXPECT_EQ(lock.partner(), 200U);
  EXPECT_EQ(lock.TakeNews(), 100U);
}

}  // namespace
}  // namespace levitas::transport
