#include "transport/network_key.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/private_file.hpp"
#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::transport {
namespace {

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

TEST_F(KeyFile, OfAnotherUserIsRefusedAlsoWhenItCanBeRead) {
  Write(kGoodDigits);
  constexpr uid_t kForeign = 54'321;
  if (geteuid() != 0 || chown(path_.c_str(), kForeign, kForeign) != 0) {
    GTEST_SKIP() << "only root can give a file away";
  }
  EXPECT_THAT(Refusal(), testing::HasSubstr("belongs to user 54321"));
}

// The rule of the test above, for whoever runs it: this user and root, nobody else.
TEST(PrivateFile, MayBelongToItsReaderOrToRootOnly) {
  struct stat facts {};
  facts.st_mode = S_IFREG | 0600U;
  facts.st_uid = 1000;
  EXPECT_EQ(WhyNotPrivate(facts, 1000, "k"), "");
  EXPECT_EQ(WhyNotPrivate(facts, 1001, "k"), "it belongs to user 1000");
  EXPECT_EQ(WhyNotPrivate(facts, 0, "k"), "it belongs to user 1000");
  facts.st_uid = 0;
  EXPECT_EQ(WhyNotPrivate(facts, 1001, "k"), "");
}

}  // namespace
}  // namespace levitas::transport
