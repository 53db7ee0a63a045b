#include "session/log/recorder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "common/problem.hpp"
#include "session/log/trip_freezer.hpp"
#include "tests/support/waiting.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

std::vector<std::string> TripFiles(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("trip-")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void Trip(cycle::CycleRecord& record, Fault fault = Fault::kOrbitExceeded) {
  record.out.mode = Mode::kTripped;
  record.out.fault = fault;
  record.out.fault_axis = 1;
}

class Recording : public ::testing::Test {
 protected:
  RecorderOptions Options(double window_s = 0.01) {
    RecorderOptions options;
    options.session_path = folder_ / "s.lcmlog";
    options.trip_folder = folder_ / "";
    options.header = Header();
    options.trip_window_s = window_s;
    return options;
  }
  Folder folder_;
};

TEST_F(Recording, HoldsEveryPostedRecordAndTheDerivedEvents) {
  auto records = DrawRecords(2000);
  for (std::size_t i = 1000; i < records.size(); ++i) records[i].out.mode = Mode::kSpinning;
  std::vector<std::string> told;
  std::size_t seen = 0;
  {
    RecorderOptions options = Options();
    options.on_event = [&](const Event& event) { told.push_back(event.text); };
    options.on_record = [&](const cycle::CycleRecord&) { ++seen; };
    Recorder recorder(std::move(options));
    for (const auto& record : records) recorder.Post(record);
    EXPECT_EQ(recorder.lost(), 0U);
  }
  SessionReader reader(folder_ / "s.lcmlog");
  const auto read = ReadAll(reader);
  ASSERT_EQ(read.size(), records.size());
  for (std::size_t i = 0; i < read.size(); ++i) ASSERT_TRUE(SameBits(read[i], records[i]));
  EXPECT_EQ(seen, records.size());
  ASSERT_EQ(reader.events().size(), told.size());
  EXPECT_EQ(told.back(), "levitating -> spinning (cycle 1000)");
  EXPECT_EQ(reader.events().back().text, told.back());
}

TEST_F(Recording, CountsLostRecordsAndRecordsHowMany) {
  const auto records = DrawRecords(40'000);  // more than the ring holds
  std::atomic<bool> go{false};
  std::atomic<std::uint64_t> seen{0};
  std::uint64_t lost = 0;
  {
    RecorderOptions options = Options();
    options.on_record = [&](const cycle::CycleRecord&) {
      while (!go.load()) std::this_thread::yield();  // a disk that does not answer
      ++seen;
    };
    Recorder recorder(std::move(options));
    for (std::size_t i = 0; i + 1 < records.size(); ++i) recorder.Post(records[i]);
    lost = recorder.lost();
    go.store(true);
    EXPECT_TRUE(
        levitas::test::Eventually([&] { return seen.load() + lost >= records.size() - 1; }));
    recorder.Post(records.back());  // after the gap
    EXPECT_EQ(recorder.lost(), lost);
  }
  ASSERT_GT(lost, 0U);
  SessionReader reader(folder_ / "s.lcmlog");
  EXPECT_EQ(ReadAll(reader).size(), records.size() - lost);
  EXPECT_EQ(reader.damage().missing_cycles, lost);
  // Two gaps where the recorder's thread came late and made room for one record before it stuck.
  std::uint64_t told = 0;
  for (const Event& event : reader.events()) {
    if (event.text.find(" record(s) lost") != std::string::npos) told += std::stoull(event.text);
  }
  EXPECT_EQ(told, lost);
}

// The other half of the pair: what waits loses nothing on the same disk.
TEST_F(Recording, LosesNothingWhenTheLoopMayWait) {
  const auto records = DrawRecords(40'000);  // more than the ring holds
  std::atomic<bool> go{false};
  std::atomic<std::uint64_t> posted{0};
  std::uint64_t lost = 0;
  {
    RecorderOptions options = Options();
    options.waits_for_room = true;
    options.on_record = [&](const cycle::CycleRecord&) {
      while (!go.load()) std::this_thread::yield();
    };
    Recorder recorder(std::move(options));
    std::thread loop([&] {
      for (const auto& record : records) {
        recorder.Post(record);
        ++posted;
      }
    });
    EXPECT_TRUE(
        levitas::test::Eventually([&] { return posted.load() >= 32'768; }));  // the ring is full
    EXPECT_LT(posted.load(), records.size());
    go.store(true);
    loop.join();
    lost = recorder.lost();
  }
  EXPECT_EQ(lost, 0U);
  SessionReader reader(folder_ / "s.lcmlog");
  EXPECT_EQ(ReadAll(reader).size(), records.size());
}

TEST_F(Recording, HasTheTripFileOfARunThatEndedInItsWindowOnceFinished) {
  auto records = DrawRecords(520);
  for (std::size_t i = 500; i < records.size(); ++i) Trip(records[i]);
  Recorder recorder(Options(0.05));
  for (const auto& record : records) recorder.Post(record);
  recorder.Finish();
  ASSERT_FALSE(recorder.trip_file().empty());
  SessionReader reader(recorder.trip_file());
  EXPECT_EQ(ReadAll(reader).size(), 520U);
}

TEST_F(Recording, FreezesTheWindowBeforeAndAfterATripToASessionOfItsOwn) {
  auto records = DrawRecords(1000);
  for (std::size_t i = 500; i < records.size(); ++i) Trip(records[i]);
  std::string trip_file;
  {
    Recorder recorder(Options(0.01));  // 100 cycles
    for (const auto& record : records) recorder.Post(record);
    EXPECT_TRUE(levitas::test::Eventually([&] { return !recorder.trip_file().empty(); }));
    trip_file = recorder.trip_file();
  }
  EXPECT_THAT(trip_file, MatchesRegex(".*/trip-[0-9]+T[0-9]+\\.[0-9]+Z-orbit_exceeded\\.lcmlog"));
  SessionReader reader(trip_file);
  const auto read = ReadAll(reader);
  ASSERT_EQ(read.size(), 201U);  // 100 before, the trip, 100 after
  for (std::size_t i = 0; i < read.size(); ++i) {
    ASSERT_TRUE(SameBits(read[i], records[400 + i])) << i;
  }
  EXPECT_EQ(reader.header().excerpt_of, folder_ / "s.lcmlog");
  EXPECT_EQ(reader.header().start_utc_ns, Header().start_utc_ns + 400 * 100'000);
  EXPECT_EQ(reader.header().controller_yaml, Header().controller_yaml);
  ASSERT_EQ(reader.events().size(), 1U);
  EXPECT_EQ(reader.events()[0].severity, Event::Severity::kTrip);
}

TEST_F(Recording, FinishesTheTripFileWhenTheRunEndsWithinTheWindow) {
  auto records = DrawRecords(520);
  for (std::size_t i = 500; i < records.size(); ++i) Trip(records[i]);
  {
    RecorderOptions options = Options(0.05);
    options.session_path.clear();  // a trip freezes even when nothing is recorded
    Recorder recorder(std::move(options));
    for (const auto& record : records) recorder.Post(record);
  }
  const auto files = TripFiles(folder_ / "");
  ASSERT_EQ(files.size(), 1U);
  SessionReader reader(files[0]);
  const auto read = ReadAll(reader);
  ASSERT_EQ(read.size(), 520U);
  EXPECT_EQ(read.back().in.cycle, 519U);
  EXPECT_FALSE(reader.damage().any());
  EXPECT_EQ(reader.header().excerpt_of, "an unrecorded run");
}

TEST_F(Recording, SecondTripWithinTheWindowGetsAFileOfItsOwn) {
  auto records = DrawRecords(600);
  Trip(records[500]);
  Trip(records[520], Fault::kOrbitExceeded);  // 2 ms later
  {
    Recorder recorder(Options(0.01));
    for (const auto& record : records) recorder.Post(record);
  }
  const auto files = TripFiles(folder_ / "");
  ASSERT_EQ(files.size(), 2U);
  SessionReader first(files[0]);
  EXPECT_EQ(ReadAll(first).back().in.cycle, 519U);
  SessionReader second(files[1]);
  EXPECT_EQ(ReadAll(second).size(), 180U);  // 420 .. 599
}

TEST_F(Recording, IsRefusedAtOnceWhenTheDiskIsFull) {
  RecorderOptions options = Options();
  options.session_path = "/dev/full";
  EXPECT_THROW(Recorder(std::move(options)), Problem);
}

TEST_F(Recording, GoesOnWhenTheTripFolderCannotBeWritten) {
  auto records = DrawRecords(300);
  for (std::size_t i = 100; i < records.size(); ++i) Trip(records[i]);
  std::vector<std::string> told;
  {
    RecorderOptions options = Options();
    options.trip_folder = "/dev/null/trips";
    options.on_event = [&](const Event& event) { told.push_back(event.text); };
    Recorder recorder(std::move(options));
    for (const auto& record : records) recorder.Post(record);
  }
  SessionReader reader(folder_ / "s.lcmlog");
  EXPECT_EQ(ReadAll(reader).size(), records.size());
  const auto names_folder = [](const std::string& text) {
    return text.find("/dev/null/trips") != std::string::npos;
  };
  EXPECT_EQ(std::count_if(told.begin(), told.end(), names_folder), 1);
}

TEST_F(Recording, FreezesTheNextTripAfterOneThatCouldNotBeWritten) {
  const std::string trips = folder_ / "trips";
  std::ofstream(trips) << "a file where the folder should be";
  auto records = DrawRecords(1000);
  for (std::size_t i = 100; i < 200; ++i) Trip(records[i]);
  for (std::size_t i = 600; i < 700; ++i) Trip(records[i]);
  std::atomic<bool> failed{false};
  {
    RecorderOptions options = Options();
    options.trip_folder = trips;
    options.on_event = [&](const Event& event) {
      if (event.text.find(trips) != std::string::npos) failed.store(true);
    };
    Recorder recorder(std::move(options));
    for (std::size_t i = 0; i < 500; ++i) recorder.Post(records[i]);
    EXPECT_TRUE(levitas::test::Eventually([&] { return failed.load(); }));
    std::filesystem::remove(trips);
    for (std::size_t i = 500; i < records.size(); ++i) recorder.Post(records[i]);
    recorder.Finish();
    ASSERT_FALSE(recorder.trip_file().empty());
    SessionReader reader(recorder.trip_file());
    const auto read = ReadAll(reader);
    ASSERT_EQ(read.size(), 201U);  // none is missing before the trip
    EXPECT_EQ(read.front().in.cycle, records[500].in.cycle);
  }
}

TEST_F(Recording, GoesOnWhenWhoeverHearsOfRecordsFails) {
  const auto records = DrawRecords(300);
  {
    RecorderOptions options = Options();
    options.on_record = [](const cycle::CycleRecord&) { throw std::runtime_error("meant"); };
    Recorder recorder(std::move(options));
    for (const auto& record : records) recorder.Post(record);
  }
  SessionReader reader(folder_ / "s.lcmlog");
  EXPECT_EQ(ReadAll(reader).size(), records.size());
}

TEST(TripFileName, NamesUtcAndCause) {
  // 1 763 700 301 s after 1970 is 2025-11-21 04:45:01 UTC (date -u -d @1763700301).
  EXPECT_EQ(TripFileName(1'763'700'301'123'000'000, Fault::kOverSpeed),
            "trip-20251121T044501.123Z-over_speed.lcmlog");
}

TEST(TripFreezer, NumbersFilesOfOneMillisecond) {
  const Folder folder;
  for (int run = 0; run < 2; ++run) {
    TripFreezer freezer(folder / "", Header(), 0.001);
    Random draw{1};
    auto record = DrawRecord(draw, 0);
    Trip(record);
    Event trip;
    trip.severity = Event::Severity::kTrip;
    freezer.Take(record, {trip});
    freezer.Finish();
    EXPECT_THAT(freezer.newest(),
                HasSubstr(run == 0 ? "orbit_exceeded.lcmlog" : "orbit_exceeded-2.lcmlog"));
  }
}

}  // namespace
}  // namespace levitas::session
