#pragma once
// Seeded random walks of what an operator's desk sees and is asked: two desks see and hear the
// same, and everything they answer is compared in every cycle.
//
// Rig      modes that follow the desk's commands or do not, readings that jump, speeds that fall or
//          do not: also what no rig does. One thing is kept: once the end of a run has found the
//          rotor let go, nothing lifts it again, since no desk asks for that then.
// Length   a period of 10 ms, so that limits of ten seconds lie within a walk. A walk ends with
//          Done, as the loop does.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "common/random.hpp"
#include "controller/loop/command_arbiter.hpp"

namespace levitas::loop::test {

/// How often the walks met what they are to compare.
struct Met {
  std::array<std::uint64_t, kOperatorCommandCount> commands{};
  std::uint64_t cycles{}, done{}, done_turning{}, overdue{}, brake_fails{}, signal_cycles{};
  std::uint64_t reduced{};
};

struct WalkPlan {
  explicit WalkPlan(Random& draw) {
    const auto one_of = [&draw](auto... values) {
      const std::array all{values...};
      return all[draw.Bits() % all.size()];
    };
    options = {.period_s = 0.01,
               .stop_acceleration_rad_per_s2 = one_of(0.0, 5.0, 50.0),
               .standstill_rad_per_s = 1.0,
               .landing_ramp_s = one_of(0.0, 0.5),
               .duration_s = one_of(0.0, 0.0, 3.0)};
    if (draw.Bits() % 2 == 0) {
      options.excitation = {.axes = 4, .period_s = 0.01, .current_a = 0.5, .clearance_m = {}};
      options.excitation.clearance_m.fill(200e-6);
    }
    plays = draw.Bits() % 3 == 0;
    obeys = one_of(0.0, 0.6, 1.0);
    glitches = one_of(0.0, 0.01, 0.1);
    commands = one_of(0.0, 0.02, 0.2);
    fall_rad_per_s2 = one_of(0.0, 0.3, 20.0);
    end_at = draw.Bits() % 3 == 0 ? std::nullopt : std::optional(draw.Bits() % 1500);
  }
  ArbiterOptions options;
  bool plays{};
  double obeys{};     ///< share of the commands that the rig follows
  double glitches{};  ///< share of the cycles with a reading that jumps
  double commands{};  ///< share of the cycles in which somebody asks for something
  double fall_rad_per_s2{};
  std::optional<std::uint64_t> end_at;
};

inline scenario::Step SignalOf(std::uint64_t cycles) {
  scenario::Excitation bits;
  bits.axis = 1;
  bits.order = 5;
  bits.amplitude_a = 0.25;
  scenario::Step step;
  step.hold_s = static_cast<double>(cycles) * 0.01;
  step.excitation.push_back(bits);
  step.orbit_limit_m = 100e-6;
  return step;
}

inline scenario::ScenarioConfig WalkScenario() {
  scenario::ScenarioConfig config;
  config.name = "walk";
  const auto step = [&config](OperatorCommand command, Mode mode) -> scenario::Step& {
    scenario::Step& added = config.steps.emplace_back();
    added.command = command;
    added.wait = scenario::Wait::kMode;
    added.wait_mode = mode;
    added.timeout_s = 8.0;
    return added;
  };
  step(OperatorCommand::kLift, Mode::kLevitating).hold_s = 0.2;
  scenario::Step& spin = step(OperatorCommand::kSpin, Mode::kSpinning);
  spin.speed_rad_per_s = 50.0;
  spin.acceleration_rad_per_s2 = 10.0;
  spin.excitation = SignalOf(1).excitation;
  spin.hold_s = 3.0;
  step(OperatorCommand::kCoastDown, Mode::kCoastDown).hold_s = 1.0;
  return config;
}

/// What the desk sees of a rig that follows it more or less.
class WalkRig {
 public:
  WalkRig(Random& draw, const WalkPlan& plan) : draw_(draw), plan_(plan) {
    mode_ = static_cast<Mode>(draw.Bits() % kModeCount);
    held_ = Energised(mode_);
    speed_ = draw.Bits() % 3 == 0 ? 0.0 : 80.0 * draw.Uniform();
  }

  OperatorView See() {
    speed_ = std::max(0.0, speed_ - plan_.fall_rad_per_s2 * 0.01);
    if (left_ > 0 && --left_ == 0) Arrive();
    if (Drawn(plan_.glitches * 0.2)) Jump();
    const bool glitch = Drawn(plan_.glitches);
    OperatorView view{.cycle = cycle_++,
                      .mode = mode_,
                      .fault = mode_ == Mode::kTripped ? Fault::kOrbitExceeded : Fault::kNone,
                      .amplifiers_enabled = held_,
                      .command_refused = refused_ || Drawn(plan_.glitches),
                      .standing = std::abs(speed_) < 1.0,
                      .speed_rad_per_s = speed_,
                      .radius_m = 150e-6 * draw_.Uniform()};
    if (glitch) Spoil(view);
    for (double& position_m : view.position_m) position_m = 160e-6 * (draw_.Uniform() - 0.5);
    refused_ = false;
    return view;
  }

  void Take(const cycle::OperatorInput& input) {
    if (input.command == OperatorCommand::kNone) return;
    if (!Drawn(plan_.obeys)) {
      refused_ = Drawn(0.5);
      return;
    }
    switch (input.command) {
      case OperatorCommand::kLift:
        return Go(Mode::kLift, 20);
      case OperatorCommand::kSpin:
        if (input.speed_rad_per_s > 0.0) speed_ = input.speed_rad_per_s;
        return Go(Mode::kSpinning, 0);
      case OperatorCommand::kCoastDown:
        return Go(Mode::kCoastDown, 0);
      case OperatorCommand::kLand:
        return Go(Mode::kLanding, 30);
      case OperatorCommand::kEmergencyStop:
        return Go(Mode::kTripped, 40);
      case OperatorCommand::kReset:
        return Go(Mode::kOff, 0);
      default:
        return;
    }
  }
  /// The rotor is let go and its run ends: nobody lifts it any more.
  void StayDown() { down_ = true; }

 private:
  [[nodiscard]] bool Drawn(double share) { return draw_.Uniform() < share; }
  static bool Energised(Mode mode) { return mode != Mode::kOff && mode != Mode::kSelfTest; }

  void Go(Mode mode, std::uint64_t cycles) {
    if (down_ && mode != Mode::kTripped) return;
    held_ = !down_ && Energised(mode);
    mode_ = mode;
    left_ = cycles;
  }
  void Arrive() {
    if (mode_ == Mode::kLift) Go(Mode::kLevitating, 0);
    if (mode_ == Mode::kLanding) Go(Mode::kOff, 0);
    if (mode_ == Mode::kTripped) held_ = false;
  }
  void Jump() {
    if (down_) {
      mode_ = draw_.Bits() % 2 == 0 ? Mode::kOff : Mode::kTripped;
    } else {
      Go(static_cast<Mode>(draw_.Bits() % kModeCount), 1 + draw_.Bits() % 60);
      held_ = Drawn(0.1) ? !held_ : held_;
    }
    if (draw_.Bits() % 2 == 0) speed_ = 80.0 * draw_.Uniform();
  }
  void Spoil(OperatorView& view) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const std::array wrong{kNone, 0.0, 1e5, -view.speed_rad_per_s};
    view.speed_rad_per_s = wrong[draw_.Bits() % wrong.size()];
    if (draw_.Bits() % 2 == 0) view.standing = !view.standing;
  }

  Random& draw_;
  const WalkPlan& plan_;
  Mode mode_{};
  bool held_{};
  bool down_{};
  bool refused_{};
  double speed_{};
  std::uint64_t left_{};
  std::uint64_t cycle_{1};
};

/// One of the two, with its own copies of all that a desk shares.
template <class Desk>
struct WalkSide {
  WalkSide(const WalkPlan& plan)
      : player(plan.plays ? std::optional<scenario::ScenarioPlayer>(std::in_place, WalkScenario(),
                                                                    plan.options.period_s, 1.0)
                          : std::nullopt),
        desk(plan.options, player ? &*player : nullptr, {&commands, &stops, &given}) {}
  SpscRing<RemoteCommand> commands{4};
  StopLatch stops;
  SpscRing<GivenCommand> given{256};
  ExcitationPool pool;
  std::optional<scenario::ScenarioPlayer> player;
  Desk desk;
};

/// What the network asks of both sides in a cycle.
template <class One, class Other>
class WalkNetwork {
 public:
  WalkNetwork(Random& draw, const WalkPlan& plan, One& one, Other& other)
      : draw_(draw), plan_(plan), one_(one), other_(other) {}

  void Ask(std::uint64_t cycle) {
    if (plan_.end_at == cycle) {
      one_.desk.RequestStop();
      other_.desk.RequestStop();
    }
    if (draw_.Uniform() >= plan_.commands) return;
    switch (draw_.Bits() % 32) {
      case 0:
        one_.desk.RequestEmergencyStop();
        other_.desk.RequestEmergencyStop();
        return;
      case 1:
        one_.stops.Ask(static_cast<std::int64_t>(cycle), {7, 1});
        other_.stops.Ask(static_cast<std::int64_t>(cycle), {7, 1});
        return;
      default:
        return Command(cycle);
    }
  }

 private:
  void Command(std::uint64_t cycle) {
    using enum OperatorCommand;
    constexpr std::array kAsked{kLift,   kSpin,          kSpin, kCoastDown, kReset, kExcite,
                                kExcite, kEndExcitation, kLand, kMark,      kNone};
    RemoteCommand command{.command = kAsked[draw_.Bits() % kAsked.size()],
                          .speed_rad_per_s = 50.0,
                          .acceleration_rad_per_s2 = 5.0,
                          .origin = {3, static_cast<std::int64_t>(cycle)}};
    const std::uint64_t asked = one_.stops.asked();
    command.stops_before = asked > 0 && draw_.Bits() % 8 == 0 ? asked - 1 : asked;
    const bool full = one_.commands.Full();
    ASSERT_EQ(full, other_.commands.Full()) << cycle;
    if (full) return;
    RemoteCommand same = command;
    if (command.command == kExcite && draw_.Bits() % 16 != 0) {
      const scenario::Step step = SignalOf(1 + draw_.Bits() % 120);
      command.excitation = one_.pool.Put(step, plan_.options.period_s);
      same.excitation = other_.pool.Put(step, plan_.options.period_s);
      ASSERT_EQ(command.excitation == nullptr, same.excitation == nullptr)
          << "a place that was not given back, cycle " << cycle;
      if (command.excitation == nullptr) return;
    }
    one_.commands.Post(command);
    other_.commands.Post(same);
  }

  Random& draw_;
  const WalkPlan& plan_;
  One& one_;
  Other& other_;
};

template <class One, class Other>
void ExpectTheSame(One& one, Other& other, const cycle::OperatorInput& a,
                   const cycle::OperatorInput& b) {
  ASSERT_EQ(Name(a.command), Name(b.command));
  ASSERT_EQ(a.speed_rad_per_s, b.speed_rad_per_s);
  ASSERT_EQ(a.acceleration_rad_per_s2, b.acceleration_rad_per_s2);
  ASSERT_EQ(a.excitation_a, b.excitation_a);
  ASSERT_EQ(a.excitation_m, b.excitation_m);
  ASSERT_EQ(one.desk.Done(), other.desk.Done());
  ASSERT_EQ(one.desk.standing(), other.desk.standing());
  ASSERT_EQ(one.desk.stop_received_ns(), other.desk.stop_received_ns());
  ASSERT_EQ(one.desk.signals_reduced().cycles, other.desk.signals_reduced().cycles);
  const EndNews news = one.desk.news();
  const EndNews same = other.desk.news();
  ASSERT_EQ(news.overdue, same.overdue);
  ASSERT_EQ(news.brake_fails, same.brake_fails);
  // Bit for bit: a speed that is no number equals itself here.
  ASSERT_EQ(std::bit_cast<std::uint64_t>(news.speed_rad_per_s),
            std::bit_cast<std::uint64_t>(same.speed_rad_per_s));
  GivenCommand told;
  GivenCommand too;
  while (one.given.Take(told)) {
    ASSERT_TRUE(other.given.Take(too));
    ASSERT_EQ(told.cycle, too.cycle);
    ASSERT_EQ(told.origin.sender, too.origin.sender);
    ASSERT_EQ(told.origin.sequence, too.origin.sequence);
  }
  ASSERT_FALSE(other.given.Take(too));
}

/// `look(desk)` after each cycle, for what the desk of type One shows besides.
template <class One, class Other, class Look>
void Walk(std::uint64_t seed, Met& met, const Look& look) {
  constexpr std::uint64_t kCycles = 4000;
  Random draw(seed);
  const WalkPlan plan(draw);
  WalkSide<One> one(plan);
  WalkSide<Other> other(plan);
  WalkRig rig(draw, plan);
  WalkNetwork network(draw, plan, one, other);
  for (std::uint64_t cycle = 1; cycle <= kCycles && !one.desk.Done(); ++cycle) {
    network.Ask(cycle);
    const OperatorView view = rig.See();
    const bool ends = (plan.end_at && *plan.end_at <= cycle) ||
                      (one.player && one.player->outcome() != scenario::Outcome::kPlaying) ||
                      (plan.options.duration_s > 0.0 &&
                       static_cast<double>(cycle - 1) * 0.01 >= plan.options.duration_s - 1e-9);
    const bool let_go = view.mode == Mode::kOff || view.mode == Mode::kTripped;
    if (ends && let_go && !view.amplifiers_enabled) rig.StayDown();
    const cycle::OperatorInput input = one.desk.Next(view);
    const cycle::OperatorInput same = other.desk.Next(view);
    ExpectTheSame(one, other, input, same);
    if (testing::Test::HasFatalFailure()) {
      FAIL() << "seed " << seed << ", cycle " << cycle << ", mode " << Name(view.mode);
    }
    rig.Take(input);
    look(one.desk);
    ++met.commands[static_cast<std::size_t>(input.command)];
    ++met.cycles;
    if (input.excitation_a[1] != 0.0) ++met.signal_cycles;
    if (one.desk.Done()) ++(one.desk.standing() ? met.done : met.done_turning);
  }
  const EndNews news = one.desk.news();
  met.overdue += news.overdue ? 1 : 0;
  met.brake_fails += news.brake_fails ? 1 : 0;
  for (const std::uint64_t cycles : one.desk.signals_reduced().cycles) met.reduced += cycles;
}

}  // namespace levitas::loop::test
