#include "common/nearest.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace levitas {
namespace {

TEST(EditDistance, CountsSingleCharacterChanges) {
  EXPECT_EQ(EditDistance("", ""), 0U);
  EXPECT_EQ(EditDistance("gap_mm", "gap_mm"), 0U);
  EXPECT_EQ(EditDistance("gap", ""), 3U);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3U);  // Levenshtein's classic
  EXPECT_EQ(EditDistance("gap_mn", "gap_mm"), 1U);
  EXPECT_EQ(EditDistance("bearing", "bearings"), 1U);
}

TEST(EditDistance, IsSymmetric) {
  EXPECT_EQ(EditDistance("clearance", "clear"), EditDistance("clear", "clearance"));
}

TEST(Nearest, FindsTheWordWithTheFewestChanges) {
  const std::vector<std::string> words{"gap_mm", "gap_um", "ki_n_per_a"};
  EXPECT_EQ(Nearest("gap_mmm", words), "gap_mm");
  EXPECT_EQ(Nearest("ki_n_per", words), "ki_n_per_a");
}

TEST(Nearest, TakesTheFirstOfEquals) {
  const std::vector<std::string> words{"ab", "ac"};
  EXPECT_EQ(Nearest("ad", words), "ab");
}

TEST(Nearest, IsEmptyWithoutWordsAndForAParagraph) {
  EXPECT_EQ(Nearest("gap", {}), "");
  const std::vector<std::string> words{"gap_mm"};
  EXPECT_EQ(Nearest(std::string(100000, 'x'), words), "");
}

TEST(Listed, PutsCommasBetween) {
  EXPECT_EQ(Listed({}), "");
  const std::vector<std::string> words{"a", "b", "c"};
  EXPECT_EQ(Listed(words), "a, b, c");
}

TEST(LikelyMeant, NamesATypingErrorAndNothingForAnotherWord) {
  const std::vector<std::string> known{"flexible_rotor", "ufu_rig"};
  EXPECT_EQ(LikelyMeant("flexible_rotr", known), "flexible_rotor");
  EXPECT_EQ(LikelyMeant("nowhere_at_all", known), "");
  EXPECT_EQ(LikelyMeant("x", {}), "");
}

TEST(LikelyMeant, PrefersAWordOfWhichTheBeginningWasTyped) {
  // Three letters make --help of --hold, three more --holdout.
  const std::vector<std::string> options{"--help", "--rig", "--holdout", "--healthy"};
  EXPECT_EQ(LikelyMeant("--hold", options), "--holdout");
  EXPECT_EQ(LikelyMeant("--hea", options), "--healthy");
  EXPECT_EQ(LikelyMeant("--halp", options), "--help");
}

}  // namespace
}  // namespace levitas
