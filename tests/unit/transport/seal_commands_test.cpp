// Commands on a network with a key: by the receiver's challenge; a stop by its seal alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/transport/sealed_datagram.hpp"

namespace levitas::transport {
namespace {

using namespace test;

/// In these tests what is a stop, and needs the seal alone, begins with 9.
bool IsStop(std::span<const std::uint8_t> datagram) noexcept { return datagram[0] == 9; }

class Commands : public testing::Test {
 protected:
  /// What an operator sends who was given `challenge`.
  std::vector<std::uint8_t> Command(std::uint64_t challenge) {
    return Sealed(sealer_, static_cast<std::int64_t>(challenge));
  }
  std::vector<std::uint8_t> Stop(std::int64_t freshness) { return Sealed(sealer_, freshness, 9); }

  Sealer sealer_{Key().For("g:1")};
  SealCheck check_{Key().For("g:1"), SealRule::kChallenge, kUp, IsStop};
};

TEST_F(Commands, AreTakenWithTheChallengeWhateverTheClocksOfTheDaySay) {
  for (const std::int64_t step :
       {std::int64_t{0}, 3 * kSecond, -3 * kSecond, kHour, -kHour, kDay, -kDay}) {
    const std::uint64_t challenge = check_.Challenge(kUp + 1);
    EXPECT_EQ(Open(check_, Command(challenge), {kNow + step, kUp + 2}), SealWord::kGood) << step;
  }
}

TEST_F(Commands, AreRefusedWithoutAChallengeOrWithAnotherOrWithTheTime) {
  const std::uint64_t challenge = check_.Challenge(kUp + 1);
  for (const std::uint64_t other : {std::uint64_t{0}, challenge + 1, std::uint64_t{kNow}}) {
    EXPECT_EQ(Open(check_, Command(other), kNow + 2), SealWord::kChallenge) << other;
  }
}

TEST_F(Commands, AreTakenForTwoAndAHalfSecondsOfTheReceiversOwnClockAndNoLonger) {
  const std::uint64_t challenge = check_.Challenge(kUp);  // counts from the next nanosecond on
  const std::int64_t last_ns = kUp + 1 + SealCheck::kValidNs;
  EXPECT_EQ(Open(check_, Command(challenge), {kNow, last_ns}), SealWord::kGood);
  EXPECT_EQ(Open(check_, Command(challenge), {kNow, last_ns + 1}), SealWord::kChallenge);
}

TEST_F(Commands, OfAnEarlierRunAreWorthNothingInTheNext) {
  const auto recorded = Command(check_.Challenge(kUp + 1));
  SealCheck restarted(Key().For("g:1"), SealRule::kChallenge, kUp + 2, IsStop);
  (void)restarted.Challenge(kUp + 3);
  EXPECT_EQ(Open(restarted, recorded, kNow + 4), SealWord::kChallenge);
  EXPECT_EQ(Open(check_, recorded, kNow + 4), SealWord::kGood);  // it was a good one
  EXPECT_EQ(Open(check_, recorded, kNow + 5), SealWord::kOld);
}

TEST_F(Commands, ChallengesChangeTwiceASecondAndStayValidBesideEachOther) {
  std::vector<std::uint64_t> given;
  for (std::int64_t at = 1; at <= 5; ++at) {
    given.push_back(check_.Challenge(kUp + at * SealCheck::kRenewNs));
    EXPECT_EQ(check_.Challenge(kUp + at * SealCheck::kRenewNs + 1), given.back());
  }
  for (const std::uint64_t challenge : given) {
    EXPECT_EQ(std::count(given.begin(), given.end(), challenge), 1);
    EXPECT_EQ(Open(check_, Command(challenge), {kNow, kUp + 5 * SealCheck::kRenewNs + 2}),
              SealWord::kGood);
  }
}

TEST_F(Commands, OfASenderThatWasForgottenAreNotTakenAgain) {
  const std::uint64_t challenge = check_.Challenge(kUp + 1);
  const auto first = Command(challenge);
  EXPECT_EQ(Open(check_, first, kNow + 2), SealWord::kGood);
  for (std::size_t count = 0; count < SealCheck::kSenders; ++count) {
    Sealer other(Key().For("g:1"));
    EXPECT_EQ(Open(check_, Sealed(other, static_cast<std::int64_t>(challenge)), kNow + 3),
              SealWord::kGood);
  }
  EXPECT_EQ(Open(check_, first, kNow + 4), SealWord::kChallenge);
  const std::uint64_t next = check_.Challenge(kUp + 4);
  EXPECT_NE(next, challenge);  // a new one at once: who is honest is not kept waiting
  EXPECT_EQ(Open(check_, Command(next), kNow + 5), SealWord::kGood);
}

TEST_F(Commands, AStopWithAGoodSealIsTakenWhateverClocksAndNumbersSay) {
  for (const std::int64_t says : {std::int64_t{0}, kNow, kNow + kDay, kNow - kDay}) {
    for (const std::int64_t step :
         {std::int64_t{0}, 3 * kSecond, -3 * kSecond, kHour, -kHour, kDay, -kDay}) {
      const auto stop = Stop(says);
      EXPECT_EQ(Open(check_, stop, {kNow + step, kUp + 1}), SealWord::kGood) << says << ' ' << step;
      EXPECT_EQ(Open(check_, stop, {kNow + step, kUp + 2}), SealWord::kGood) << "said again";
    }
  }
  const auto older = Stop(0);
  const std::uint64_t challenge = check_.Challenge(kUp + 3);
  EXPECT_EQ(Open(check_, Command(challenge), kNow + 4), SealWord::kGood);
  EXPECT_EQ(Open(check_, older, kNow + 5), SealWord::kGood) << "its number is below the last";
}

TEST_F(Commands, AStopOfAnotherKeyOrChangedOnTheWayIsNone) {
  Sealer stranger(Key(2).For("g:1"));
  EXPECT_EQ(Open(check_, Sealed(stranger, kNow, 9), kNow + 1), SealWord::kWrongKey);
  const auto stop = Stop(kNow);
  for (std::size_t bit = 0; bit < 8 * stop.size(); ++bit) {
    auto changed = stop;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    EXPECT_NE(Open(check_, changed, kNow + 2), SealWord::kGood) << bit;
  }
}

TEST_F(Commands, AStopMakesOldWhatItsSenderSaidBeforeIt) {
  const std::uint64_t challenge = check_.Challenge(kUp + 1);
  EXPECT_EQ(Open(check_, Command(challenge), kNow + 2), SealWord::kGood);
  const auto before = Command(challenge);
  EXPECT_EQ(Open(check_, Stop(0), kNow + 3), SealWord::kGood);
  EXPECT_EQ(Open(check_, before, kNow + 4), SealWord::kOld);
}

// Recorded stops of many earlier runs cost a trip, and nobody's place.
TEST_F(Commands, AFloodOfOldStopsLeavesEverybodyElseTheirCommands) {
  const std::uint64_t challenge = check_.Challenge(kUp + 1);
  EXPECT_EQ(Open(check_, Command(challenge), kNow + 2), SealWord::kGood);
  for (int count = 0; count < 1000; ++count) {
    Sealer earlier(Key().For("g:1"));
    EXPECT_EQ(Open(check_, Sealed(earlier, kNow - kDay, 9), kNow + 3), SealWord::kGood);
  }
  EXPECT_EQ(Open(check_, Command(challenge), kNow + 4), SealWord::kGood);
}

}  // namespace
}  // namespace levitas::transport
