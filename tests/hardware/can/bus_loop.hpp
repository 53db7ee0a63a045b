#pragma once
// The shipped rig and its commissioned controller in one thread, with a bus of the kernel between:
// period by period, so that a fault lies in a known cycle.

#include <iostream>
#include <memory>
#include <string>

#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "hil/can_port/can_rig_link.hpp"
#include "hil/can_port/can_rig_port.hpp"
#include "hil/socketcan/can_connection.hpp"
#include "hil/socketcan/socket_can.hpp"
#include "plant_sim/plant/command_of.hpp"
#include "plant_sim/plant/plant.hpp"
#include "rt/clock.hpp"

namespace levitas::test {

class BusLoop {
 public:
  static constexpr std::uint32_t kWatchdogPeriods = 20;

  /// `controller_port`: where that differs, as at the two ends of a wire.
  /// `orbit_fraction` of the clearance, beyond which it trips; 0: that of the shipped controller.
  explicit BusLoop(const std::string& port, const std::string& controller_port = "",
                   double orbit_fraction = 0.0)
      : rig_file_(configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"))),
        plan_(
            socketcan::PlanConnection(rig_file_.numbers, rig_file_.buses, "flexible_rotor", port)),
        controller_plan_(
            socketcan::PlanConnection(rig_file_.numbers, rig_file_.buses, "flexible_rotor",
                                      controller_port.empty() ? port : controller_port)),
        rig_bus_(plan_.layout, plan_.buses, can::Sender::kRig),
        controller_bus_(controller_plan_.layout, controller_plan_.buses, can::Sender::kController),
        link_(plan_.layout, plan_.buses, rig_bus_),
        port_(controller_plan_.layout, controller_plan_.buses, {}, controller_bus_),
        control_(CycleOf(rig_file_, orbit_fraction)),
        plant_(Delayed(rig_file_, plan_), 1) {
    plant_.RestInTouchdown();
  }

  /// One period. The rig is silent when `rig_sends` is false.
  const cycle::CycleOutputs& Step(OperatorCommand command = OperatorCommand::kNone,
                                  bool rig_sends = true) {
    SensorFrame frame = plant_.Sample();
    frame.cycle = cycles;
    frame.rig_session = 1;
    if (held_ > 0) frame.rig_status |= kRigCurrentHeld;
    if (rig_sends) link_.Send(frame);
    if (between) between();
    in_.cycle = cycles;
    in_.frame_present = port_.Read(in_.frame, 0) == port::ReadResult::kFrame;
    in_.op.command = command;
    out = control_.Step(in_);
    port_.Write(out.current);
    Answer();
    plant_.Advance(command_);
    ++cycles;
    return out;
  }

  /// Lifts and settles; false when the rotor does not levitate.
  bool Levitate() {
    Step(OperatorCommand::kLift);
    while (cycles < 40'000 && out.mode != Mode::kLevitating) Step();
    for (int settle = 0; settle < 500; ++settle) Step();
    return out.mode == Mode::kLevitating && out.fault == Fault::kNone;
  }
  /// Cycles until the amplifiers are off, counted from now; -1 when it does not happen in `limit`.
  int StepsUntilOff(int limit, bool rig_sends = true) {
    for (int step = 1; step <= limit; ++step) {
      Step(OperatorCommand::kNone, rig_sends);
      if (!out.current.amplifiers_enabled) return step;
    }
    return -1;
  }

  [[nodiscard]] const can_port::CanRigPort& port() const { return port_; }
  [[nodiscard]] can_port::CanRigLink& link() { return link_; }
  [[nodiscard]] const can::Layout& layout() const { return plan_.layout; }
  [[nodiscard]] bool rig_energised() const { return command_.amplifiers_enabled; }

  std::function<void()> between;  ///< after the rig has sent, before the controller reads
  cycle::CycleOutputs out;
  std::uint64_t cycles{0};

 private:
  static cycle::CycleConfig CycleOf(const configuration::RigFile& rig, double orbit_fraction) {
    auto controller = configuration::LoadController(
        configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
    if (orbit_fraction > 0.0) controller.supervisor.protection.orbit_fraction = orbit_fraction;
    return {rig.numbers, controller.law, controller.supervisor};
  }
  static plant::PlantConfig Delayed(configuration::RigFile rig,
                                    const socketcan::CanConnection& plan) {
    rig.plant.delay_samples =
        socketcan::DelayOnBuses(rig.plant.delay_samples, rig.numbers, plan.budget);
    return rig.plant;
  }
  /// The rig's side of the answer: hold, and the watchdog.
  void Answer() {
    CurrentFrame current;
    if (link_.Receive(current, 0) == port::RigLink::ReceiveResult::kNothing) {
      if (++held_ >= kWatchdogPeriods) command_ = {.amplifiers_enabled = false};
      return;
    }
    held_ = 0;
    command_ = plant::CommandOf(current);
  }

  configuration::RigFile rig_file_;
  socketcan::CanConnection plan_;
  socketcan::CanConnection controller_plan_;
  socketcan::SocketCan rig_bus_;
  socketcan::SocketCan controller_bus_;
  can_port::CanRigLink link_;
  can_port::CanRigPort port_;
  cycle::ControlCycle control_;
  plant::Plant plant_;
  cycle::CycleInputs in_;
  plant::PlantCommand command_{.amplifiers_enabled = false};
  std::uint32_t held_{0};
};

}  // namespace levitas::test
