#pragma once
// Page of a PID design: what was asked and reached, and the gains that hold the rig before and
// after.
// Thread   that of the caller.

#include <string>
#include <vector>

#include "design/pid/gain_map.hpp"

namespace levitas::cli {

/// A law by its name; a state-space law has no gains to map and is left out. With coordinates the
/// law has one entry per channel.
struct NamedLaw {
  std::string name;
  law::LawConfig law;
  design::Coordinates coordinates{};
};

[[nodiscard]] std::string PidPage(const configuration::RigFile& rig,
                                  const std::vector<NamedLaw>& laws,
                                  const design::PidFigures& figures,
                                  const design::PidLimits& limits);

}  // namespace levitas::cli
