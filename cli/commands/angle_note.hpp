#pragma once
// What a judgement of synchronous control leaves out where the rotor's angle is not measured.
//
// Thread   any; pure.

#include <string_view>

#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::cli {

/// Continues a sentence; nothing where the angle is the rig's.
[[nodiscard]] inline std::string_view AngleNote(const synchronous::SynchronousConfig& control) {
  using synchronous::AngleSource;
  switch (control.angle.source) {
    case AngleSource::kRig:
      break;
    case AngleSource::kSpeed:
      return "; the measured speed is taken as the rotor's own";
    case AngleSource::kOrbit:
      return "; the angle that the orbit gives is taken as true: how it is followed is not judged";
  }
  return "";
}

}  // namespace levitas::cli
