#include "transport/seal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include "common/problem.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::transport {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kNow = 1'800'000'000 * kSecond;  // some day in 2027
constexpr std::size_t kSize = 120;

NetworkKey Key(std::uint8_t first = 1) {
  SealingKey::Bytes secret{};
  secret[0] = first;
  return {secret, "test"};
}

/// A datagram of `kSize` bytes, sealed.
std::vector<std::uint8_t> Sealed(Sealer& sealer, std::int64_t now_ns) {
  std::vector<std::uint8_t> buffer(kSize + kTrailerBytes, 7);
  const auto whole = sealer.Append(buffer, kSize, now_ns);
  return {whole.begin(), whole.end()};
}

SealWord Open(SealCheck& check, const std::vector<std::uint8_t>& datagram, std::int64_t now_ns) {
  std::span<const std::uint8_t> view = datagram;
  const SealWord word = check.Open(view, now_ns);
  EXPECT_EQ(view.size(), word == SealWord::kGood ? kSize : datagram.size());
  return word;
}

class Seal : public testing::Test {
 protected:
  Sealer sealer_{Key().For("g:1")};
  SealCheck check_{Key().For("g:1"), kNow, false};
};

TEST_F(Seal, PassesWhatTheSameKeySentAndTakesTheTrailerOff) {
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 1), kNow + 2), SealWord::kGood);
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 2), kNow + 3), SealWord::kGood);
  EXPECT_EQ(check_.count(SealWord::kGood), 2U);
}

TEST_F(Seal, RefusesWhatHasNoTrailer) {
  EXPECT_EQ(Open(check_, std::vector<std::uint8_t>(kSize, 7), kNow), SealWord::kNone);
  EXPECT_EQ(Open(check_, {}, kNow), SealWord::kNone);
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
  SealCheck restarted(Key().For("g:1"), kNow + 3 * kSecond / 2, false);
  EXPECT_EQ(Open(restarted, recorded, kNow + 3 * kSecond / 2), SealWord::kOld);
  EXPECT_EQ(Open(restarted, recorded, kNow + 100 * kSecond), SealWord::kClock);
}

TEST_F(Seal, NamesAClockThatDiffersByMoreThanTwoSecondsAndByHowMuch) {
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 35 * kSecond), kNow), SealWord::kClock);
  EXPECT_EQ(check_.clock_off_ns(), 35 * kSecond);
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + 36 * kSecond), kNow + 36 * kSecond),
            SealWord::kGood);
}

TEST_F(Seal, AClockThatIsSetDuringARunStopsNoFramesButEveryCommand) {
  SealCheck commands(Key().For("g:1"), kNow, true);
  const auto first = Sealed(sealer_, kNow + 1);
  EXPECT_EQ(Open(check_, first, kNow + 1), SealWord::kGood);
  EXPECT_EQ(Open(commands, first, kNow + 1), SealWord::kGood);
  // The receiver's clock is set forward by a minute; or a command was held back for as long.
  const auto later = Sealed(sealer_, kNow + kSecond);
  EXPECT_EQ(Open(check_, later, kNow + 61 * kSecond), SealWord::kGood);
  EXPECT_EQ(Open(commands, later, kNow + 61 * kSecond), SealWord::kClock);
}

TEST_F(Seal, NumbersGrowAlsoWhenTheSendersClockStepsBack) {
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow + kSecond), kNow + kSecond), SealWord::kGood);
  EXPECT_EQ(Open(check_, Sealed(sealer_, kNow - 5 * kSecond), kNow + kSecond), SealWord::kGood);
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
    EXPECT_NE(check_.Open(view, kNow), SealWord::kGood);
  }
}

TEST_F(Seal, AllocatesNothing) {
  std::array<std::uint8_t, kSize + kTrailerBytes> buffer{};
  std::uint64_t good = 0;
  const test::AllocationGuard guard;
  for (std::int64_t count = 1; count <= 10'000; ++count) {
    std::span<const std::uint8_t> whole = sealer_.Append(buffer, kSize, kNow + count);
    good += check_.Open(whole, kNow + count) == SealWord::kGood ? 1U : 0U;
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(good, 10'000U);
}

class KeyFile : public testing::Test {
 protected:
  void Write(const std::string& text, mode_t mode = 0600) const {
    std::ofstream(path_) << text;
    chmod(path_.c_str(), mode);
  }
  [[nodiscard]] std::string Refusal() const {
    try {
      static_cast<void>(NetworkKey::Load(path_));
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.status(), ExitStatus::kBadInput);
      return problem.what();
    }
    return "taken";
  }
  test::ScratchFolder folder_;
  std::string path_{folder_ / "key"};
};

const std::string kGoodDigits(64, 'a');

TEST_F(KeyFile, IsMadeForThisUserOnlyAndRead) {
  NetworkKey::Make(path_);
  struct stat facts {};
  ASSERT_EQ(stat(path_.c_str(), &facts), 0);
  EXPECT_EQ(facts.st_mode & 0777U, 0600U);
  EXPECT_EQ(NetworkKey::Load(path_)->path(), path_);
}

TEST_F(KeyFile, IsAnotherEachTimeAndNeverWrittenOver) {
  NetworkKey::Make(path_);
  NetworkKey::Make(path_ + "2");
  const std::array<std::uint8_t, 3> text{1, 2, 3};
  EXPECT_NE(NetworkKey::Load(path_)->For("g").SealOf(text),
            NetworkKey::Load(path_ + "2")->For("g").SealOf(text));
  EXPECT_THROW(NetworkKey::Make(path_), BadInput);
}

TEST_F(KeyFile, ThatOthersMayReadOrWriteIsRefusedWithTheRemedy) {
  for (const mode_t mode : {0644U, 0640U, 0604U, 0620U, 0602U, 0610U}) {
    Write(kGoodDigits, mode);
    EXPECT_THAT(Refusal(), testing::HasSubstr("chmod 600")) << mode;
  }
  for (const mode_t mode : {0600U, 0400U}) {
    Write(kGoodDigits + "\n", mode);
    EXPECT_EQ(Refusal(), "taken");
  }
}

TEST_F(KeyFile, OfAnotherContentIsRefused) {
  for (const std::string& text :
       {std::string(), std::string("a"), kGoodDigits + "a", kGoodDigits.substr(1),
        kGoodDigits.substr(1) + "g", kGoodDigits + "\n\n", std::string(32, '\x5a')}) {
    Write(text);
    EXPECT_THAT(Refusal(), testing::HasSubstr("64 hexadecimal digits")) << text;
  }
}

TEST_F(KeyFile, ThatIsMissingAFolderOrAPipeIsRefused) {
  EXPECT_THAT(Refusal(), testing::HasSubstr("No such file"));
  std::filesystem::create_directory(path_);
  chmod(path_.c_str(), 0700);
  EXPECT_THAT(Refusal(), testing::HasSubstr("not a regular file"));
  std::filesystem::remove(path_);
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_THAT(Refusal(), testing::HasSubstr("not a regular file"));
}

}  // namespace
}  // namespace levitas::transport
