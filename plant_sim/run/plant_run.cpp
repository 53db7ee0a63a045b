#include "plant_sim/run/plant_run.hpp"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <random>
#include <thread>

#include "controller/rt/real_time.hpp"
#include "controller/rt/stop_signal.hpp"
#include "transport/partner_watch.hpp"
#include "transport/statistics_json.hpp"

namespace levitas::plant_run {
namespace {

// A blocked receive is overlooked for at most the period of the lockstep repetition.
constexpr auto kLookEvery = std::chrono::milliseconds(20);

nlohmann::ordered_json Json(const PlantSetup& setup, const PlantStatistics& statistics,
                            const std::vector<rt::RealTimeFact>& facts) {
  const port::RigLink::Counters link = setup.link.counters();
  return {{"pace", setup.options.realtime ? "realtime" : "lockstep"},
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
          {"messages_lost", link.currents_lost},
          {"transport", setup.link.Trouble()},
          {"wakeup", transport::HistogramJson(statistics.wakeup)},
          {"advance", transport::HistogramJson(statistics.advance)},
          {"realtime", rt::Text(facts)}};
}

std::string Text(const RigEvent& event) {
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

void TellEvents(PlantLoop& loop, const char* program) {
  RigEvent event;
  while (loop.TakeEvent(event)) {
    fmt::print(stderr, "{}: cycle {}: {}\n", program, event.cycle, Text(event));
  }
}

// Looks after the loop from the main thread: signals, and whether the controller is there.
ExitStatus Watch(PlantLoop& loop, const std::atomic<bool>& running, const PlantSetup& setup) {
  const char* name = setup.program.name;
  const double timeout_s = setup.options.partner_timeout_s;
  transport::PartnerWatch watch(rt::MonotonicNowNs(), static_cast<std::int64_t>(timeout_s * 1e9));
  using Say = transport::PartnerWatch::Say;
  while (running.load()) {
    std::this_thread::sleep_for(kLookEvery);
    TellEvents(loop, name);
    if (rt::StopSignals() > 0) loop.Stop();
    const Say say = watch.Check(rt::MonotonicNowNs(), loop.heard());
    if (say == Say::kFound) fmt::print(stderr, "{}: controller found\n", name);
    if (say == Say::kMissing) {
      fmt::print(stderr,
                 "{}: no controller answers at {}; start amb-controller with the same --port and "
                 "--pace (giving up {} s after its last message)\n",
                 name, setup.where, timeout_s);
    }
    if (say == Say::kGiveUp && running.load()) {
      fmt::print(stderr, "{}: no controller for {} s, ending\n", name, timeout_s);
      loop.Stop();
      return ExitStatus::kOther;
    }
  }
  return ExitStatus::kDone;
}

void TellEnd(const PlantSetup& setup, const PlantStatistics& statistics) {
  fmt::print(stderr, "{}: {} cycles, {} skipped, {} currents held, {} lost\n", setup.program.name,
             statistics.cycles, statistics.skipped_periods, statistics.held_currents,
             setup.link.counters().currents_lost);
  const std::string trouble = setup.link.Trouble();
  if (!trouble.empty()) fmt::print(stderr, "{}: transport: {}\n", setup.program.name, trouble);
}

/// Empty when real time is neither wanted nor refused.
std::unique_ptr<rt::RealTimeGuard> PrepareRealTime(const PlantSetup& setup) {
  if (!setup.options.realtime) return nullptr;
  auto guard = std::make_unique<rt::RealTimeGuard>(rt::RealTimeOptions{});
  if (guard->complete()) return guard;
  if (setup.options.require_realtime) {
    throw Problem(ExitStatus::kOther, "real time is refused:\n" + rt::Text(guard->facts()));
  }
  fmt::print(stderr, "{}: real time is degraded:\n{}", setup.program.name,
             rt::Text(guard->facts()));
  return guard;
}

}  // namespace

ExitStatus RunPlant(const PlantSetup& setup) {
  const PlantOptions& options = setup.options;
  const RigNumbers& numbers = setup.rig.numbers;
  plant::Plant plant(setup.rig.plant, options.seed);
  scenario::ScenarioConfig scenario;
  if (!options.scenario.empty()) {
    scenario = config::LoadScenario(config::FindConfig(options.scenario, "scenarios"), numbers);
  }
  TimedEvents events(scenario, setup.rig);
  events.Prepare(plant);
  plant.RestInTouchdown();
  rt::MonotonicClock clock;
  PlantLoop loop({.realtime = options.realtime,
                  .period_ns = numbers.period_ns,
                  .rig_session = static_cast<std::uint32_t>(std::random_device{}()),
                  .stay = options.stay,
                  .watchdog_periods = options.watchdog_periods,
                  .silence_ns = setup.silence_ns},
                 plant, setup.link, clock, setup.gate, &events);
  rt::CatchStopSignals();
  const std::unique_ptr<rt::RealTimeGuard> guard = PrepareRealTime(setup);
  fmt::print(stderr, "{}: rig {}, {} axes, {} pace, {}\n", setup.program.name, numbers.name,
             numbers.axes(), options.realtime ? "real-time" : "lockstep", setup.where);
  std::atomic<bool> running{true};
  std::thread thread([&] {
    if (guard) rt::EnterThread({});
    loop.Run();
    running.store(false);
  });
  const ExitStatus status = Watch(loop, running, setup);
  thread.join();
  TellEvents(loop, setup.program.name);
  TellEnd(setup, loop.statistics());
  if (!options.json.empty()) {
    const std::vector<rt::RealTimeFact> none;
    transport::WriteJson(Json(setup, loop.statistics(), guard ? guard->facts() : none),
                         options.json);
  }
  return status;
}

int MainOf(const PlantProgram& program, int argc, char** argv,
           const std::function<ExitStatus(const PlantOptions&)>& run) {
  try {
    PlantOptions options;
    options.watchdog_periods = program.watchdog_periods;
    options.port = program.default_port;
    ExitStatus status = ExitStatus::kDone;
    if (ReadCommandLine(argc, argv, program, options, status)) status = run(options);
    return static_cast<int>(status);
  } catch (const Problem& problem) {
    fmt::print(stderr, "{}: {}\n", program.name, problem.what());
    return static_cast<int>(problem.status());
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", program.name, error.what());
    return static_cast<int>(ExitStatus::kOther);
  }
}

}  // namespace levitas::plant_run
