#include "diagnosis/isolability/what_splits.hpp"

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/isolability/sensors_beside.hpp"
#include "diagnosis/isolability/simulated_record.hpp"
#include "diagnosis/records/levitated_interval.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

std::vector<StatedFault> Open(const std::vector<Foretold>& all) {
  std::vector<StatedFault> open;
  for (const Foretold& one : all) {
    if (one.prediction.isolation != Isolation::kFound) open.push_back(one.fault);
  }
  return open;
}

void Take(std::vector<Foretold> foretold, Tried& out) {
  for (Foretold& one : foretold) {
    const effect::Id effect = one.prediction.effect;
    out.outcomes.push_back({effect, std::move(one.prediction)});
  }
}

/// Records of the healthy rig of the same kind leave of every number what they do not determine.
Tried WithHealthyRecords(const HealthyModel& model, const std::vector<StatedFault>& open,
                         const Judging& judging) {
  Tried tried{"the same records of the healthy rig beside them (--healthy)", "", "", {}};
  const LinearProblem nothing = model.Nothing();
  const Fit posterior = Evidence(nothing, model.terms(), {}).Solve();
  std::vector<Term> narrowed = model.terms();
  for (std::size_t i = 0; i < narrowed.size(); ++i) {
    Term& term = narrowed[i];
    if (!term.nuisance()) continue;
    const double left = posterior.deviation[static_cast<Eigen::Index>(i)] * term.scale();
    term.tolerance = std::min(term.tolerance, std::hypot(left, kDaily * term.tolerance));
  }
  for (const StatedFault& fault : open) {
    const auto signature = model.SignatureOf({fault.entry});
    if (!signature) continue;
    const effect::Id effect = fault.entry.id;
    tried.outcomes.push_back(
        {effect, Predict(effect, *signature, narrowed, model.hypotheses(), judging)});
  }
  return tried;
}

Tried WithSensor(const HealthyModel& model, const SensorsBeside& sensors, std::size_t which,
                 const std::vector<StatedFault>& open, const Judging& judging) {
  Tried tried{"the same experiment with " + sensors.what(which), "", "", {}};
  for (const StatedFault& fault : open) {
    auto signature = model.SignatureOf({fault.entry});
    if (!signature || fault.entry.id == effect::Id::kMainsPickup) continue;
    sensors.Add(which, {fault.entry}, *signature);
    const effect::Id effect = fault.entry.id;
    tried.outcomes.push_back(
        {effect, Predict(effect, *signature, model.terms(), model.hypotheses(), judging)});
  }
  return tried;
}

}  // namespace

bool Splits(const Prediction& before, const Prediction& after) noexcept {
  if (after.isolation == Isolation::kNotVisible) return false;
  if (before.isolation == Isolation::kNotVisible) return true;
  if (after.isolation == Isolation::kFound) return before.isolation != Isolation::kFound;
  if (after.isolation == Isolation::kTakenFor) return false;
  return before.isolation == Isolation::kTakenFor || after.ties.size() < before.ties.size();
}

std::vector<Tried> TryExperiments(const configuration::RigFile& rig,
                                  const configuration::ControllerFile& controller,
                                  const HealthyModel& model, const std::vector<Foretold>& all,
                                  const Judging& judging, const Progress& progress) {
  const std::vector<StatedFault> open = Open(all);
  std::vector<Tried> tried;
  if (open.empty()) return tried;
  const auto experiments = Experiments(rig, controller.law.current_limit_a);
  double done = 0.0;
  for (const Experiment& experiment : experiments) {
    if (progress) progress(done / static_cast<double>(experiments.size()), experiment.what);
    done += 1.0;
    Tried& out = tried.emplace_back(Tried{experiment.what, experiment.scenario, "", {}});
    try {
      const auto scenario =
          configuration::ParseScenario(experiment.scenario, "experiment", rig.numbers);
      Record record = SimulatedRecord(rig, controller, scenario, 2);
      LeaveOutContactAndWays(model.rig(), record);
      const HealthyModel further(rig, {std::move(record)}, false, judging, model.orbit_m());
      Take(ForetellAll(model, &further, open, judging, nullptr), out);
    } catch (const BadInput& refused) {
      out.failed = refused.what();
    }
  }
  tried.push_back(WithHealthyRecords(model, open, judging));
  const SensorsBeside sensors(model);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    tried.push_back(WithSensor(model, sensors, i, open, judging));
  }
  return tried;
}

}  // namespace levitas::diagnosis
