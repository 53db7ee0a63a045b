#include "benchmark/lives/life.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "benchmark/lives/judge.hpp"
#include "benchmark/lives/virtual_bench.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "controller/loop/command_arbiter.hpp"
#include "controller/loop/control_loop.hpp"
#include "controller/supervisor/supervisor.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::lives {
namespace {

using loop::RemoteCommand;

constexpr std::int64_t kLookNs = 100'000'000;

BenchOptions Options(const LifeRig& rig, const LifePlan& plan) {
  return {.period_ns = rig.config.rig.period_ns,
          .watchdog_periods = plan.watchdog_periods,
          .keeps_order = plan.keeps_order,
          .seed = plan.seed,
          // As shares of the period, so that each rate has the same room.
          .frame_way_ns = rig.config.rig.period_ns / 5,
          .current_way_ns = rig.config.rig.period_ns * 3 / 20,
          .compute_ns = rig.config.rig.period_ns * 2 / 25};
}

double StopRate(const cycle::CycleConfig& config) {
  return std::min(config.supervisor.sequence.trip_acceleration_rad_per_s2,
                  config.rig.max_acceleration_rad_per_s2);
}

loop::ArbiterOptions ArbiterOptionsOf(const cycle::CycleConfig& config, bool guards_signals) {
  const supervisor::SequenceConfig& sequence = config.supervisor.sequence;
  return {.period_s = config.rig.period_s(),
          .stop_acceleration_rad_per_s2 = StopRate(config),
          .standstill_rad_per_s = sequence.standstill_rad_per_s,
          .landing_ramp_s = sequence.landing_ramp_s,
          .excitation = guards_signals ? scenario::LimitsOf(config.rig, config.law.current_limit_a)
                                       : scenario::GuardLimits{}};
}

/// What amb-controller is made of, without its threads.
class Controller final : public loop::RecordSink {
 public:
  Controller(const LifeRig& rig, const LifePlan& plan, VirtualBench& bench, ControllerView& view)
      : view_(view),
        cycle_(rig.config),
        player_(plan.plays_scenario ? std::make_unique<scenario::ScenarioPlayer>(
                                          plan.scenario, rig.config.rig.period_s(),
                                          rig.config.supervisor.sequence.standstill_rad_per_s)
                                    : nullptr),
        arbiter_(ArbiterOptionsOf(rig.config, plan.guards_signals), player_.get(),
                 {&commands_, &stops_, nullptr}),
        loop_({.pace = loop::Pace::kRealtime, .period_ns = rig.config.rig.period_ns}, bench.port(),
              cycle_, arbiter_, *this, bench.clock()) {}

  void Post(const cycle::CycleRecord& record) noexcept override {
    view_.out = record.out;
    view_.asked = record.in.op;
    view_.released = cycle_.decision().released.fault;
  }
  void Post(const loop::LoopStatistics& /*statistics*/) noexcept override {}

  void Command(RemoteCommand command) {
    command.stops_before = stops_.asked();
    (void)commands_.Post(command);
  }
  void Excite(const scenario::Step& step, double period_s) {
    loop::ExcitationPool::Slot* const slot = shelf_.Put(step, period_s);
    if (slot != nullptr) {
      Command({.command = OperatorCommand::kExcite, .excitation = slot});
    }
  }
  void EmergencyStop(std::int64_t now_ns) { stops_.Ask(std::max<std::int64_t>(now_ns, 1), {}); }
  [[nodiscard]] loop::CommandArbiter& arbiter() { return arbiter_; }
  [[nodiscard]] loop::ControlLoop& loop() { return loop_; }

 private:
  ControllerView& view_;
  cycle::ControlCycle cycle_;
  std::unique_ptr<scenario::ScenarioPlayer> player_;
  SpscRing<RemoteCommand> commands_{16};
  StopLatch stops_;
  loop::ExcitationPool shelf_;
  loop::CommandArbiter arbiter_;
  loop::ControlLoop loop_;
};

class Life {
 public:
  Life(const LifeRig& rig, const LifePlan& plan)
      : rig_(rig),
        plan_(plan),
        judge_(plan, rig.config.supervisor.sequence.standstill_rad_per_s, rig.config.rig.period_ns,
               result_),
        bench_(Options(rig, plan), rig.model) {
    result_.seed = plan.seed;
    result_.kinds = plan.kinds;
    result_.story = plan.story;
    for (const LineTrouble& trouble : plan.frame_troubles) bench_.frames().Disturb(trouble);
    for (const LineTrouble& trouble : plan.current_troubles) bench_.currents().Disturb(trouble);
    bench_.on_wait = [this](std::int64_t now_ns) { Waits(now_ns); };
    bench_.on_sample = [this](std::int64_t now_ns, const plant::Plant& plant, bool energised,
                              SensorFrame& frame) {
      energised_ = energised;
      judge_.Sampled(now_ns, plant, energised, view_);
      Falsify(now_ns, frame);
    };
  }

  LifeResult Run() {
    while (bench_.now_ns() < plan_.length_ns) {
      RunController();
      if (!killed_ || NothingLeft()) break;
      AwaitRevival();
    }
    while (bench_.now_ns() < plan_.length_ns && !NothingLeft()) {
      bench_.Pass(std::min(bench_.now_ns() + kLookNs, plan_.length_ns));
    }
    judge_.Finish();
    return result_;
  }

 private:
  void RunController() {
    Controller controller(rig_, plan_, bench_, view_);
    view_ = {.there = true,
             .since_ns = bench_.now_ns(),
             .out = {},
             .asked = {},
             .released = Fault::kNone};
    controller_ = &controller;
    killed_ = false;
    bench_.Revive();
    controller.loop().Run();
    controller_ = nullptr;
    view_.there = false;
    result_.reduced = controller.arbiter().signals_reduced();
    if (killed_) return;
    judge_.Ended(bench_.now_ns(), bench_.plant());
    SayGoodbye(controller);
  }

  /// As amb-controller does it.
  void SayGoodbye(Controller& controller) {
    CurrentFrame last;
    last.cycle = controller.loop().last().in.frame.cycle;
    last.axes = static_cast<std::uint32_t>(rig_.config.rig.axes());
    last.acceleration_limit_rad_per_s2 = StopRate(rig_.config);
    last.drive_enabled = !controller.arbiter().standing();
    bench_.port().SayGoodbye(last);
  }

  void End() {
    killed_ = true;
    bench_.Kill();
    controller_->loop().Abort();
  }

  void Waits(std::int64_t now_ns) {
    while (!killed_ && next_ < plan_.actions.size() && plan_.actions[next_].at_ns <= now_ns) {
      Act(plan_.actions[next_++], now_ns);
    }
    if (!killed_ && (now_ns >= plan_.length_ns || NothingLeft())) End();
  }

  /// The rotor lies still without current, nobody will lift it, and nothing else is to be done.
  [[nodiscard]] bool NothingLeft() {
    return next_ >= plan_.actions.size() && !energised_ &&
           (!view_.there || view_.out.mode == Mode::kTripped) && bench_.now_ns() > kLookNs &&
           std::abs(bench_.plant().speed_rad_per_s()) <
               rig_.config.supervisor.sequence.standstill_rad_per_s;
  }

  void Act(const Action& action, std::int64_t now_ns) {
    switch (action.deed) {
      case Deed::kCommand:
        return controller_->Command({.command = action.command,
                                     .speed_rad_per_s = RpmToRadPerS(action.speed_rpm),
                                     .acceleration_rad_per_s2 = RpmToRadPerS(action.rpm_per_s)});
      case Deed::kExcite:
        return controller_->Excite(plan_.signals[action.signal], rig_.config.rig.period_s());
      case Deed::kEmergencyStop:
        return controller_->EmergencyStop(now_ns);
      case Deed::kRequestEnd:
        return controller_->arbiter().RequestStop();
      case Deed::kKill:
        return End();
      case Deed::kStall:
        return bench_.Stall(action.duration_ns);
      case Deed::kRestartRig:
        return bench_.RestartRig(action.duration_ns);
      case Deed::kRevive:
        return;
    }
  }

  /// What would have been commanded meanwhile finds nobody.
  void AwaitRevival() {
    while (next_ < plan_.actions.size()) {
      const Action& action = plan_.actions[next_++];
      if (action.deed == Deed::kRestartRig) {
        bench_.Pass(action.at_ns);
        bench_.RestartRig(action.duration_ns);
      }
      if (action.deed != Deed::kRevive) continue;
      bench_.Pass(action.at_ns);
      return;
    }
    bench_.Pass(plan_.length_ns);
  }

  void Falsify(std::int64_t now_ns, SensorFrame& frame) {
    for (const Falsehood& f : plan_.falsehoods) {
      if (now_ns < f.from_ns || now_ns >= f.to_ns) continue;
      switch (f.what) {
        case Falsified::kSpeed:
          frame.speed_rad_per_s = f.value;
          break;
        case Falsified::kSpeedHeld:
          frame.speed_rad_per_s = true_frame_.speed_rad_per_s;
          break;
        case Falsified::kPosition:
          frame.position_m[f.axis] = f.value;
          break;
        case Falsified::kPositionHeld:
          frame.position_m[f.axis] = true_frame_.position_m[f.axis];
          break;
        case Falsified::kStatus:
          frame.rig_status |= f.status;
          break;
      }
    }
    true_frame_ = frame;
  }

  const LifeRig& rig_;
  const LifePlan& plan_;
  LifeResult result_;
  Judge judge_;
  ControllerView view_;
  Controller* controller_{nullptr};
  std::size_t next_{0};
  bool killed_{false};
  bool energised_{false};
  SensorFrame true_frame_;  ///< as it left last, for what sticks
  VirtualBench bench_;
};

}  // namespace

LifeRig LoadLifeRig(const std::string& rig, const std::string& controller) {
  const configuration::RigFile file =
      configuration::LoadRig(configuration::FindConfig(rig, "rigs"));
  std::string name = controller.empty() ? file.run.controller : controller;
  if (name.empty()) name = "flexible_rotor_commissioned";  // the general choice of amb run
  const configuration::ControllerFile law =
      configuration::LoadController(configuration::FindConfig(name, "controllers"), file.numbers);
  return {{file.numbers, law.law, law.supervisor}, plant::Plant(file.plant, 1).shared_model()};
}

LifeResult RunLife(const LifeRig& rig, const LifePlan& plan) { return Life(rig, plan).Run(); }

std::string_view Name(Harm harm) noexcept {
  constexpr std::array<std::string_view, kHarmCount> kNames{"touched_under_current",
                                                            "released_at_speed", "landed_at_speed",
                                                            "left_turning", "not_braked"};
  return kNames[static_cast<std::size_t>(harm)];
}

}  // namespace levitas::lives
