// amb-rig: the simulated rig behind CAN buses, as a real one stands there, with its own watchdog.
// The rotor starts at rest in the touchdown bearings.

#include <fmt/core.h>

#include <optional>

#include "hil/can_port/can_rig_link.hpp"
#include "hil/rig_lines/rig_lines.hpp"
#include "hil/socketcan/can_connection.hpp"
#include "hil/socketcan/socket_can.hpp"
#include "programs/plant/plant_run.hpp"
#include "rt/say.hpp"

namespace {

using namespace levitas;

// A controller in lockstep answers within milliseconds, or it is dead or stopped.
constexpr std::int64_t kSilenceNs = 1'000'000'000;

constexpr const plant_run::PlantProgram& kProgram = plant_run::kAmbRig;

/// The lines of the rig's file, on chips of gpio-sim.
class LineGate final : public plant_run::AmplifierGate {
 public:
  explicit LineGate(const gpio::LinesConfig& config) : lines_(config) {}
  State Sample(std::int64_t now_ns) noexcept override { return {.open = lines_.Poll(now_ns)}; }
  void Turn(double angle_rad) noexcept override { lines_.Turn(angle_rad); }

 private:
  gpio::RigLines lines_;
};

/// Two rigs on one bus would both send positions, and both obey.
void RefuseRealBus(const plant_run::PlantOptions& options, const configuration::RigFile& rig) {
  const std::string real = socketcan::RealInterface(rig.buses, options.port);
  if (real.empty() || options.on_a_real_bus) return;
  throw Problem(
      ExitStatus::kUsage,
      fmt::format(
          "--port {}: {} is no virtual CAN bus, so a real rig may be there, and a simulated "
          "one would send positions beside it; allowed: a vcan or vxcan, or "
          "--on-a-real-bus when no rig but this one is on it",
          options.port, real));
}

ExitStatus Run(const plant_run::PlantOptions& options) {
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig(options.rig, "rigs"));
  if (!socketcan::IsCanPort(options.port)) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("--port \"{}\": allowed: can, or can:IF[,IF...]; over LCM the simulated "
                    "rig is amb-plant",
                    options.port));
  }
  RefuseRealBus(options, rig);
  if (!options.key.empty()) {
    throw Problem(ExitStatus::kUsage, "--key: frames on a bus carry no seal; leave it out");
  }
  const auto connection =
      socketcan::PlanConnection(rig.numbers, rig.buses, options.rig, options.port);
  rig.plant.delay_samples =
      socketcan::DelayOnBuses(rig.plant.delay_samples, rig.numbers, connection.budget);
  socketcan::SocketCan access(connection.layout, connection.buses, can::Sender::kRig);
  can_port::CanRigLink link(connection.layout, connection.buses, access);
  rt::Say(fmt::format("amb-rig: from sample to current {:.2f} periods, on the wire {:.1f} us of it",
                      rig.plant.delay_samples, connection.budget.transport_s() * 1e6));
  std::optional<LineGate> gate;
  // As the controller: in lockstep time is not the machine's, and the lines' time-outs mean
  // nothing.
  if (!rig.lines.empty() && options.realtime && !options.no_lines) gate.emplace(rig.lines);
  return plant_run::RunPlant({.program = kProgram,
                              .options = options,
                              .rig = rig,
                              .link = link,
                              .where = connection.text,
                              .gate = gate ? &*gate : nullptr,
                              .silence_ns = kSilenceNs});
}

}  // namespace

int main(int argc, char** argv) { return plant_run::MainOf(kProgram, argc, argv, Run); }
