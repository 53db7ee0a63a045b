#include "transport/seal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/support/allocation_guard.hpp"
#include "tests/unit/transport/sealed_datagram.hpp"

namespace levitas::transport {
namespace {

using namespace test;

class Seal : public testing::Test {
 protected:
  Sealer sealer_{Key().For("g:1")};
  SealCheck check_{Key().For("g:1"), SealRule::kClock, kUp};
};

TEST_F(Seal, PassesWhatTheSameKeySentAndTakesTheTrailerOff) {
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 1), kNow + 2), SealWord::kGood);
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 2), kNow + 3), SealWord::kGood);
  EXPECT_EQ(check_.count(SealWord::kGood), 2U);
  EXPECT_EQ(check_.sender(), sealer_.sender());
}

TEST_F(Seal, RefusesWhatHasNoTrailer) {
  EXPECT_EQ(Open(check_, std::vector<std::uint8_t>(kSize, 7), kNow), SealWord::kNone);
  EXPECT_EQ(Open(check_, {}, kNow), SealWord::kNone);
}

TEST_F(Seal, NamesAPartnerOfTheFirstVersion) {
  std::vector<std::uint8_t> first(kSize + 36, 7);
  const std::array<std::uint8_t, 4> mark{'L', 'K', 'Y', '1'};
  std::copy(mark.begin(), mark.end(), first.begin() + kSize);
  EXPECT_EQ(Open(check_, first, kNow), SealWord::kVersion);
  EXPECT_THAT(Text(SealWord::kVersion), testing::HasSubstr("one version on all machines"));
}

TEST_F(Seal, RefusesAnotherKeyAndTheSameKeyOnAnotherPort) {
  for (SealingKey key : {Key(2).For("g:1"), Key().For("g:2")}) {
    Sealer other(key);
    EXPECT_EQ(Open(check_, Sealed(other, kNow + 1), kNow + 2), SealWord::kWrongKey);
  }
}

TEST_F(Seal, RefusesADatagramOfWhichAnySingleBitWasChanged) {
  const auto datagram = Sealed(sealer_, kNow + 1);
  for (std::size_t bit = 0; bit < 8 * datagram.size(); ++bit) {
    auto changed = datagram;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    EXPECT_NE(Open(check_, changed, kNow + 2), SealWord::kGood) << bit;
  }
  EXPECT_EQ(Open(check_, datagram, kNow + 2), SealWord::kGood);
}

TEST_F(Seal, TakesNoDatagramTwiceAndNoneThatIsOlderThanTheLast) {
  const auto first = Sealed(sealer_, kNow + 1);
  const auto second = Sealed(sealer_, kNow + 2);
  EXPECT_EQ(Open(check_, second, kNow + 3), SealWord::kGood);
  EXPECT_EQ(Open(check_, second, kNow + 3), SealWord::kOld);
  EXPECT_EQ(Open(check_, first, kNow + 3), SealWord::kOld);
}

TEST_F(Seal, RefusesAfterARestartWhatWasRecordedBefore) {
  const auto recorded = Sealed(sealer_, kNow + kSecond);
  EXPECT_EQ(Open(check_, recorded, kNow + kSecond), SealWord::kGood);
  const std::int64_t again = kNow + 3 * kSecond / 2;
  SealCheck restarted(Key().For("g:1"), SealRule::kClock, At(again).monotonic_ns);
  EXPECT_EQ(Open(restarted, recorded, again + 1), SealWord::kOld);
  EXPECT_EQ(Open(restarted, recorded, kNow + 100 * kSecond), SealWord::kClock);
}

TEST_F(Seal, NamesAClockThatDiffersByMoreThanTwoSecondsAndByHowMuch) {
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 35 * kSecond), kNow), SealWord::kClock);
  EXPECT_EQ(check_.clock_off_ns(), 35 * kSecond);
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 36 * kSecond), kNow + 36 * kSecond),
            SealWord::kGood);
}

TEST_F(Seal, AClockThatIsSetDuringARunStopsNoFrames) {
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 1), kNow + 1), SealWord::kGood);
  std::int64_t up_ns = kUp + 1;
  for (const std::int64_t step : {3 * kSecond, -3 * kSecond, kHour, -kHour, kDay, -kDay}) {
    // The receiver's is set; then the sender's, while the receiver's stands where it was.
    EXPECT_EQ(Open(check_, Sealed(sealer_, kNow), {kNow + step, ++up_ns}), SealWord::kGood) << step;
    EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + step), {kNow, ++up_ns}), SealWord::kGood) << step;
  }
}

// A machine without a battery for its clock: the receiver starts an hour ahead, then its clock is
// put right. Whoever speaks then is heard at once, not in an hour.
TEST_F(Seal, AClockThatWasAheadAtTheStartAndIsPutRightKeepsNobodyOut) {
  SealCheck check(Key().For("g:1"), SealRule::kClock, kUp);
  EXPECT_EQ(Open(check, Sealed(sealer_, kNow), {kNow + kHour, kUp + 1}), SealWord::kClock);
  EXPECT_EQ(Open(check, Sealed(sealer_, kNow + 2), {kNow + 2, kUp + 2}), SealWord::kGood);
  // And the sender: what it sent while ahead, it is known by what it says now.
  Sealer ahead(Key().For("g:1"));
  EXPECT_EQ(Open(check, Sealed(ahead, kNow + kHour), {kNow, kUp + 3}), SealWord::kClock);
  EXPECT_EQ(Open(check, Sealed(ahead, kNow + 4), {kNow + 4, kUp + 4}), SealWord::kGood);
}

TEST_F(Seal, ASenderThatHasProvenItselfNeedsNoClockAndItsRecordsStayRefused) {
  const auto recorded = Sealed(sealer_, kNow + kHour);
  const auto proof = Sealed(sealer_, kNow + kHour);
  EXPECT_EQ(Open(check_, proof, kNow), SealWord::kClock);
  check_.Trust(kUp + 1);
  EXPECT_EQ(Open(check_, recorded, kNow + 1), SealWord::kOld);
  EXPECT_EQ(Open(check_, proof, kNow + 1), SealWord::kOld);
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + kHour), kNow + 2), SealWord::kGood);
  Sealer other(Key().For("g:1"));  // it proves nobody else
  EXPECT_EQ(Open(check_, Sealed(other, kNow + kHour), kNow + 3), SealWord::kClock);
}

TEST_F(Seal, KnowsManySendersAndTakesNothingOldOfThoseItForgot) {
  std::vector<std::vector<std::uint8_t>> sent;
  for (std::int64_t count = 1; count <= 200; ++count) {
    Sealer one(Key().For("g:1"));
    sent.push_back(Sealed(one, kNow + count));
    EXPECT_EQ(Open(check_, sent.back(), kNow + count), SealWord::kGood);
  }
  for (const auto& datagram : sent) {
    EXPECT_EQ(Open(check_, datagram, kNow + 201), SealWord::kOld);
  }
}

TEST_F(Seal, RandomBytesAreNeverGood) {
  std::mt19937_64 draw{20261123};
  for (int count = 0; count < 20'000; ++count) {
    std::vector<std::uint8_t> noise(draw() % 200);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(draw());
    std::span<const std::uint8_t> view = noise;
    EXPECT_NE(check_.Open(view, At(kNow)), SealWord::kGood);
  }
}

TEST_F(Seal, AllocatesNothing) {
  std::array<std::uint8_t, kSize + kTrailerBytes> buffer{};
  std::uint64_t good = 0;
  const levitas::test::AllocationGuard guard;
  for (std::int64_t count = 1; count <= 10'000; ++count) {
    auto whole = sealer_.Append(buffer, kSize, static_cast<std::uint64_t>(kNow + count));
    good += check_.Open(whole, At(kNow + count)) == SealWord::kGood ? 1U : 0U;
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(good, 10'000U);
}

}  // namespace
}  // namespace levitas::transport
