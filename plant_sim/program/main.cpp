// amb-plant: the simulated rig as a process. The rotor starts at rest in the touchdown bearings.

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <random>
#include <thread>

#include "common/problem.hpp"
#include "config/rig_file.hpp"
#include "controller/rt/real_time.hpp"
#include "controller/rt/stop_signal.hpp"
#include "plant_sim/program/plant_loop.hpp"
#include "plant_sim/program/plant_options.hpp"
#include "transport/partner_watch.hpp"
#include "transport/statistics_json.hpp"

namespace levitas::plant_program {
namespace {

// A blocked receive is overlooked for at most the period of the lockstep repetition.
constexpr auto kLookEvery = std::chrono::milliseconds(20);
// Longer than an answer takes across two cores; see docs/timing.md.
constexpr std::int64_t kSpinNs = 20'000;

nlohmann::ordered_json Json(const PlantStatistics& statistics,
                            const transport::LcmRigLink::Counters& link,
                            const PlantOptions& options,
                            const std::vector<rt::RealTimeFact>& facts) {
  return {{"pace", options.realtime ? "realtime" : "lockstep"},
          {"seed", options.seed},
          {"cycles", statistics.cycles},
          {"skipped_periods", statistics.skipped_periods},
          {"held_currents", statistics.held_currents},
          {"watchdog_trips", statistics.watchdog_trips},
          {"repeated_frames", statistics.repeated_frames},
          {"stale_currents", statistics.stale_currents},
          {"frames_sent", link.frames_sent},
          {"send_failures", link.send_failures},
          {"currents_read", link.currents_read},
          {"currents_skipped", link.currents_skipped},
          {"currents_rejected", link.currents_rejected},
          {"messages_lost", link.currents_lost},
          {"wakeup", transport::HistogramJson(statistics.wakeup)},
          {"advance", transport::HistogramJson(statistics.advance)},
          {"realtime", rt::Text(facts)}};
}

// Looks after the loop from the main thread: signals, and whether the controller is there.
ExitStatus Watch(PlantLoop& loop, const std::atomic<bool>& running, const PlantOptions& options,
                 const std::string& url) {
  transport::PartnerWatch watch(rt::MonotonicNowNs(),
                                static_cast<std::int64_t>(options.partner_timeout_s * 1e9));
  using Say = transport::PartnerWatch::Say;
  while (running.load()) {
    std::this_thread::sleep_for(kLookEvery);
    if (rt::StopSignals() > 0) loop.Stop();
    const Say say = watch.Check(rt::MonotonicNowNs(), loop.heard());
    if (say == Say::kFound) fmt::print(stderr, "amb-plant: controller found\n");
    if (say == Say::kMissing) {
      fmt::print(stderr,
                 "amb-plant: no controller answers at {}; start amb-controller with the same "
                 "--port and --pace (giving up {} s after its last message)\n",
                 url, options.partner_timeout_s);
    }
    if (say == Say::kGiveUp && running.load()) {
      fmt::print(stderr, "amb-plant: no controller for {} s, ending\n", options.partner_timeout_s);
      loop.Stop();
      return ExitStatus::kOther;
    }
  }
  return ExitStatus::kDone;
}

ExitStatus Run(const PlantOptions& options) {
  const config::RigFile rig = config::LoadRig(config::FindConfig(options.rig, "rigs"));
  const transport::LcmNetwork network = transport::ParseLcmNetwork(options.port);
  plant::Plant plant(rig.plant, options.seed);
  plant.RestInTouchdown();
  transport::LcmRigLink link(network, rig.numbers.axes(), kSpinNs);
  rt::MonotonicClock clock;
  PlantLoop loop({.realtime = options.realtime,
                  .period_ns = rig.numbers.period_ns,
                  .rig_session = static_cast<std::uint32_t>(std::random_device{}()),
                  .stay = options.stay},
                 plant, link, clock);
  rt::CatchStopSignals();
  std::vector<rt::RealTimeFact> facts;
  std::atomic<bool> running{true};
  std::thread thread;
  const auto network_url = network.Url(transport::Direction::kCurrent);
  std::unique_ptr<rt::RealTimeGuard> guard;
  if (options.realtime) {
    guard = std::make_unique<rt::RealTimeGuard>(rt::RealTimeOptions{});
    facts = guard->facts();
    if (!guard->complete()) {
      fmt::print(stderr, "amb-plant: real time is {}:\n{}",
                 options.require_realtime ? "refused" : "degraded", rt::Text(facts));
      if (options.require_realtime) return ExitStatus::kOther;
    }
  }
  fmt::print(stderr, "amb-plant: rig {}, {} axes, {} pace, {}\n", rig.numbers.name,
             rig.numbers.axes(), options.realtime ? "real-time" : "lockstep", options.port);
  thread = std::thread([&] {
    if (guard) rt::EnterThread({});
    loop.Run();
    running.store(false);
  });
  const ExitStatus status = Watch(loop, running, options, network_url);
  thread.join();
  const PlantStatistics& statistics = loop.statistics();
  fmt::print(stderr, "amb-plant: {} cycles, {} skipped, {} currents held, {} lost\n",
             statistics.cycles, statistics.skipped_periods, statistics.held_currents,
             link.counters().currents_lost);
  if (!options.json.empty()) {
    transport::WriteJson(Json(statistics, link.counters(), options, facts), options.json);
  }
  return status;
}

}  // namespace
}  // namespace levitas::plant_program

int main(int argc, char** argv) {
  using namespace levitas;
  try {
    plant_program::PlantOptions options;
    ExitStatus status = ExitStatus::kDone;
    if (!plant_program::ReadCommandLine(argc, argv, options, status))
      return static_cast<int>(status);
    return static_cast<int>(plant_program::Run(options));
  } catch (const Problem& problem) {
    fmt::print(stderr, "amb-plant: {}\n", problem.what());
    return static_cast<int>(problem.status());
  } catch (const std::exception& error) {
    fmt::print(stderr, "amb-plant: {}\n", error.what());
    return static_cast<int>(ExitStatus::kOther);
  }
}
