// Random operators and random faults: whatever they do, the supervisor stays within the document's
// automaton, a trip keeps its first cause, and only a permitted reset ends it.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>

#include "common/random.hpp"
#include "tests/unit/supervisor/reference_automaton.hpp"
#include "tests/unit/supervisor/supervisor_rig.hpp"

namespace levitas::supervisor {
namespace {

constexpr double kWalkNan = std::numeric_limits<double>::quiet_NaN();

/// A rig that is healthy most of the time, and an operator who presses everything. Faults last for
/// a few cycles, so that counters of several cycles are reached.
class Chaos {
 public:
  explicit Chaos(std::uint64_t seed, double fault_share) : draw_(seed), share_(fault_share) {}

  Request Command() {
    Request request;
    if (draw_.Bits() % 12 != 0) return request;
    // Lift and spin are wanted most: most walks would else stay in off.
    using enum OperatorCommand;
    static constexpr std::array kWanted{kLift,          kLift,      kSpin,      kSpin,
                                        kSpin,          kCoastDown, kCoastDown, kLand,
                                        kEmergencyStop, kReset,     kMark};
    request.command = kWanted[draw_.Bits() % kWanted.size()];
    static constexpr std::array kSpeeds{0.0, 300.0, -600.0, 601.0, kWalkNan};
    static constexpr std::array kRates{50.0, 7.7e7, 1.0, 0.0, kWalkNan};
    request.speed_rad_per_s = kSpeeds[draw_.Bits() % kSpeeds.size()];
    request.acceleration_rad_per_s2 = kRates[draw_.Bits() % kRates.size()];
    return request;
  }

  const Observation& Next(Seen& seen) {
    if (left_ == 0) {
      Heal(seen);
      left_ = 1 + draw_.Bits() % 12;
      if (draw_.Uniform() < share_) Spoil(seen);
    }
    --left_;
    if (draw_.Bits() % 20 == 0) standing_ = !standing_;
    if (every_other_) seen.fresh = left_ % 2 == 0;
    seen.speed_rad_per_s = speed_override_ ? *speed_override_ : standing_ ? 0.2 : 250.0;
    return seen.Next();
  }

 private:
  void Heal(Seen& seen) {
    seen.fresh = true;
    seen.rig_status = 0;
    seen.missed_deadlines = 0;
    seen.saturated_axes = 0;
    seen.frozen = {};
    seen.position_m = {};
    speed_override_.reset();
    every_other_ = false;
  }

  void Spoil(Seen& seen) {
    switch (draw_.Bits() % 15) {
      case 0:
        seen.fresh = false;
        break;
      case 1:
        seen.rig_status = kRigEmergencyStop;
        break;
      case 2:
        seen.rig_status = kRigAmplifierFault;
        break;
      case 3:
        seen.missed_deadlines = 1 + static_cast<std::uint32_t>(draw_.Bits() % 3);
        break;
      case 4:
        seen.saturated_axes = static_cast<std::uint16_t>(draw_.Bits() % 16);
        break;
      case 5:
        seen.frozen[draw_.Bits() % 4] = true;
        break;
      case 6:
        seen.position_m[draw_.Bits() % 4] = kWalkNan;
        break;
      case 7:
        seen.position_m[draw_.Bits() % 4] = 380e-6;  // near the end of the converter
        break;
      case 8:
        seen.position_m[draw_.Bits() % 4] = 150e-6;  // a large orbit
        break;
      case 9:
        seen.position_m[draw_.Bits() % 4] =
            50e-6;  // off the centre for longer than a lift may take
        left_ = 150;
        break;
      case 10:
        speed_override_ = 700.0;
        break;
      case 11:
        seen.rig_status = kRigSpeedUnknown;
        break;
      case 12:
        seen.rig_status = kRigCurrentHeld;
        left_ = 20;
        break;
      case 13:
        every_other_ = true;
        left_ = 40;
        break;
      default:
        ++seen.rig_session;
        break;
    }
  }

  Random draw_;
  double share_;
  std::uint64_t left_{};
  bool standing_{true};
  bool every_other_{};
  std::optional<double> speed_override_;
};

/// From docs/safety.md: five periods below standstill without interruption prove that the rotor
/// stands; a gap between two frames counts as ten periods at most. (Any change of the speed is one
/// that the drive of these walks can have made.)
class Standstill {
 public:
  void See(const Observation& seen) {
    gap_ += 1 + static_cast<int>(seen.missed_deadlines);
    if (!seen.fresh) return;
    if ((seen.rig_status & kRigSpeedUnknown) != 0) {
      slow_ = 0;
    } else {
      turning_ = std::abs(seen.speed_rad_per_s) >= 1.0;
      slow_ = turning_ ? 0 : slow_ == 0 ? 1 : slow_ + std::min(gap_, 10);
    }
    gap_ = 0;
  }
  [[nodiscard]] bool stands() const { return slow_ >= 5; }
  [[nodiscard]] bool turning() const { return turning_; }

 private:
  int slow_{};
  int gap_{};
  bool turning_{};
};

/// From docs/safety.md: cause_gone is a fresh plausible frame without a fault bit, and a rotor that
/// stands.
/// Whether an axis is frozen is not seen in one frame, so a walk with a frozen axis asks no reset.
bool CauseGone(const Seen& seen, bool standing) {
  const RigNumbers rig = TestRig();
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    if (!(std::abs(seen.position_m[i]) < 0.9 * rig.sensor_range_m)) return false;
  }
  return seen.fresh &&
         (seen.rig_status & (kRigEmergencyStop | kRigAmplifierFault | kRigSpeedUnknown)) == 0 &&
         standing;
}

struct Visits {
  std::array<std::uint64_t, kStateCount> state{};
  std::array<std::uint64_t, kFaultCount> cause{};
  std::uint64_t resets{};
};

void Walk(std::uint64_t seed, double fault_share, int cycles, Visits& visits) {
  Chaos chaos(seed, fault_share);
  Seen seen;
  Supervisor supervisor(TestRig(), TestConfig());
  ReferenceAutomaton reference;
  Standstill standstill;
  std::uint32_t session = 0;
  double set_point = 0.0;
  for (int i = 0; i < cycles; ++i) {
    Request request = chaos.Command();
    const Observation& observation = chaos.Next(seen);
    const bool frozen = seen.frozen != std::array<bool, 4>{};
    if (frozen && request.command == OperatorCommand::kReset) request = {};
    const State before = supervisor.decision().state;
    const Fault cause_before = supervisor.decision().latch.finding.fault;
    const Finding found = supervisor.Check(observation, request);
    const Decision& decision = supervisor.Decide(observation, request, found);
    // A rig that is another's is accepted where no current flows; nothing is known of its rotor.
    if (seen.fresh && !Row(before).energised && before != State::kSelfTest) {
      if (seen.rig_session != session) standstill = {};
      session = seen.rig_session;
    }
    standstill.See(observation);

    const bool speed_valid = std::abs(request.speed_rad_per_s) <= 600.0 &&
                             request.acceleration_rad_per_s2 > 0.0 &&
                             request.acceleration_rad_per_s2 <= 1e7;
    const auto answer = reference.Step({.found = found.fault,
                                        .command = request.command,
                                        .standing = standstill.stands(),
                                        .turning = standstill.turning(),
                                        .speed_valid = speed_valid,
                                        .cause_gone = CauseGone(seen, standstill.stands()),
                                        .wants_stand = set_point == 0.0,
                                        .cycle = observation.cycle});
    ASSERT_TRUE(answer.allowed.contains(decision.state))
        << "seed " << seed << ", cycle " << i << ": " << Name(before) << " -> "
        << Name(decision.state) << " after " << levitas::Name(request.command) << " and "
        << levitas::Name(found.fault);
    ASSERT_EQ(decision.command_refused, answer.refused)
        << "seed " << seed << ", cycle " << i << ": " << levitas::Name(request.command) << " in "
        << Name(before);
    ASSERT_EQ(decision.latch.finding.fault, answer.cause) << "seed " << seed << ", cycle " << i;
    ASSERT_EQ(decision.latch.cycle, answer.cause_cycle) << "seed " << seed << ", cycle " << i;
    reference.Follow(decision.state);
    // Now and then the law's step brings a fault to light, after everything was decided.
    if (i % 997 == 0 && Row(decision.state).energised) {
      (void)supervisor.Drop(observation, {Fault::kLawNotFinite, 0, 0.0, 1.0});
      const auto dropped =
          reference.Step({.found = Fault::kLawNotFinite, .cycle = observation.cycle});
      ASSERT_TRUE(dropped.allowed.contains(decision.state)) << "seed " << seed << ", cycle " << i;
      ASSERT_EQ(decision.latch.finding.fault, dropped.cause) << "seed " << seed << ", cycle " << i;
      reference.Follow(decision.state);
    }
    if (decision.state == State::kSpinning && request.command == OperatorCommand::kSpin &&
        !decision.command_refused) {
      set_point = request.speed_rad_per_s;
    }
    ++visits.state[static_cast<std::size_t>(decision.state)];
    if (cause_before == Fault::kNone) {
      ++visits.cause[static_cast<std::size_t>(decision.latch.finding.fault)];
    }
    if (before == State::kTrippedReleased && decision.state == State::kOff) ++visits.resets;
  }
}

TEST(RandomWalk, StaysWithinTheAutomatonOfTheDocument) {
  Visits visits;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    // From a healthy rig to one that is ill half of the time.
    ASSERT_NO_FATAL_FAILURE(Walk(seed, 0.008 * static_cast<double>(seed), 8000, visits));
  }
  // A walk that goes nowhere proves nothing: every state and nearly every cause was met.
  for (std::size_t i = 0; i < kStateCount; ++i) {
    EXPECT_GT(visits.state[i], 0U) << Name(static_cast<State>(i));
  }
  for (std::uint8_t i = 1; i < kFaultCount; ++i) {
    EXPECT_GT(visits.cause[i], 0U) << levitas::Name(static_cast<Fault>(i));
  }
  EXPECT_GT(visits.resets, 0U);
}

TEST(RandomWalk, NeverEnergisesDrivesOrReferencesWhereTheDocumentForbidsIt) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Chaos chaos(seed, 0.2);
    Seen seen;
    Supervisor supervisor(TestRig(), TestConfig());
    for (int i = 0; i < 5000; ++i) {
      const Request request = chaos.Command();
      const Observation& observation = chaos.Next(seen);
      const Finding found = supervisor.Check(observation, request);
      const Decision& decision = supervisor.Decide(observation, request, found);
      const StateRow& row = Row(decision.state);
      const bool brakes_what_turns = row.mode == Mode::kOff && decision.turning;
      if (row.mode != Mode::kSpinning && row.mode != Mode::kTripped && !brakes_what_turns) {
        ASSERT_FALSE(decision.drive_enabled) << Name(decision.state);
      }
      if (row.mode == Mode::kTripped) {
        ASSERT_EQ(decision.speed_set_point_rad_per_s, 0.0);
        ASSERT_NE(decision.latch.finding.fault, Fault::kNone);
      } else {
        ASSERT_EQ(decision.latch.finding.fault, Fault::kNone);
      }
      // The accepted set point is one that passed the guard, whatever was asked for since.
      ASSERT_LE(std::abs(decision.speed_set_point_rad_per_s), 600.0);
      if (!row.energised) {
        ASSERT_EQ(decision.reference_m, AxisArray{});
      }
      for (const double reference_m : decision.reference_m) ASSERT_TRUE(std::isfinite(reference_m));
    }
  }
}

TEST(RandomWalk, GivesTheSameDecisionsForTheSameSeed) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Visits first;
    Visits second;
    ASSERT_NO_FATAL_FAILURE(Walk(seed, 0.1, 2000, first));
    ASSERT_NO_FATAL_FAILURE(Walk(seed, 0.1, 2000, second));
    EXPECT_EQ(first.state, second.state);
    EXPECT_EQ(first.cause, second.cause);
  }
}

TEST(RandomWalk, EveryTripCanBeEndedByHealingTheRigAndAskingForReset) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Chaos chaos(seed, 0.3);
    Driver driver;
    for (int i = 0; i < 500; ++i) {
      const Request request = chaos.Command();
      const Observation& observation = chaos.Next(driver.seen);
      (void)driver.supervisor.Decide(observation, request,
                                     driver.supervisor.Check(observation, request));
    }
    // A healthy rig that stands: a stop lands by itself, then one reset leads to off.
    Seen healthy;
    healthy.cycle = driver.seen.cycle;
    healthy.rig_session = driver.seen.rig_session;
    driver.seen = healthy;
    (void)driver.Step(OperatorCommand::kEmergencyStop);
    (void)driver.Steps(100);
    ASSERT_EQ(driver.state(), State::kTrippedReleased) << "seed " << seed;
    (void)driver.Step(OperatorCommand::kReset);
    ASSERT_EQ(driver.state(), State::kOff) << "seed " << seed;
    // 100 cycles behind the last miss the deadline window is empty: it lifts again.
    (void)driver.Steps(100);
    driver.GoTo(State::kLevitating);
    EXPECT_EQ(driver.state(), State::kLevitating) << "seed " << seed;
  }
}

}  // namespace
}  // namespace levitas::supervisor
