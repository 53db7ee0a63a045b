#pragma once
// The shipped flexible rotor, read once.

#include "configuration/rig_file.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {

inline const configuration::RigFile& Rig() {
  static const configuration::RigFile rig =
      configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  return rig;
}

}  // namespace levitas::identification
