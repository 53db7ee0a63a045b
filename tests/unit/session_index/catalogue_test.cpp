#include "session_index/catalogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::session_index {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kDayNs = 86'400'000'000'000;

class CatalogueTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string File() const { return folder_ / "below/sessions.db"; }

  static Entry Run(const std::string& path, std::int64_t start_utc_ns,
                   const std::string& rig = "flexible_rotor",
                   const std::string& outcome = "accepted") {
    Entry entry;
    entry.path = path;
    entry.start_utc_ns = start_utc_ns;
    entry.rig = rig;
    entry.outcome = outcome;
    return entry;
  }

  static std::vector<std::string> Paths(const std::vector<Entry>& entries) {
    std::vector<std::string> paths;
    for (const Entry& entry : entries) paths.push_back(entry.path);
    return paths;
  }

  test::ScratchFolder folder_;
};

TEST_F(CatalogueTest, GivesBackAllThatWasEnteredFromAnotherConnection) {
  Entry entry = Run("/data/run 1 'quoted'.lcm", 1'700'000'000'123'456'789);
  entry.size_byte = 40'000'000'000;
  entry.duration_s = 12.0826;
  entry.cycles = 120'826;
  entry.controller = "commissioned";
  entry.scenario = "default";
  entry.pace = "lockstep";
  entry.port = "can:can0,can1";
  entry.program_version = "0.1.0";
  entry.sentence = "ACCEPTED: 5.2 µm";
  entry.damage = "the file ends inside a record";
  entry.top_speed_rad_per_s = 314.159;
  entry.tags = {"b", "a"};
  Catalogue(File()).Put(entry);

  const std::vector<Entry> found = Catalogue(File()).Find({});
  ASSERT_EQ(found.size(), 1u);
  const Entry& got = found.front();
  EXPECT_EQ(got.path, entry.path);
  EXPECT_EQ(got.size_byte, entry.size_byte);
  EXPECT_EQ(got.start_utc_ns, entry.start_utc_ns);
  EXPECT_EQ(got.duration_s, entry.duration_s);
  EXPECT_EQ(got.cycles, entry.cycles);
  EXPECT_EQ(got.rig, entry.rig);
  EXPECT_EQ(got.controller, entry.controller);
  EXPECT_EQ(got.scenario, entry.scenario);
  EXPECT_EQ(got.pace, entry.pace);
  EXPECT_EQ(got.port, entry.port);
  EXPECT_EQ(got.program_version, entry.program_version);
  EXPECT_EQ(got.outcome, entry.outcome);
  EXPECT_EQ(got.sentence, entry.sentence);
  EXPECT_EQ(got.damage, entry.damage);
  EXPECT_EQ(got.top_speed_rad_per_s, entry.top_speed_rad_per_s);
  EXPECT_THAT(got.tags, ElementsAre("a", "b"));
}

TEST_F(CatalogueTest, RenewsASessionAndKeepsItsTags) {
  Catalogue catalogue(File());
  catalogue.Put(Run("/a", 1));
  EXPECT_TRUE(catalogue.AddTag("/a", "baseline"));
  Entry again = Run("/a", 2, "ufu_rig", "tripped");
  again.tags = {"second"};
  catalogue.Put(again);
  const auto found = catalogue.Find({});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].rig, "ufu_rig");
  EXPECT_EQ(found[0].outcome, "tripped");
  EXPECT_THAT(found[0].tags, ElementsAre("baseline", "second"));
}

TEST_F(CatalogueTest, ListsTheNewestFirst) {
  Catalogue catalogue(File());
  catalogue.Put(Run("/old", 1));
  catalogue.Put(Run("/new", 3));
  catalogue.Put(Run("/middle", 2));
  EXPECT_THAT(Paths(catalogue.Find({})), ElementsAre("/new", "/middle", "/old"));
}

TEST_F(CatalogueTest, FindsByRigOutcomeTagsTextAndTime) {
  Catalogue catalogue(File());
  Entry a = Run("/lab/a", 0, "flexible_rotor", "accepted");
  a.tags = {"x", "y"};
  a.controller = "soft";
  Entry b = Run("/lab/b", kDayNs, "flexible_rotor", "tripped");
  b.tags = {"x"};
  b.port = "can:can0";
  const Entry c = Run("/home/c%", 2 * kDayNs, "ufu_rig", "tripped");
  for (const Entry& entry : {a, b, c}) catalogue.Put(entry);

  const auto find = [&](const Filter& filter) { return Paths(catalogue.Find(filter)); };
  EXPECT_THAT(find({.rig = "flexible_rotor"}), ElementsAre("/lab/b", "/lab/a"));
  EXPECT_THAT(find({.outcome = "tripped"}), ElementsAre("/home/c%", "/lab/b"));
  EXPECT_THAT(find({.rig = "flexible_rotor", .outcome = "tripped"}), ElementsAre("/lab/b"));
  EXPECT_THAT(find({.tags = {"x"}}), ElementsAre("/lab/b", "/lab/a"));
  EXPECT_THAT(find({.tags = {"x", "y"}}), ElementsAre("/lab/a"));
  EXPECT_THAT(find({.text = "soft"}), ElementsAre("/lab/a"));
  EXPECT_THAT(find({.text = "can0"}), ElementsAre("/lab/b"));
  // A text is a text: % and _ stand for themselves.
  EXPECT_THAT(find({.text = "%"}), ElementsAre("/home/c%"));
  EXPECT_THAT(find({.text = "_a_"}), IsEmpty());
  // From is inside, before is outside.
  EXPECT_THAT(find({.from_utc_ns = kDayNs, .before_utc_ns = 2 * kDayNs}), ElementsAre("/lab/b"));
  EXPECT_THAT(find({.rig = "x' OR '1'='1"}), IsEmpty());
}

TEST_F(CatalogueTest, TakesTagsAndSessionsAway) {
  Catalogue catalogue(File());
  Entry entry = Run("/a", 1);
  entry.tags = {"one", "two"};
  catalogue.Put(entry);
  EXPECT_TRUE(catalogue.RemoveTag("/a", "one"));
  EXPECT_FALSE(catalogue.RemoveTag("/a", "one"));
  EXPECT_THAT(catalogue.Find({}).at(0).tags, ElementsAre("two"));
  EXPECT_TRUE(catalogue.Forget("/a"));
  EXPECT_FALSE(catalogue.Forget("/a"));
  EXPECT_FALSE(catalogue.AddTag("/a", "three"));
  EXPECT_THAT(catalogue.Find({}), IsEmpty());
  // What was forgotten comes back without its old tags.
  catalogue.Put(Run("/a", 1));
  EXPECT_THAT(catalogue.Find({}).at(0).tags, IsEmpty());
}

TEST_F(CatalogueTest, TakesWhatSeveralProgramsEnterAtOnce) {
  constexpr int kWriters = 4;
  constexpr int kEach = 10;
  {
    std::vector<std::jthread> writers;
    for (int writer = 0; writer < kWriters; ++writer) {
      writers.emplace_back([this, writer] {
        for (int i = 0; i < kEach; ++i) {
          Catalogue(File()).Put(Run("/" + std::to_string(writer) + "/" + std::to_string(i), i));
        }
      });
    }
  }
  EXPECT_EQ(Catalogue(File()).Find({}).size(), static_cast<std::size_t>(kWriters * kEach));
}

TEST_F(CatalogueTest, RefusesAFileThatIsNoCatalogueAndLeavesItAsItIs) {
  const std::string path = folder_ / "notes.txt";
  const std::string content(4096, 'n');
  std::ofstream(path) << content;
  try {
    const Catalogue catalogue(path);
    FAIL() << "opened";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("notes.txt"));
    EXPECT_THAT(problem.what(), HasSubstr("LEVITAS_CATALOGUE"));
  }
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), content);
}

TEST_F(CatalogueTest, RefusesTheFormatOfANewerProgram) {
  { const Catalogue made(File()); }
  sqlite3* connection = nullptr;
  ASSERT_EQ(sqlite3_open(File().c_str(), &connection), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(connection, "PRAGMA user_version = 2", nullptr, nullptr, nullptr),
            SQLITE_OK);
  sqlite3_close(connection);
  try {
    const Catalogue catalogue(File());
    FAIL() << "opened";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("format 2"));
    EXPECT_THAT(problem.what(), HasSubstr("knows 1"));
  }
}

TEST_F(CatalogueTest, SaysWhereItCannotBeMade) {
  EXPECT_THROW(Catalogue("/proc/no such folder/sessions.db"), BadInput);
}

}  // namespace
}  // namespace levitas::session_index
