#include "programs/controller/rig_connection.hpp"

#include <cmath>
#include <optional>

#include "hil/can_port/can_rig_port.hpp"
#include "hil/socketcan/can_connection.hpp"
#include "hil/socketcan/socket_can.hpp"
#include "rt/clock.hpp"
#include "transport/lcm_rig_port.hpp"
#include "transport/network_key.hpp"

namespace levitas::controller_program {
namespace {

constexpr std::int64_t kSpinNs = 20'000;  // see docs/timing.md

class LcmConnection final : public RigConnection {
 public:
  LcmConnection(const transport::LcmNetwork& network, std::size_t axes)
      : network_(network), port_(network, axes, rt::AllowedSpinNs(kSpinNs)) {}
  port::RigPort& port() noexcept override { return port_; }
  [[nodiscard]] std::string Where() const override {
    return network_.Url(transport::Direction::kSensor);
  }
  [[nodiscard]] const char* SimulatedRig() const noexcept override { return "amb-plant"; }
  [[nodiscard]] bool virtual_rig() const noexcept override { return true; }
  [[nodiscard]] std::int64_t phase_ns() const noexcept override { return can::kArrivalNs; }

 private:
  transport::LcmNetwork network_;
  transport::LcmRigPort port_;
};

class CanPortConnection final : public RigConnection {
 public:
  CanPortConnection(const socketcan::CanConnection& plan, bool realtime, double delay_periods)
      : text_(plan.text),
        virtual_bus_(plan.virtual_bus),
        wire_ns_(plan.virtual_bus ? 0 : std::llround(plan.budget.from_rig_s * 1e9)),
        access_(plan.layout, plan.buses, can::Sender::kController),
        port_(plan.layout, plan.buses, {.realtime = realtime, .wire_ns = wire_ns_}, access_) {
    if (realtime) delay_.emplace(plan, delay_periods);
  }
  port::RigPort& port() noexcept override { return port_; }
  [[nodiscard]] std::string Where() const override { return text_; }
  [[nodiscard]] const char* SimulatedRig() const noexcept override { return "amb-rig"; }
  [[nodiscard]] bool virtual_rig() const noexcept override { return virtual_bus_; }
  [[nodiscard]] std::string TakeNews() override {
    std::string news = port_.TakeNews();
    return news.empty() && delay_ ? delay_->TakeNews() : news;
  }
  [[nodiscard]] const DelayWatch* delay() const noexcept override {
    return delay_ ? &*delay_ : nullptr;
  }
  [[nodiscard]] std::int64_t phase_ns() const noexcept override {
    return can::kArrivalNs + wire_ns_;
  }

 private:
  std::string text_;
  bool virtual_bus_;
  std::int64_t wire_ns_;
  socketcan::SocketCan access_;
  can_port::CanRigPort port_;
  std::optional<DelayWatch> delay_;
};

}  // namespace

transport::LcmNetwork TelemetryNetwork(const ControllerOptions& options) {
  if (!socketcan::IsCanPort(options.port)) {
    auto network = transport::ParseLcmNetwork(options.port, "can, can:IF[,IF...], ");
    transport::TakeKey(network, options.key, "play the rig");
    return network;
  }
  auto network = transport::ParseLcmNetwork(options.telemetry.empty() ? "lcm" : options.telemetry);
  // Without commands only telemetry leaves; with them, DecideCommands asks for the key.
  if (!options.key.empty()) network.key = transport::NetworkKey::Load(options.key);
  return network;
}

void ApplyPort(const ControllerOptions& options, configuration::RigFile& rig) {
  if (!socketcan::IsCanPort(options.port)) return;
  if (!options.realtime) socketcan::RefuseLockstep(rig.buses, options.port);
  const auto connection =
      socketcan::PlanConnection(rig.numbers, rig.buses, options.rig, options.port);
  rig.plant.delay_samples =
      socketcan::DelayOnBuses(rig.plant.delay_samples, rig.numbers, connection.budget);
}

std::unique_ptr<RigConnection> Connect(const ControllerOptions& options,
                                       const configuration::RigFile& rig) {
  if (!socketcan::IsCanPort(options.port)) {
    return std::make_unique<LcmConnection>(TelemetryNetwork(options), rig.numbers.axes());
  }
  return std::make_unique<CanPortConnection>(
      socketcan::PlanConnection(rig.numbers, rig.buses, options.rig, options.port),
      options.realtime, rig.plant.delay_samples);
}

}  // namespace levitas::controller_program
