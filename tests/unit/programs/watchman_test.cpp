// What calls for an end while the loop runs, and what does not. Signals and threads that fail are
// the process's: tests/process/pair.

#include "programs/controller/watchman.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <optional>

#include "configuration/rig_file.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/loop/fakes.hpp"

namespace levitas::controller_program {
namespace {

class NoRig final : public RigConnection {
 public:
  explicit NoRig(port::RigPort& port) : port_(port) {}
  port::RigPort& port() noexcept override { return port_; }
  [[nodiscard]] std::string Where() const override { return "nowhere"; }
  [[nodiscard]] const char* SimulatedRig() const noexcept override { return "amb-plant"; }
  [[nodiscard]] bool virtual_rig() const noexcept override { return true; }
  [[nodiscard]] std::int64_t phase_ns() const noexcept override { return 0; }

 private:
  port::RigPort& port_;
};

cycle::CycleConfig Config() {
  const std::string folder = levitas::test::SourceFolder() + "/config/";
  const auto rig = configuration::LoadRig(folder + "rigs/flexible_rotor.yaml");
  const auto controller =
      configuration::LoadController(folder + "controllers/flexible_rotor.yaml", rig.numbers);
  return {rig.numbers, controller.law, controller.supervisor};
}

/// A loop that is not run, and a watchman who looks once.
class Watched : public testing::Test {
 protected:
  static constexpr std::int64_t kPeriodNs = 100'000;

  bool LookOnce() {
    std::atomic<bool> running{true};
    Watchman watchman(loop_, desk_, options_, rig_, nullptr, [&] {
      ++told_;
      running.store(false);
    });
    return watchman.Watch(running);
  }
  /// What the desk asks for in a cycle with a rotor that is levitated and stands.
  OperatorCommand Asked() {
    return desk_
        .Next({.cycle = cycle_++,
               .mode = Mode::kLevitating,
               .amplifiers_enabled = true,
               .standing = true})
        .command;
  }

  ControllerOptions options_;
  loop::test::FakeClock clock_;
  loop::test::FakePort port_{clock_, kPeriodNs};
  NoRig rig_{port_};
  loop::CommandArbiter desk_{
      {.period_s = 1e-4, .stop_acceleration_rad_per_s2 = 50.0, .standstill_rad_per_s = 1.0},
      nullptr,
      {}};
  cycle::ControlCycle control_{Config()};
  loop::test::FakeSink sink_;
  loop::ControlLoop loop_{{.period_ns = kPeriodNs}, port_, control_, desk_, sink_, clock_};
  std::uint64_t cycle_{0};
  int told_{0};
};

TEST_F(Watched, WithoutCauseTheRunGoesOnAndItsNewsAreTold) {
  EXPECT_TRUE(LookOnce());
  EXPECT_EQ(told_, 1);
  EXPECT_EQ(Asked(), OperatorCommand::kNone);
}

class LifeLine : public Watched {
 protected:
  void SetUp() override {
    ASSERT_EQ(::pipe(ends_.data()), 0);
    options_.life_line = ends_[0];
  }
  void TearDown() override {
    ::close(ends_[0]);
    if (ends_[1] >= 0) ::close(ends_[1]);
  }
  void LetGo() {
    ::close(ends_[1]);
    ends_[1] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

TEST_F(LifeLine, ThatIsHeldLandsNothing) {
  EXPECT_TRUE(LookOnce());
  EXPECT_EQ(Asked(), OperatorCommand::kNone);
}

TEST_F(LifeLine, WhoseOtherEndIsClosedLandsTheRotor) {
  LetGo();
  EXPECT_TRUE(LookOnce());
  EXPECT_EQ(Asked(), OperatorCommand::kLand);
}

// A rig that was never heard: there is nothing to land, so the loop does not wait for it.
TEST_F(LifeLine, WhoseOtherEndIsClosedEndsALoopWithoutARigAtOnce) {
  LetGo();
  EXPECT_TRUE(LookOnce());
  port_.silent = [] { return true; };
  loop_.Run();  // returns: it was aborted
  EXPECT_EQ(loop_.statistics().cycles, 0U);
}

TEST_F(Watched, ARigThatStaysAwayForTheTimeOutEndsTheRun) {
  options_.partner_timeout_s = 0.0;
  EXPECT_FALSE(LookOnce());
  port_.silent = [] { return true; };
  loop_.Run();
  EXPECT_EQ(loop_.statistics().cycles, 0U);
}

}  // namespace
}  // namespace levitas::controller_program
