#pragma once
// The shipped rig and its commissioned controller in one thread, in virtual time: the port and the
// link of the CAN buses between them, on a bus that a test holds in its hand.
//
// Frame   bearing frame. Units: SI.

#include <cmath>
#include <functional>
#include <string>

#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "hil/can_port/can_rig_link.hpp"
#include "hil/can_port/can_rig_port.hpp"
#include "hil/socketcan/can_connection.hpp"
#include "plant_sim/plant/command_of.hpp"
#include "plant_sim/plant/plant.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/can_port/fake_bus.hpp"

namespace levitas::test {

class CanLoop {
 public:
  static constexpr std::uint32_t kWatchdogPeriods = 20;  // of amb-rig

  CanLoop()
      : rig_(configuration::LoadRig(SourceFolder() + "/config/rigs/flexible_rotor.yaml")),
        plan_(socketcan::PlanConnection(rig_.numbers, rig_.buses, "flexible_rotor", "can:vcan0",
                                        [](const std::string&) { return true; })),
        link_(plan_.layout, plan_.buses, rig_bus),
        port_(plan_.layout, plan_.buses, {}, controller_bus),
        control_(CycleOf(rig_)),
        plant(Delayed(rig_, plan_), 1) {
    rig_bus.other = &controller_bus;
    controller_bus.other = &rig_bus;
    plant.RestInTouchdown();
  }

  const cycle::CycleOutputs& Step(cycle::OperatorInput op = {}) {
    SensorFrame frame = plant.Sample();
    frame.cycle = cycles;
    frame.rig_session = 1;
    frame.held_currents = held_in_all_;
    if (held_ > 0) frame.rig_status |= kRigCurrentHeld;
    if (!command_.amplifiers_enabled) frame.rig_status |= kRigAmplifiersOff;
    if (disturb) disturb(frame);
    link_.Send(frame);
    if (to_controller) to_controller();
    cycle::CycleInputs in;
    in.cycle = cycles;
    in.frame = last_;
    in.frame_present = port_.Read(in.frame, 0) == port::ReadResult::kFrame;
    last_ = in.frame;
    in.op = op;
    out = control_.Step(in);
    port_.Write(out.current);
    if (to_rig) to_rig();
    Answer();
    plant.Advance(command_);
    if (turning() && command_.amplifiers_enabled && plant.ContactForce() > 0.0) ++driven_contact;
    if (energised_ && !command_.amplifiers_enabled) released_rpm = speed_rpm();
    energised_ = command_.amplifiers_enabled;
    if (turning() && out.fault != Fault::kNone && !command_.drive_enabled) ++unbraked;
    if (turning() && out.reference_m != AxisArray{}) ++lowered;
    ++cycles;
    return out;
  }
  bool RunUntil(double limit_s, const std::function<bool()>& done) {
    for (long n = std::lround(limit_s * 1e4); n > 0; --n) {
      (void)Step();
      if (done()) return true;
    }
    return false;
  }
  void Command(OperatorCommand command, double speed_rpm = 0.0, double rpm_per_s = 0.0) {
    (void)Step({command, RpmToRadPerS(speed_rpm), RpmToRadPerS(rpm_per_s), {}});
  }
  /// From rest to this speed by the drive, levitated.
  [[nodiscard]] bool TurnAt(double rpm) {
    Command(OperatorCommand::kLift);
    if (!RunUntil(5.0, [this] { return out.mode == Mode::kLevitating; })) return false;
    Command(OperatorCommand::kSpin, rpm, 2000.0);
    if (!RunUntil(5.0, [&] { return speed_rpm() > 0.999 * rpm; })) return false;
    driven_contact = 0;
    return out.fault == Fault::kNone;
  }
  /// What the controller heard last.
  [[nodiscard]] const SensorFrame& heard() const { return last_; }
  [[nodiscard]] bool Stands() const { return std::abs(speed_rpm()) <= kStandstillRpm; }
  [[nodiscard]] double speed_rpm() const { return RadPerSToRpm(plant.speed_rad_per_s()); }
  [[nodiscard]] const can_port::CanRigPort& port() const { return port_; }

  can_port::FakeBus rig_bus;
  can_port::FakeBus controller_bus;
  std::function<void(SensorFrame&)> disturb;  ///< what the rig reads of itself
  std::function<void()> to_controller;        ///< after the rig has sent
  std::function<void()> to_rig;               ///< after the controller has sent
  cycle::CycleOutputs out;
  std::uint64_t cycles{0};
  int driven_contact{0};      ///< periods of contact while turning, amplifiers on
  int lowered{0};             ///< periods of turning with a reference beside the centre
  int unbraked{0};            ///< periods of turning after a trip without the drive
  double released_rpm{-1.0};  ///< where the amplifiers went off

 private:
  static constexpr double kStandstillRpm = 5.0;  // of the controller file

  static cycle::CycleConfig CycleOf(const configuration::RigFile& rig) {
    const auto controller = configuration::LoadController(
        SourceFolder() + "/config/controllers/flexible_rotor_commissioned.yaml", rig.numbers);
    return {rig.numbers, controller.law, controller.supervisor};
  }
  static plant::PlantConfig Delayed(configuration::RigFile rig,
                                    const socketcan::CanConnection& plan) {
    rig.plant.delay_samples =
        socketcan::DelayOnBuses(rig.plant.delay_samples, rig.numbers, plan.budget);
    return rig.plant;
  }
  [[nodiscard]] bool turning() const { return std::abs(speed_rpm()) > 2.0 * kStandstillRpm; }
  void Answer() {
    CurrentFrame current;
    if (link_.Receive(current, 0) == port::RigLink::ReceiveResult::kNothing) {
      ++held_in_all_;
      if (++held_ >= kWatchdogPeriods) command_.amplifiers_enabled = false;
      return;
    }
    held_ = 0;
    command_ = plant::CommandOf(current);
  }

  configuration::RigFile rig_;
  socketcan::CanConnection plan_;
  can_port::CanRigLink link_;
  can_port::CanRigPort port_;
  cycle::ControlCycle control_;
  SensorFrame last_;
  plant::PlantCommand command_{.amplifiers_enabled = false};
  std::uint32_t held_{0};
  std::uint32_t held_in_all_{0};
  bool energised_{false};

 public:
  plant::Plant plant;
};

}  // namespace levitas::test
