// Controller and rig as two processes, joined by a port of one's own (socket_port.hpp). The loops
// of both are the product's: here in lockstep, each frame answered before simulated time goes on.

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "configuration/rig_file.hpp"
#include "controller/loop/control_loop.hpp"
#include "controller/scenario/scenario_player.hpp"
#include "plant_sim/loop/plant_loop.hpp"
#include "socket_port.hpp"

using namespace levitas;

namespace {

/// The operator: a scenario file.
class Player final : public loop::OperatorSource {
 public:
  Player(const scenario::ScenarioConfig& scenario, const RigNumbers& rig,
         double standstill_rad_per_s)
      : player_(scenario, rig.period_s(), standstill_rad_per_s) {}
  [[nodiscard]] cycle::OperatorInput Next(const loop::OperatorView& view) noexcept override {
    const auto asked = player_.Next(view.mode, view.speed_rad_per_s, view.fault,
                                    view.command_refused, view.radius_m, view.standing);
    return {asked.command, asked.speed_rad_per_s, asked.acceleration_rad_per_s2, asked.excitation_a,
            asked.excitation_m};
  }
  [[nodiscard]] bool Done() const noexcept override {
    return player_.finished() || player_.failed();
  }
  [[nodiscard]] std::string Trouble() const { return player_.Text(); }

 private:
  scenario::ScenarioPlayer player_;
};

/// What a recorder would keep: here the largest orbit of the levitated rotor.
class Watch final : public loop::RecordSink {
 public:
  void Post(const cycle::CycleRecord& record) noexcept override {
    if (record.out.mode != Mode::kLevitating) return;
    for (std::size_t x = 0; x < record.in.frame.axes; x += 2) {
      const AxisArray& at_m = record.in.frame.position_m;
      largest_m = std::max(largest_m, std::hypot(at_m[x], at_m[x + 1]));
    }
  }
  void Post(const loop::LoopStatistics&) noexcept override {}
  double largest_m{};
};

int RunRig(int descriptor) {
  const auto rig = configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  plant::Plant plant(rig.plant, /*seed=*/1);
  plant.RestInTouchdown();
  SocketLink link(descriptor);
  rt::MonotonicClock clock;
  plant_run::PlantLoop rig_loop({.period_ns = rig.numbers.period_ns, .rig_session = 1}, plant, link,
                                clock);
  rig_loop.Run();
  return 0;
}

int RunController(int descriptor) {
  const auto rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs")).numbers;
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig);
  cycle::ControlCycle control({rig, controller.law, controller.supervisor});
  Player player(
      configuration::LoadScenario(configuration::FindConfig("levitate", "scenarios"), rig), rig,
      controller.supervisor.sequence.standstill_rad_per_s);
  SocketPort port(descriptor);
  Watch watch;
  rt::MonotonicClock clock;
  loop::ControlLoop control_loop({.pace = loop::Pace::kLockstep, .period_ns = rig.period_ns}, port,
                                 control, player, watch, clock);
  port.when_gone = [&control_loop] { control_loop.Abort(); };
  control_loop.Run();
  if (port.gone()) throw std::runtime_error("the rig has gone");
  port.SayGoodbye({});
  std::printf("%llu cycles, largest orbit %.1f um, %s\n",
              static_cast<unsigned long long>(control_loop.statistics().cycles),
              1e6 * watch.largest_m, Name(control_loop.last().out.mode).data());
  if (!player.Trouble().empty()) std::printf("%s\n", player.Trouble().c_str());
  return player.Trouble().empty() ? 0 : 4;
}

}  // namespace

int main() try {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0) throw std::runtime_error("no socket pair");
  const pid_t rig = fork();
  if (rig < 0) throw std::runtime_error("no second process");
  close(ends[rig == 0 ? 0 : 1]);
  if (rig == 0) return RunRig(ends[1]);
  const int status = RunController(ends[0]);
  (void)waitpid(rig, nullptr, 0);
  return status;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
