// The last accepted session of a rig, which a doubtful record is compared with.

#include "cli/study/healthy_session.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "session/exchange/csv_import.hpp"
#include "session/log/session_reader.hpp"
#include "session_index/catalogue.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

class HealthySessionTest : public testing::Test {
 protected:
  HealthySessionTest()
      : rig_(configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"))) {
    setenv("LEVITAS_CATALOGUE", Catalogue().c_str(), 1);
  }
  // None, as for every test: what is forgotten here would be the catalogue of whoever tests.
  ~HealthySessionTest() override { setenv("LEVITAS_CATALOGUE", "", 1); }

  [[nodiscard]] std::string Catalogue() const { return folder_ / "sessions.db"; }

  /// A session without a sample: its header is all that is read.
  std::string Session(const std::string& name, const configuration::RigFile& rig) {
    session::ImportOptions options;
    options.out_path = folder_ / name;
    options.start_utc_ns = 100;
    options.rig = rig.numbers;
    options.rig_yaml = configuration::WriteRig(rig);
    session::WriteImport(options, [](const session::RecordTaker&) {});
    return options.out_path;
  }

  /// Enters it as begun at that time.
  void Enter(const std::string& path, std::int64_t start_utc_ns,
             const std::string& outcome = "accepted") {
    session_index::Entry entry;
    entry.path = path;
    entry.start_utc_ns = start_utc_ns;
    entry.rig = rig_.numbers.name;
    entry.outcome = outcome;
    session_index::Catalogue(Catalogue()).Put(entry);
  }

  test::ScratchFolder folder_;
  configuration::RigFile rig_;
};

TEST_F(HealthySessionTest, IsTheNewestThatWasAccepted) {
  EXPECT_EQ(LastAcceptedSession(rig_, {}), "") << "there is no catalogue";
  const std::string older = Session("older.lcm", rig_);
  const std::string newer = Session("newer.lcm", rig_);
  const std::string tripped = Session("tripped.lcm", rig_);
  Enter(newer, 2);
  Enter(older, 1);
  Enter(tripped, 3, "tripped");
  EXPECT_EQ(LastAcceptedSession(rig_, {}), newer);
}

TEST_F(HealthySessionTest, IsNoneOfTheRecordsThemselves) {
  const std::string older = Session("older.lcm", rig_);
  const std::string record = Session("record.lcm", rig_);
  Enter(older, 1);
  Enter(record, 2);
  EXPECT_EQ(LastAcceptedSession(rig_, {record}), older);
}

TEST_F(HealthySessionTest, BeganBeforeTheRecords) {
  const std::string record = Session("record.lcm", rig_);
  const std::int64_t began_ns = session::SessionReader(record).header().start_utc_ns;
  Enter(Session("later.lcm", rig_), began_ns + 1);
  EXPECT_EQ(LastAcceptedSession(rig_, {record}), "");
  const std::string before = Session("before.lcm", rig_);
  Enter(before, began_ns - 1);
  EXPECT_EQ(LastAcceptedSession(rig_, {record}), before);
}

TEST_F(HealthySessionTest, IsThereAndOfARigWithTheSameChannelsAndPeriod) {
  const std::string gone = Session("gone.lcm", rig_);
  Enter(gone, 4);
  std::filesystem::remove(gone);
  // A rig of the same name with other channels.
  Enter(Session("pump.lcm",
                configuration::LoadRig(configuration::FindConfig("turbomolecular_pump", "rigs"))),
        3);
  EXPECT_EQ(LastAcceptedSession(rig_, {}), "");
  const std::string same = Session("same.lcm", rig_);
  Enter(same, 2);
  EXPECT_EQ(LastAcceptedSession(rig_, {}), same);
}

}  // namespace
}  // namespace levitas::cli
