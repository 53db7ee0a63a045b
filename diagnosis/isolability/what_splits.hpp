#pragma once
// Which experiment, sensor or record would split the ties of a table, and show what it hides.
//
// Tried    every experiment, simulated with the rig and law of the files and diagnosed together
//          with the records in hand; and records of the healthy rig, which narrow the tolerances
//          (calibrate.hpp); and sensors more (sensors_beside.hpp).
// Splits   the fault is named alone, or fewer effects are tied with it.
// None     is an answer: no experiment of these does.
// Failed   an experiment that the simulated rig does not bear, or a scenario that its controller
//          refuses, is named with its reason and splits nothing.
// Thread   blocks the caller, every processor inside.

#include <string>
#include <vector>

#include "diagnosis/isolability/experiments.hpp"
#include "diagnosis/isolability/foretell.hpp"

namespace levitas::diagnosis {

/// What one way makes of a fault that is tied, taken for another or not visible.
struct Outcome {
  effect::Id effect{};
  Prediction after;
};

struct Tried {
  std::string what;
  std::string scenario;  ///< empty where it is no scenario
  std::string failed;    ///< why; empty when it was tried
  std::vector<Outcome> outcomes;
};

/// True when the fault is better off after it.
[[nodiscard]] bool Splits(const Prediction& before, const Prediction& after) noexcept;

/// For those of `all` that are not found alone.
[[nodiscard]] std::vector<Tried> TryExperiments(const configuration::RigFile& rig,
                                                const configuration::ControllerFile& controller,
                                                const HealthyModel& model,
                                                const std::vector<Foretold>& all,
                                                const Judging& judging, const Progress& progress);

}  // namespace levitas::diagnosis
