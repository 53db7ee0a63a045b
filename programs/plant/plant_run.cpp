#include "programs/plant/plant_run.hpp"

#include <fmt/core.h>

#include <chrono>
#include <memory>
#include <random>
#include <thread>

#include "plant_sim/loop/torsion_gauge.hpp"
#include "rt/limits.hpp"
#include "rt/real_time.hpp"
#include "rt/say.hpp"
#include "rt/stop_signal.hpp"
#include "rt/thread_trouble.hpp"
#include "transport/partner_watch.hpp"
#include "transport/statistics_json.hpp"

namespace levitas::plant_run {
namespace {

// A blocked receive is overlooked for at most the period of the lockstep repetition.
constexpr auto kLookEvery = std::chrono::milliseconds(20);

nlohmann::ordered_json Json(const PlantSetup& setup, const PlantStatistics& statistics,
                            const std::vector<rt::RealTimeFact>& facts) {
  const port::RigLink::Counters link = setup.link.counters();
  return {{"pace", PaceName(setup.options)},
          {"pace_factor", setup.options.pace_factor},
          {"seed", setup.options.seed},
          {"delay_samples", setup.rig.plant.delay_samples},
          {"cycles", statistics.cycles},
          {"skipped_periods", statistics.skipped_periods},
          {"held_currents", statistics.held_currents},
          {"watchdog_trips", statistics.watchdog_trips},
          {"landings", statistics.landings},
          {"repeated_frames", statistics.repeated_frames},
          {"stale_currents", statistics.stale_currents},
          {"frames_sent", link.frames_sent},
          {"send_failures", link.send_failures},
          {"currents_read", link.currents_read},
          {"currents_skipped", link.currents_skipped},
          {"currents_rejected", link.currents_rejected},
          {"currents_refused", link.currents_refused},
          {"messages_lost", link.currents_lost},
          {"transport", setup.link.Trouble()},
          {"wakeup", transport::HistogramJson(statistics.wakeup)},
          {"advance", transport::HistogramJson(statistics.advance)},
          {"realtime", rt::Text(facts)}};
}

std::string Text(const RigNotice& event) {
  switch (event.kind) {
    case RigEventKind::kEnergised:
      return "amplifiers on";
    case RigEventKind::kSwitchedOff:
      return "amplifiers off, as commanded";
    case RigEventKind::kGateShut:
      return "amplifiers off: the enable line or its heartbeat is not there";
    case RigEventKind::kWatchdog:
      return fmt::format("amplifiers off: no valid current for {:.0f} periods", event.value);
    case RigEventKind::kRearmed:
      return "watchdog rearmed: a controller asked for amplifiers off";
    case RigEventKind::kLanded:
      return fmt::format("the rotor lies on its touchdown bearings, first contact {:.0f} N",
                         event.value);
  }
  return "";
}

std::string PaceText(const PlantOptions& options) {
  if (options.realtime) return "real-time";
  if (options.pace_factor <= 0.0) return "lockstep";
  return fmt::format("{:g} x the clock's", options.pace_factor);
}

void TellEvents(PlantLoop& loop, const char* program) {
  RigNotice event;
  while (loop.TakeEvent(event)) {
    rt::Say(fmt::format("{}: cycle {}: {}", program, event.cycle, Text(event)));
  }
}

void TellNews(const PlantSetup& setup) {
  const std::string news = setup.link.TakeNews();
  if (!news.empty()) rt::Say(fmt::format("{}: {}", setup.program.name, news));
}

// Looks after the loop from the main thread: signals, and whether the controller is there.
class Watchman {
 public:
  Watchman(PlantLoop& loop, const PlantSetup& setup)
      : loop_(loop),
        setup_(setup),
        timeout_s_(setup.options.partner_timeout_s),
        controller_(rt::MonotonicNowNs(), static_cast<std::int64_t>(timeout_s_ * 1e9)) {}

  ExitStatus Watch(const std::atomic<bool>& running) noexcept {
    while (running.load()) {
      std::this_thread::sleep_for(kLookEvery);
      rt::Guarded("main", [&] {
        TellEvents(loop_, setup_.program.name);
        TellNews(setup_);
        if (running.load()) Look();
      });
    }
    return status_;
  }

 private:
  void Look() {
    HeedSignals();
    if (status_ != ExitStatus::kDone) return;
    const char* name = setup_.program.name;
    using Word = transport::PartnerWatch::Say;
    const Word word = controller_.Check(rt::MonotonicNowNs(), loop_.heard());
    if (word == Word::kFound) rt::Say(fmt::format("{}: controller found", name));
    if (word == Word::kMissing) {
      rt::Say(
          fmt::format("{}: no controller answers at {}; start amb-controller with the same --port "
                      "and --pace (giving up {} s after its last message)",
                      name, setup_.where, timeout_s_));
    }
    if (word != Word::kGiveUp) return;
    rt::Say(fmt::format("{}: no controller for {} s, ending", name, timeout_s_));
    loop_.Stop();
    status_ = ExitStatus::kOther;
  }

  // A controller that is there has been asked too, or its rotor is in its hands: the rig stays
  // until the amplifiers are off and the drive brakes no more, else the first to end would be the
  // one that the rotor needs.
  void HeedSignals() {
    const int asked = rt::StopSignals();
    if (asked == 0 && !rt::QuitSignal() && rt::Troubles() == 0) return;
    const bool holds = (loop_.energised() || loop_.driven()) && controller_.present();
    if (!asked_) {
      asked_ = true;
      if (holds) {
        rt::Say(
            fmt::format("{}: asked to end: staying until the controller has switched the "
                        "amplifiers off (the same signal again ends at once)",
                        setup_.program.name));
      }
    }
    if (asked > 1 || rt::QuitSignal() || !holds) loop_.Stop();
  }

  PlantLoop& loop_;
  const PlantSetup& setup_;
  double timeout_s_;
  transport::PartnerWatch controller_;
  bool asked_{false};  ///< to end
  ExitStatus status_{ExitStatus::kDone};
};

void TellEnd(const PlantSetup& setup, const PlantStatistics& statistics) {
  rt::Say(fmt::format("{}: {} cycles, {} skipped, {} currents held, {} lost", setup.program.name,
                      statistics.cycles, statistics.skipped_periods, statistics.held_currents,
                      setup.link.counters().currents_lost),
          rt::Speaker::Kind::kReport);
  const std::string trouble = setup.link.Trouble();
  if (!trouble.empty()) rt::Say(fmt::format("{}: transport: {}", setup.program.name, trouble));
}

/// Empty when real time is neither wanted nor refused.
std::unique_ptr<rt::RealTimeGuard> PrepareRealTime(const PlantSetup& setup) {
  if (!setup.options.realtime) return nullptr;
  auto guard = std::make_unique<rt::RealTimeGuard>(rt::RealTimeOptions{});
  if (guard->complete()) return guard;
  if (setup.options.require_realtime) {
    throw Problem(ExitStatus::kOther, "real time is refused:\n" + rt::Text(guard->facts()));
  }
  rt::Say(
      fmt::format("{}: real time is degraded:\n{}", setup.program.name, rt::Text(guard->facts())));
  return guard;
}

/// Empty when none is asked for.
scenario::ScenarioConfig ScenarioOf(const PlantOptions& options, const RigNumbers& numbers) {
  scenario::ScenarioConfig scenario;
  if (!options.scenario.empty()) {
    scenario = configuration::LoadScenario(configuration::FindConfig(options.scenario, "scenarios"),
                                           numbers);
  }
  return scenario;
}

}  // namespace

ExitStatus RunPlant(const PlantSetup& setup) {
  const PlantOptions& options = setup.options;
  const RigNumbers& numbers = setup.rig.numbers;
  plant::Plant plant(setup.rig.plant, options.seed);
  const scenario::ScenarioConfig scenario = ScenarioOf(options, numbers);
  TimedEvents events(scenario, setup.rig.numbers, setup.rig.plant);
  events.Prepare(plant);
  plant.RestInTouchdown();
  TorsionGauge torsion(plant.model(), options.seed);
  rt::MonotonicClock clock;
  PlantLoop loop({.realtime = options.realtime,
                  .pace_factor = options.pace_factor,
                  .period_ns = numbers.period_ns,
                  .rig_session = static_cast<std::uint32_t>(std::random_device{}()),
                  .stay = options.stay,
                  .watchdog_periods = options.watchdog_periods,
                  .silence_ns = setup.silence_ns},
                 plant, setup.link, clock, setup.gate, &events,
                 torsion.fitted() ? &torsion : nullptr);
  const std::unique_ptr<rt::RealTimeGuard> guard = PrepareRealTime(setup);
  rt::Say(fmt::format("{}: rig {}, {} axes, {} pace, {}", setup.program.name, numbers.name,
                      numbers.axes(), PaceText(options), setup.where));
  std::atomic<bool> running{true};
  std::thread thread([&] {
    if (guard) rt::Guarded("loop", [] { rt::EnterThread({}); });
    loop.Run();
    running.store(false);
  });
  const ExitStatus status = Watchman(loop, setup).Watch(running);
  thread.join();
  TellEvents(loop, setup.program.name);
  TellEnd(setup, loop.statistics());
  if (!options.json.empty()) {
    const std::vector<rt::RealTimeFact> none;
    transport::WriteJson("plant", Json(setup, loop.statistics(), guard ? guard->facts() : none),
                         options.json);
  }
  return status;
}

namespace {

int Checked(const PlantProgram& program, int argc, char** argv,
            const std::function<ExitStatus(const PlantOptions&)>& run) {
  try {
    PlantOptions options;
    ExitStatus status = ExitStatus::kDone;
    if (ReadCommandLine(argc, argv, program, options, status)) status = run(options);
    return static_cast<int>(status);
  } catch (const Problem& problem) {
    rt::Say(fmt::format("{}: {}", program.name, problem.what()));
    return static_cast<int>(problem.status());
  } catch (const std::exception& error) {
    rt::Say(fmt::format("{}: {}", program.name, error.what()));
    return static_cast<int>(ExitStatus::kOther);
  }
}

}  // namespace

int MainOf(const PlantProgram& program, int argc, char** argv,
           const std::function<ExitStatus(const PlantOptions&)>& run) {
  rt::OpenStandardFiles();
  if (!rt::EnsureStack(program.name)) return static_cast<int>(ExitStatus::kOther);
  rt::CatchStopSignals();
  const int status = Checked(program, argc, argv, run);
  static_cast<void>(rt::FlushSaid());
  return status;
}

}  // namespace levitas::plant_run
