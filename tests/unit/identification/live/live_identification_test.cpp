// The recursion fed with a controller's messages: as they come from the network, and of a session.
#include "identification/live/live_identification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "identification/live/convergence_message.hpp"
#include "identification/live/play_session.hpp"
#include "lcmtypes/checked_decode.hpp"
#include "session/log/record_codec.hpp"
#include "session/log/session_writer.hpp"
#include "tests/support/scratch_folder.hpp"
#include "transport/lcm_network.hpp"
#include "transport/sample_batcher.hpp"

#include <levitas_msg/controller_state_t.hpp>

namespace levitas::identification {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint64_t kLevitatedFrom = 300;
constexpr std::uint64_t kRows = 1500;
constexpr std::uint64_t kStateEvery = 100;  // of a loop of 10 kHz

configuration::RigFile OneAxis() {
  return configuration::LoadRig(configuration::FindConfig("one_axis", "rigs"));
}

session::SessionHeader Header(std::int64_t start_utc_ns = 1) {
  const configuration::RigFile rig = OneAxis();
  session::SessionHeader header;
  header.rig_yaml = configuration::WriteRig(rig);
  header.channels = rig.numbers.channels;
  header.period_ns = rig.numbers.period_ns;
  header.start_utc_ns = start_utc_ns;
  return header;
}

/// One axis in its loop with a test signal: before kLevitatedFrom it is being lifted, wildly.
std::vector<cycle::CycleRecord> Records() {
  std::mt19937_64 random(61);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<cycle::CycleRecord> records(kRows);
  double x = 0.0;
  double v = 0.0;
  for (std::uint64_t k = 0; k < kRows; ++k) {
    cycle::CycleRecord& record = records[k];
    record.in.cycle = k;
    record.in.frame_present = true;
    record.in.frame.cycle = k;
    record.in.frame.axes = 1;
    record.out.current.axes = 1;
    const bool held = k >= kLevitatedFrom;
    record.out.mode = held ? Mode::kLevitating : Mode::kLift;
    record.in.frame.position_m[0] = x + 1e-7 * normal(random);
    const double u = held ? -2000.0 * x - 3.0 * v + 0.05 * normal(random) : normal(random);
    record.out.current.control_current_a[0] = u;
    v += 1e-4 * (80.0 * u + 8e4 * x);
    x += 1e-4 * v;
    if (k + 1 == kLevitatedFrom) x = v = 0.0;
  }
  return records;
}

LiveOptions Options() {
  LiveOptions options;
  options.model.order = 2;
  options.model.noise_order = 1;
  options.model.degree = 2;
  options.window_s = 0.02;
  return options;
}

struct Message {
  const char* channel;
  Bytes payload;
};

Bytes HeaderBytes(const session::SessionHeader& header) {
  Bytes bytes;
  session::EncodeHeader(header, bytes);
  return bytes;
}

Bytes StateBytes(const cycle::CycleRecord& record) {
  levitas_msg::controller_state_t state{};
  state.cycle = static_cast<std::int64_t>(record.in.cycle);
  state.mode = static_cast<std::int8_t>(record.out.mode);
  Bytes bytes(static_cast<std::size_t>(state.getEncodedSize()));
  state.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// What the controller sends of the records: batches and states.
struct Sent {
  std::vector<Message> batches, states;
};

Sent SentOf(const std::vector<cycle::CycleRecord>& records) {
  namespace names = transport::channel;
  Sent sent;
  transport::SampleBatcher batcher(1, [&](Bytes batch) {
    sent.batches.push_back({names::kSamples, std::move(batch)});
  });
  for (const cycle::CycleRecord& record : records) {
    batcher.Add(record, static_cast<std::int64_t>(record.in.cycle) * 100'000);
    if (record.in.cycle % kStateEvery == 0) {
      sent.states.push_back({names::kState, StateBytes(record)});
    }
  }
  return sent;
}

void Take(LiveIdentification& live, const std::vector<Message>& messages) {
  for (const Message& message : messages) live.Take(message.channel, message.payload);
}

void TakeHeader(LiveIdentification& live, std::int64_t start_utc_ns = 1) {
  live.Take(transport::channel::kHeader, HeaderBytes(Header(start_utc_ns)));
}

const Eigen::MatrixXd& Theta(const LiveIdentification& live) {
  return live.recursion()->model()->theta;
}

TEST(LiveIdentification, GivesTheParametersOfTheSessionBitForBitInWhateverOrderMessagesCome) {
  const std::vector<cycle::CycleRecord> records = Records();
  const test::ScratchFolder folder;
  const std::string path = folder / "run.lcm";
  {
    session::SessionWriter writer(path, Header());
    for (const cycle::CycleRecord& record : records) writer.Write(record);
    writer.Close();
  }
  LiveIdentification recorded(Options());
  session::SessionReader reader(path);
  recorded.Take(reader.header());
  PlaySession(reader, recorded);

  const Sent sent = SentOf(records);
  LiveIdentification states_late(Options());
  TakeHeader(states_late);
  Take(states_late, sent.batches);
  Take(states_late, sent.states);
  LiveIdentification batches_late(Options());
  TakeHeader(batches_late);
  for (std::size_t i = 0; i < std::max(sent.batches.size(), sent.states.size()); ++i) {
    if (i < sent.batches.size()) Take(batches_late, {sent.batches[i]});
    if (i < sent.states.size()) Take(batches_late, {sent.states[i]});
  }

  EXPECT_GT(recorded.recursion()->counts().learnt, 1000U);
  EXPECT_GT(Theta(recorded).norm(), 0.1);
  EXPECT_EQ(Theta(states_late), Theta(recorded));
  EXPECT_EQ(Theta(batches_late), Theta(recorded));
  EXPECT_EQ(states_late.recursion()->last_cycle(), recorded.recursion()->last_cycle());
}

TEST(LiveIdentification, LearnsFromALevitatedRotorAlone) {
  const Sent sent = SentOf(Records());
  LiveIdentification live(Options());
  TakeHeader(live);
  Take(live, sent.states);
  Take(live, sent.batches);
  EXPECT_EQ(live.recursion()->first_cycle(), kLevitatedFrom);
  EXPECT_EQ(live.recursion()->counts().gaps, 0U);
}

TEST(LiveIdentification, CountsALostBatchAsAGap) {
  Sent sent = SentOf(Records());
  sent.batches.erase(sent.batches.begin() + 6);
  std::vector<std::uint64_t> gaps;
  LiveIdentification* told = nullptr;
  LiveIdentification live(Options(), [&](const ConvergencePoint& point) {
    gaps.push_back(told->recursion()->counts().gaps);
    EXPECT_TRUE(std::isfinite(point.change));
  });
  told = &live;
  TakeHeader(live);
  Take(live, sent.states);
  Take(live, sent.batches);
  const RowCounts& counts = live.recursion()->counts();
  EXPECT_EQ(counts.gaps, 1U);
  EXPECT_EQ(counts.missing, transport::SampleBatcher::kBatch);
  ASSERT_FALSE(gaps.empty());
  EXPECT_EQ(gaps.front(), 0U);
  EXPECT_EQ(gaps.back(), 1U);
}

TEST(LiveIdentification, EndsWithTheHeaderOfAnotherRun) {
  const Sent sent = SentOf(Records());
  LiveIdentification live(Options());
  TakeHeader(live);
  TakeHeader(live);  // the same, as every second
  Take(live, sent.states);
  Take(live, sent.batches);
  EXPECT_FALSE(live.ended());
  const std::uint64_t learnt = live.recursion()->counts().learnt;
  TakeHeader(live, 2);
  EXPECT_TRUE(live.ended());
  Take(live, sent.batches);
  EXPECT_EQ(live.recursion()->counts().learnt, learnt);
}

TEST(LiveIdentification, RefusesABatchOfOtherAxesAndBytesThatAreNoMessage) {
  LiveIdentification live(Options());
  TakeHeader(live);
  levitas_msg::sample_batch_t batch{};
  batch.axes = 2;
  batch.samples = 1;
  batch.values = 2;
  batch.position_m = batch.control_current_a = {0.0F, 0.0F};
  batch.speed_rad_per_s = batch.angle_rad = {0.0F};
  Bytes bytes(static_cast<std::size_t>(batch.getEncodedSize()));
  batch.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  live.Take(transport::channel::kSamples, bytes);
  live.Take(transport::channel::kState, Bytes{1, 2, 3});
  EXPECT_EQ(live.refused(), 2U);
}

TEST(LiveIdentification, AsksForAsManySensorsAsTheRigHasAxesAndSaysWhatTheyAreRefusedWith) {
  Eigen::Index asked = 0;
  LiveOptions options = Options();
  options.sensors = [&](Eigen::Index axes) -> std::vector<SensorCharacteristic> {
    asked = axes;
    throw Problem(ExitStatus::kUsage, "one number for each");
  };
  LiveIdentification live(options);
  EXPECT_THROW(TakeHeader(live), Problem);
  EXPECT_EQ(asked, 1);
}

TEST(LiveIdentification, APointBecomesAMessageThatSaysTheSame) {
  const Sent sent = SentOf(Records());
  std::optional<levitas_msg::convergence_t> newest;
  LiveIdentification* told = nullptr;
  LiveIdentification live(Options(), [&](const ConvergencePoint& point) {
    newest = ConvergenceMessage(*told, point);
    EXPECT_EQ(newest->change, point.change);
    EXPECT_EQ(newest->converged != 0, point.converged);
    EXPECT_EQ(newest->error_rms_m, std::vector<double>{point.error_rms[0]});
  });
  told = &live;
  TakeHeader(live);
  Take(live, sent.states);
  Take(live, sent.batches);
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->start_utc_ns, 1);
  Bytes bytes(static_cast<std::size_t>(newest->getEncodedSize()));
  newest->encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  levitas_msg::convergence_t read{};
  EXPECT_TRUE(message::DecodeChecked(bytes, read));
}

}  // namespace
}  // namespace levitas::identification
