// Several trips in one session, and a trip that falls into records the recorder could not take.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "session/log/recorder.hpp"
#include "session/log/trip_freezer.hpp"
#include "tests/support/waiting.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

class TripSeries : public ::testing::Test {
 protected:
  RecorderOptions Options() {
    RecorderOptions options;
    options.session_path = folder_ / "s.lcmlog";
    options.trip_folder = folder_ / "";
    options.header = Header();
    options.trip_window_s = 0.01;  // 100 cycles
    options.on_event = [this](const Event& event) { told_.push_back(event); };
    return options;
  }
  /// Every file of a trip; their names begin with the time, so the first trip comes first.
  std::vector<std::string> TripFiles() {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "")) {
      if (entry.path().filename().string().starts_with("trip-")) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
  }
  std::size_t TripsTold() const {
    return static_cast<std::size_t>(
        std::count_if(told_.begin(), told_.end(),
                      [](const Event& event) { return event.severity == Event::Severity::kTrip; }));
  }
  Folder folder_;
  std::vector<Event> told_;
};

/// Records with a latched fault in each [from, to) range, levitating outside.
struct Span {
  std::size_t from, to;
  Fault fault;
};
std::vector<cycle::CycleRecord> WithTrips(std::size_t count, const std::vector<Span>& spans) {
  auto records = DrawRecords(count, 31);
  for (const Span& span : spans) {
    for (std::size_t i = span.from; i < span.to; ++i) {
      records[i].out.mode = Mode::kTripped;
      records[i].out.fault = span.fault;
    }
  }
  return records;
}

TEST_F(TripSeries, EachTripOfASessionGetsItsOwnWindowAndTheSessionHoldsAll) {
  const std::vector<Span> trips{{500, 800, Fault::kOrbitExceeded},
                                {1200, 1500, Fault::kEmergencyStop},
                                {2300, 2600, Fault::kOrbitExceeded}};  // the same cause once more
  const auto records = WithTrips(3000, trips);
  {
    Recorder recorder(Options());
    for (const auto& record : records) recorder.Post(record);
  }
  const auto files = TripFiles();
  ASSERT_EQ(files.size(), trips.size());
  for (std::size_t t = 0; t < trips.size(); ++t) {
    EXPECT_THAT(files[t], HasSubstr(std::string(Name(trips[t].fault))));
    SessionReader reader(files[t]);
    const auto read = ReadAll(reader);
    ASSERT_EQ(read.size(), 201U) << t;  // 100 before, the trip, 100 after
    for (std::size_t i = 0; i < read.size(); ++i) {
      ASSERT_TRUE(SameBits(read[i], records[trips[t].from - 100 + i])) << t << " " << i;
    }
    ASSERT_EQ(reader.events().size(), 1U);
    EXPECT_EQ(reader.events()[0].cycle, trips[t].from);
  }
  SessionReader whole(folder_ / "s.lcmlog");
  EXPECT_EQ(ReadAll(whole).size(), records.size());
  EXPECT_FALSE(whole.damage().any());
  EXPECT_EQ(TripsTold(), trips.size());
}

// Somebody who may write to the folder guesses the name: what stands there is neither followed nor
// written over, be it a link to nothing.
TEST_F(TripSeries, WritesThroughNoLinkThatHasTheNameOfATrip) {
  const auto records = WithTrips(800, {{500, 800, Fault::kOverSpeed}});
  const RecorderOptions options = Options();
  const std::string guessed =
      TripFileName(options.header.start_utc_ns + 500 * options.header.period_ns, Fault::kOverSpeed);
  const std::string elsewhere = folder_ / "elsewhere";
  std::filesystem::create_symlink(elsewhere, folder_ / guessed);
  {
    Recorder recorder(Options());
    for (const auto& record : records) recorder.Post(record);
    recorder.Finish();
    EXPECT_NE(recorder.trip_file(), folder_ / guessed);
    SessionReader reader(recorder.trip_file());
    EXPECT_FALSE(ReadAll(reader).empty());
  }
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / guessed));
  EXPECT_FALSE(std::filesystem::exists(elsewhere));
}

TEST_F(TripSeries, RandomSeriesLeaveOneReadableFilePerTrip) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random draw{seed};
    std::vector<Span> trips;
    for (std::size_t at = 1 + draw.Bits() % 300; at < 3500;) {
      const std::size_t length = 1 + draw.Bits() % 250;
      trips.push_back({at, at + length, static_cast<Fault>(1 + draw.Bits() % (kFaultCount - 1))});
      at += length + 1 + draw.Bits() % 250;  // a reset lies between two trips
    }
    const Folder folder;
    RecorderOptions options = Options();
    options.trip_folder = folder / "";
    options.session_path.clear();
    const auto records = WithTrips(4000, trips);
    {
      Recorder recorder(std::move(options));
      for (const auto& record : records) recorder.Post(record);
    }
    std::size_t files = 0;
    std::vector<std::size_t> beginnings;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
      ++files;
      SessionReader reader(entry.path());
      const auto read = ReadAll(reader);
      EXPECT_FALSE(reader.damage().any()) << entry.path();
      ASSERT_FALSE(reader.events().empty()) << entry.path();
      const std::uint64_t trip = reader.events()[0].cycle;
      beginnings.push_back(trip);
      ASSERT_FALSE(read.empty());
      EXPECT_EQ(read.front().in.cycle, trip - std::min<std::uint64_t>(trip, 100)) << seed;
      for (const auto& record : read) ASSERT_TRUE(SameBits(record, records[record.in.cycle]));
    }
    EXPECT_EQ(files, trips.size()) << "seed " << seed;
    std::sort(beginnings.begin(), beginnings.end());
    for (std::size_t t = 0; t < trips.size(); ++t) EXPECT_EQ(beginnings[t], trips[t].from) << seed;
  }
}

TEST_F(TripSeries, ATripAmongLostRecordsIsStillToldAndFrozen) {
  constexpr std::size_t kRing = 32'768;
  constexpr std::size_t kCount = 40'000;
  // The first cycle of the trip lies where the full ring takes nothing any more; the fault stays
  // latched, so the first record behind the gap shows it.
  const auto records = WithTrips(kCount, {{kRing + 3000, kCount, Fault::kOverSpeed}});
  std::atomic<bool> go{false};
  std::atomic<bool> holds{false};
  std::atomic<std::uint64_t> seen{0};
  {
    RecorderOptions options = Options();
    options.on_record = [&](const cycle::CycleRecord&) {
      holds = true;
      while (!go.load()) std::this_thread::yield();  // a disk that does not answer
      ++seen;
    };
    Recorder recorder(std::move(options));
    recorder.Post(records[0]);
    // Taken later, it would leave a place in the full ring for a record of the trip.
    ASSERT_TRUE(levitas::test::Eventually([&] { return holds.load(); }));
    for (std::size_t i = 1; i < kCount - 300; ++i) recorder.Post(records[i]);
    const std::uint64_t lost = recorder.lost();
    ASSERT_GT(lost, 0U);
    go.store(true);
    EXPECT_TRUE(levitas::test::Eventually([&] { return seen.load() + lost >= kCount - 300; }));
    for (std::size_t i = kCount - 300; i < kCount; ++i) recorder.Post(records[i]);
    EXPECT_EQ(recorder.lost(), lost);
  }
  EXPECT_EQ(TripsTold(), 1U);
  const auto files = TripFiles();
  ASSERT_EQ(files.size(), 1U);
  EXPECT_THAT(files[0], HasSubstr("over_speed"));
  SessionReader reader(files[0]);
  const auto read = ReadAll(reader);
  ASSERT_EQ(read.size(), 101U);  // nothing before: those records are lost; the rest of the window
  EXPECT_EQ(read.front().in.cycle, kCount - 300);
  EXPECT_FALSE(reader.damage().any());
}

}  // namespace
}  // namespace levitas::session
