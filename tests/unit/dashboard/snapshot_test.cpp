#include "dashboard/snapshot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "announced_run.hpp"
#include "session/log/block_events.hpp"

namespace levitas::dashboard {
namespace {

namespace channel = transport::channel;
using nlohmann::json;

levitas_msg::sample_batch_t FourAxes(std::int64_t first_cycle, std::int32_t samples,
                                     float value_m) {
  levitas_msg::sample_batch_t batch{};
  batch.first_cycle = first_cycle;
  batch.axes = 4;
  batch.samples = samples;
  batch.values = 4 * samples;
  batch.position_m.assign(static_cast<std::size_t>(batch.values), value_m);
  batch.control_current_a.assign(static_cast<std::size_t>(batch.values), 0.25F);
  batch.speed_rad_per_s.assign(static_cast<std::size_t>(samples), 10.0F);
  batch.angle_rad.assign(static_cast<std::size_t>(samples), 0.0F);
  return batch;
}

class Snapshot : public testing::Test {
 protected:
  void SetUp() override { run_.Take(channel::kHeader, EncodedHeader(1), 0); }
  LiveRun run_;
};

TEST_F(Snapshot, TellsThePageWhatItNeedsToDraw) {
  const json rig = json::parse(RigJson(run_, 42));
  EXPECT_EQ(rig["server"], 42);
  EXPECT_EQ(rig["channels"].size(), 4U);
  EXPECT_EQ(rig["bearings"].size(), 2U);
  EXPECT_EQ(rig["clearance_m"].get<double>(), run_.rig()->clearance_m);
  EXPECT_EQ(rig["period_s"].get<double>(), 1e-4);
}

TEST_F(Snapshot, IsValidBeforeAnythingIsKnown) {
  LiveRun nothing;
  EXPECT_EQ(json::parse(RigJson(nothing, 1))["run"], 0);
  EXPECT_EQ(json::parse(TickJson(nothing, 0))["silent"], true);
  EXPECT_TRUE(json::accept(TimingJson(nothing)));
}

TEST_F(Snapshot, ShowsTheStateInWordsAndTheSpeedInRevolutions) {
  run_.Take(channel::kState, Encoded(TrippedState()), 0);
  const json tick = json::parse(TickJson(run_, 0));
  EXPECT_EQ(tick["silent"], false);
  EXPECT_EQ(tick["mode"], "tripped");
  EXPECT_EQ(tick["fault"], "over_speed");
  EXPECT_EQ(tick["speed_rpm"], 3000);  // 100 pi rad/s
}

TEST_F(Snapshot, SaysThatAControllerIsSilentAfterASecond) {
  run_.Take(channel::kState, Encoded(TrippedState()), 0);
  EXPECT_EQ(json::parse(TickJson(run_, 1'000'000'000))["silent"], false);
  EXPECT_EQ(json::parse(TickJson(run_, 1'000'000'001))["silent"], true);
}

TEST_F(Snapshot, IsBoundedHoweverFastTheLoopRuns) {
  for (int i = 0; i < 200; ++i) {
    run_.Take(channel::kSamples, Encoded(FourAxes(i * 512, 512, 1e-6F)), 0);
  }
  const json tick = json::parse(TickJson(run_, 0));
  EXPECT_EQ(tick["t_ms"].size(), kTickEnvelopes);
  EXPECT_EQ(tick["position_nm"].at(3).size(), 2 * kTickEnvelopes);
  EXPECT_LE(tick["orbit_nm"].at(1).size(), 2 * kOrbitPoints);
  EXPECT_EQ(tick["position_nm"].at(0).at(0), 1000);
  EXPECT_EQ(tick["current_ma"].at(0).at(0), 250);
}

TEST_F(Snapshot, ShowsAReadingThatIsNoNumberAsNull) {
  run_.Take(channel::kSamples, Encoded(FourAxes(0, 256, std::nanf(""))), 0);
  run_.Take(channel::kState, Encoded(TrippedState()), 0);
  const json tick = json::parse(TickJson(run_, 0));
  EXPECT_TRUE(tick["orbit_nm"].at(0).at(0).is_null());
  EXPECT_TRUE(tick["position_nm"].at(0).at(0).is_null());
}

TEST_F(Snapshot, WritesAmplitudesInTenthsOfANanometre) {
  const FullSpectrum spectrum{2.5, 2.5, 1.5, 10.0, {{1e-9, 2e-6, 0.0}}};
  const json written = json::parse(SpectrumJson(spectrum));
  EXPECT_EQ(written["amplitude_dnm"], json::parse("[[10,20000,0]]"));
  EXPECT_EQ(written["t_ms"], 1500);
}

TEST_F(Snapshot, WritesWhatTurnsOncePerRevolutionAsAmplitudeAndPhaseOfEachAxis) {
  const FullSpectrum spectrum{2.5, 2.5, 1.5, 10.0, {{0.0}}};
  const json turning = json::parse(SpectrumJson(spectrum, {{5e-6, 0.0}, {0.0, -2e-6}}));
  EXPECT_EQ(turning["first_order_nm"], json::parse("[5000,2000]"));
  EXPECT_EQ(turning["first_order_ddeg"], json::parse("[0,-900]"));
  EXPECT_FALSE(json::parse(SpectrumJson(spectrum)).contains("first_order_nm"));
}

TEST_F(Snapshot, SaysAtWhichPointsOfTheOrbitTheKeyPhasorPassed) {
  // 3000 rpm: two turns are 400 samples, every fourth of them a point.
  auto batch = FourAxes(0, 1000, 1e-6F);
  batch.speed_rad_per_s.assign(1000, 314.0F);
  for (int n = 0; n < 1000; ++n) {
    batch.angle_rad[static_cast<std::size_t>(n)] =
        static_cast<float>((n + 50) % 200) * 0.0314159265F;
  }
  run_.Take(channel::kSamples, Encoded(batch), 0);
  const json tick = json::parse(TickJson(run_, 0));
  // The samples 600 to 999 hold passages at 750 and 950, where n + 50 is a multiple of 200.
  const std::size_t points = tick["orbit_nm"].at(0).size() / 2;
  EXPECT_EQ(points, 100U);
  EXPECT_EQ(tick["orbit_key"], json::parse("[37,87]"));
}

TEST_F(Snapshot, NamesNoPassageOfTheKeyPhasorWhereTheRotorStands) {
  run_.Take(channel::kSamples, Encoded(FourAxes(0, 512, 1e-6F)), 0);
  EXPECT_TRUE(json::parse(TickJson(run_, 0))["orbit_key"].empty());
}

TEST_F(Snapshot, TellsThePageHowFarTheAmplifiersReach) {
  EXPECT_EQ(json::parse(RigJson(run_, 1))["amplifier_hz"],
            720.0);  // config/rigs/flexible_rotor.yaml
}

TEST_F(Snapshot, TellsThePageWhichWayEachShaftTurns) {
  EXPECT_EQ(json::parse(RigJson(run_, 1))["speed_ratios"], json::parse("[1.0,1.0]"));
  run_.Take(channel::kHeader, EncodedHeader(2, "geared_rotor_8dof"), 0);  // 20 teeth on 40
  EXPECT_EQ(json::parse(RigJson(run_, 1))["speed_ratios"], json::parse("[1.0,-0.5]"));
}

TEST_F(Snapshot, TellsWhichBlocksActAndWhyOthersEnded) {
  const auto tick = [this] {
    run_.Take(channel::kState, Encoded(TrippedState()), 0);
    return json::parse(TickJson(run_, 0));
  };
  EXPECT_FALSE(tick().contains("blocks")) << "a controller without any";
  run_.Take(channel::kHeader, HeaderWithBlock(2, "low"), 0);
  EXPECT_EQ(tick()["blocks"][0]["acts"], false);
  EXPECT_EQ(tick()["saves_bias"], true);
  run_.Take(channel::kEvent, EncodedEvent(session::BlockBegins("low", "at 2000 rpm (cycle 7)")), 0);
  EXPECT_EQ(tick()["blocks"][0], json({{"name", "low"}, {"acts", true}, {"why", ""}}));
  run_.Take(channel::kEvent,
            EncodedEvent(session::BlockEnds("low", "at 2100 rpm (cycle 9)",
                                            synchronous::Ending::kOrbitGrew)),
            0);
  EXPECT_EQ(tick()["blocks"][0]["acts"], false);
  EXPECT_EQ(tick()["blocks"][0]["why"], "the orbit grew");
  run_.Take(channel::kHeader, EncodedHeader(3), 0);
  EXPECT_FALSE(tick().contains("blocks")) << "another run";
}

TEST_F(Snapshot, SaysHowARunEnded) {
  EXPECT_EQ(json::parse(EndJson("with a \"trip\""))["text"], "with a \"trip\"");
}

TEST_F(Snapshot, KeepsAnEventsTextWhateverBytesItHolds) {
  NumberedEvent event{3, {}, 0.5};
  event.event.text = "a \"quoted\" \n line and \xff";
  const json written = json::parse(EventJson(event));
  EXPECT_EQ(written["number"], 3);
  EXPECT_TRUE(written["text"].get<std::string>().starts_with("a \"quoted\" \n line and "));
  EXPECT_EQ(EventJson(event).find('\n'), std::string::npos) << "a line end would end the message";
}

}  // namespace
}  // namespace levitas::dashboard
