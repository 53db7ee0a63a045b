#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lcm/eventlog.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "common/output_file.hpp"
#include "common/problem.hpp"
#include "levitas_msg/cycle_record_t.hpp"
#include "levitas_msg/session_header_t.hpp"
#include "session/log/output_path.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

TEST(SessionFile, GivesBackEveryRecordBitForBit) {
  const Folder folder;
  auto records = DrawRecords(500);
  records[7].in.frame.position_m[2] = std::numeric_limits<double>::quiet_NaN();
  records[8].out.current.control_current_a[1] = -0.0;
  records[9].in.frame_present = false;
  records[10].in.op = {
      .command = OperatorCommand::kSpin, .speed_rad_per_s = 300.0, .acceleration_rad_per_s2 = 20.0};
  records[11].in.missed_deadlines = 4'000'000'000U;
  records[12].in.frame.rig_status = kRigAmplifiersOff;
  records[13].out.mode = Mode::kTripped;
  records[13].out.fault = Fault::kOrbitExceeded;
  records[13].out.fault_axis = 2;
  records[13].out.fault_value = 1e-4;
  records[13].out.fault_limit = 9e-5;
  records[14].out.command_refused = true;
  records[14].out.current.drive_enabled = false;
  records[15].out.saturated_axes = 0x8001U;
  WriteSession(folder / "s.lcmlog", records);

  SessionReader reader(folder / "s.lcmlog");
  const auto read = ReadAll(reader);
  ASSERT_EQ(read.size(), records.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    ASSERT_TRUE(SameBits(read[i], records[i])) << "record " << i;
  }
  EXPECT_FALSE(reader.damage().any());
  EXPECT_EQ(reader.damage().Text(), "");
}

TEST(SessionFile, GivesBackTheHeader) {
  const Folder folder;
  SessionHeader header = Header();
  header.rig_yaml = std::string(100'000, 'r');
  header.excerpt_of = "whole.lcmlog";
  WriteSession(folder / "s.lcmlog", {}, header);
  const SessionReader reader(folder / "s.lcmlog");
  EXPECT_EQ(reader.header().rig_yaml, header.rig_yaml);
  EXPECT_EQ(reader.header().controller_yaml, header.controller_yaml);
  EXPECT_EQ(reader.header().scenario_yaml, "");
  EXPECT_EQ(reader.header().pace, "lockstep");
  EXPECT_EQ(reader.header().seed, 7);
  EXPECT_EQ(reader.header().period_ns, 100'000);
  EXPECT_EQ(reader.header().start_utc_ns, header.start_utc_ns);
  EXPECT_EQ(reader.header().machine, "test machine");
  EXPECT_EQ(reader.header().source, "lcm");
  EXPECT_EQ(reader.header().program_version, "0.1.0");
  EXPECT_EQ(reader.header().channels, header.channels);
  EXPECT_EQ(reader.header().excerpt_of, "whole.lcmlog");
}

TEST(SessionFile, KeepsEventsBesideTheRecords) {
  const Folder folder;
  const auto records = DrawRecords(2);
  {
    SessionWriter writer(folder / "s.lcmlog", Header());
    writer.Write(records[0]);
    writer.Write(Event{.cycle = 12,
                       .time_ns = 34,
                       .severity = Event::Severity::kTrip,
                       .mode = Mode::kTripped,
                       .fault = Fault::kOverSpeed,
                       .axis = -1,
                       .value = 1.5,
                       .limit = 1.25,
                       .text = "too fast"});
    writer.Write(records[1]);
  }
  SessionReader reader(folder / "s.lcmlog");
  EXPECT_EQ(ReadAll(reader).size(), 2U);
  ASSERT_EQ(reader.events().size(), 1U);
  const Event& event = reader.events()[0];
  EXPECT_EQ(event.cycle, 12U);
  EXPECT_EQ(event.time_ns, 34);
  EXPECT_EQ(event.severity, Event::Severity::kTrip);
  EXPECT_EQ(event.mode, Mode::kTripped);
  EXPECT_EQ(event.fault, Fault::kOverSpeed);
  EXPECT_EQ(event.axis, -1);
  EXPECT_EQ(event.value, 1.5);
  EXPECT_EQ(event.limit, 1.25);
  EXPECT_EQ(event.text, "too fast");
}

// LCM's own reader and the generated types are what lcm-logplayer and other tools are made of.
TEST(SessionFile, IsReadByLcmsOwnLogReader) {
  const Folder folder;
  const auto records = DrawRecords(300);
  WriteSession(folder / "s.lcmlog", records);
  lcm_eventlog_t* log = lcm_eventlog_create((folder / "s.lcmlog").c_str(), "r");
  ASSERT_NE(log, nullptr);
  std::size_t cycles = 0;
  std::size_t headers = 0;
  std::int64_t previous_us = 0;
  std::int64_t number = 0;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    EXPECT_EQ(event->eventnum, number++);
    EXPECT_GE(event->timestamp, previous_us);
    previous_us = event->timestamp;
    const std::string channel(event->channel, static_cast<std::size_t>(event->channellen));
    if (channel == "LEVITAS_HEADER") {
      levitas_msg::session_header_t message;
      ASSERT_EQ(message.decode(event->data, 0, event->datalen), event->datalen);
      EXPECT_EQ(message.channel[3], "nde_y");
      ++headers;
    } else {
      ASSERT_EQ(channel, "LEVITAS_CYCLE");
      levitas_msg::cycle_record_t message;
      ASSERT_EQ(message.decode(event->data, 0, event->datalen), event->datalen);
      EXPECT_EQ(message.position_m[2], records[cycles].in.frame.position_m[2]);
      // Period 100 us from the header's start.
      EXPECT_EQ(event->timestamp,
                Header().start_utc_ns / 1000 + 100 * static_cast<std::int64_t>(cycles));
      ++cycles;
    }
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(log);
  EXPECT_EQ(cycles, 300U);
  EXPECT_EQ(headers, 2U);  // the first event, and the copy at the end
}

TEST(SessionFile, IsRefusedWhenItCannotBeCreated) {
  try {
    const SessionWriter writer("/nonexistent/folder/s.lcmlog", Header());
    FAIL();
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("/nonexistent/folder/s.lcmlog"));
    EXPECT_THAT(problem.what(), HasSubstr("No such file"));
  }
}

TEST(SessionFile, TellsAFullDisk) {
  try {
    const SessionWriter writer("/dev/full", Header());  // every write fails with ENOSPC
    FAIL();
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kOther);
    EXPECT_THAT(problem.what(), HasSubstr("No space left"));
  }
}

// As root a rename over a device would put a file in its place, for every program of the machine.
TEST(PartFile, NeverTakesTheNameOfADevice) {
  const std::filesystem::file_status before = std::filesystem::status("/dev/full");
  {
    PartFile part("/dev/full");
    EXPECT_EQ(part.part_path(), "/dev/full");
    part.Commit();
  }
  { const PartFile abandoned("/dev/full"); }
  EXPECT_EQ(std::filesystem::status("/dev/full").type(), before.type());
  EXPECT_EQ(before.type(), std::filesystem::file_type::character);
}

TEST(PartFile, AppearsUnderItsNameOnlyWhenCommitted) {
  const Folder folder;
  const std::string path = folder / "out.csv";
  {
    const PartFile abandoned(path);
    std::ofstream(abandoned.part_path()) << "half";
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  PartFile part(path);
  std::ofstream(part.part_path()) << "whole";
  part.Commit();
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
}

TEST(SessionFile, IsReadableWhileItIsStillWritten) {
  const Folder folder;
  const auto records = DrawRecords(20);
  SessionWriter writer(folder / "s.lcmlog", Header());
  for (const auto& record : records) writer.Write(record);
  writer.Flush();
  SessionReader reader(folder / "s.lcmlog");
  EXPECT_EQ(ReadAll(reader).size(), 20U);
  EXPECT_FALSE(reader.damage().any());
}

}  // namespace
}  // namespace levitas::session
