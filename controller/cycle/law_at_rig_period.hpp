#pragma once
// The control law at the period of the rig: the rig's clock decides, whatever the law's file says.
//
// Thread   any; pure, allocates. Failure: none; ControlCycle refuses a law that was discretised
//          for another period.

#include "controller/cycle/control_cycle.hpp"

namespace levitas::cycle {

[[nodiscard]] inline law::LawConfig LawAtRigPeriod(const CycleConfig& config) {
  law::LawConfig law = config.law;
  law.period_s = config.rig.period_s();
  return law;
}

}  // namespace levitas::cycle
