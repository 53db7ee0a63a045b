// What the loop's records leave behind: trips counted once each, the first fault kept. Needs
// multicast on this machine; where there is no route the tests are skipped, and say so.

#include "programs/controller/loop_outlet.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::controller_program {
namespace {

// A port range of its own per process, apart from those of the other multicast tests.
transport::LcmNetwork OwnNetwork() {
  transport::LcmNetwork network;
  network.group = "239.255.76.70";
  network.base_port = static_cast<std::uint16_t>(20'000 + 4 * (getpid() % 10'000));
  return network;
}

class Outlet : public testing::Test {
 protected:
  void SetUp() override {
    try {
      telemetry_ = std::make_unique<transport::Telemetry>(OwnNetwork());
    } catch (const Problem& problem) {
      GTEST_SKIP() << problem.what();
    }
    session::RecorderOptions options;
    options.trip_folder = folder_ / "";
    options.header.period_ns = 100'000;
    options.header.channels = {"de_x", "de_y"};
    options.on_record = [this](const cycle::CycleRecord&) { ++recorded_; };
    recorder_ = std::make_unique<session::Recorder>(options);
    outlet_ = std::make_unique<LoopOutlet>(*recorder_, *telemetry_, 100'000);
  }
  void Post(Fault fault) {
    cycle::CycleRecord record;
    record.in.cycle = next_++;
    record.in.frame.axes = 2;
    record.out.mode = fault == Fault::kNone ? Mode::kLevitating : Mode::kTripped;
    record.out.fault = fault;
    outlet_->Post(record);
  }

  levitas::test::ScratchFolder folder_;
  std::unique_ptr<transport::Telemetry> telemetry_;
  std::unique_ptr<session::Recorder> recorder_;
  std::unique_ptr<LoopOutlet> outlet_;
  std::uint64_t next_{0};
  std::atomic<int> recorded_{0};
};

TEST_F(Outlet, CountsATripOnceHoweverLongItsFaultIsLatched) {
  Post(Fault::kNone);
  EXPECT_EQ(outlet_->trips(), 0U);
  EXPECT_EQ(outlet_->first_fault(), Fault::kNone);
  for (int i = 0; i < 100; ++i) Post(Fault::kOrbitExceeded);
  EXPECT_EQ(outlet_->trips(), 1U);
  EXPECT_EQ(outlet_->first_fault(), Fault::kOrbitExceeded);
}

TEST_F(Outlet, KeepsTheFirstFaultOverAResetAndAnotherTrip) {
  Post(Fault::kOrbitExceeded);
  Post(Fault::kNone);
  Post(Fault::kOverSpeed);
  EXPECT_EQ(outlet_->trips(), 2U);
  EXPECT_EQ(outlet_->first_fault(), Fault::kOrbitExceeded);
}

TEST_F(Outlet, HandsEveryRecordToTheRecorderAndKnowsTheNewestCycle) {
  for (int i = 0; i < 500; ++i) Post(Fault::kNone);
  EXPECT_EQ(outlet_->cycle(), 499U);
  recorder_->Finish();
  EXPECT_EQ(recorded_.load(), 500);
}

}  // namespace
}  // namespace levitas::controller_program
