#include "benchmark/accuracy/available_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/search.hpp"
#include "diagnosis/records/levitated_interval.hpp"
#include "diagnosis/records/load.hpp"

namespace levitas::accuracy {
namespace {

using diagnosis::Record;
using effect::Id;

bool ChangesTheModel(const effect::EffectConfig& entry) {
  return entry.id != Id::kSensorNoise && entry.id != Id::kDroppedSamples &&
         entry.id != Id::kSampleJitter && entry.id != Id::kMainsPickup;
}

/// [nat] minus the logarithm of the likelihood, with all tolerances fitted.
double Misfit(const diagnosis::RigView& rig, const std::vector<diagnosis::Term>& terms,
              const std::vector<Record>& records) {
  constexpr int kPasses = 10;
  const diagnosis::Search search(rig, terms);
  const diagnosis::Gains gains = search.DesignGains(records, diagnosis::kSlow);
  const diagnosis::Refined fit = diagnosis::CalibrateNuisances(rig, search, terms, records, records,
                                                               gains, diagnosis::kSlow, kPasses);
  if (!fit.ok) return std::numeric_limits<double>::infinity();
  return diagnosis::Refiner(search, terms, records, gains, rig.axes)
      .Misfit(fit.point, diagnosis::kWhiteningOrder);
}

}  // namespace

std::optional<double> AvailableEvidence(const configuration::RigFile& rig,
                                        const std::vector<Record>& records,
                                        const std::vector<effect::EffectConfig>& hidden,
                                        const std::vector<effect::EffectConfig>& beside) {
  if (!rig.plant.shafts.empty() || hidden.empty()) return std::nullopt;
  if (!std::all_of(hidden.begin(), hidden.end(), ChangesTheModel)) return std::nullopt;
  plant::PlantConfig spoilt = rig.plant;
  spoilt.effects.insert(spoilt.effects.end(), beside.begin(), beside.end());
  const diagnosis::RigView nominal(rig.numbers, spoilt);
  spoilt.effects.insert(spoilt.effects.end(), hidden.begin(), hidden.end());
  const diagnosis::RigView with(rig.numbers, spoilt);
  std::vector<Record> levitated = records;
  for (Record& record : levitated) diagnosis::LeaveOutContactAndWays(nominal, record);

  const auto terms = [&](const diagnosis::RigView& view) {
    return diagnosis::AllTerms(view, rig.tolerances.value_or(configuration::Tolerances{}),
                               diagnosis::LargestOrbit(levitated, view.axes));
  };
  const double without = Misfit(nominal, terms(nominal), levitated);
  const double held = without - Misfit(with, terms(with), levitated);
  // A model that loses the rotor without the effect needs it.
  return std::isfinite(held) ? held : std::numeric_limits<double>::infinity();
}

}  // namespace levitas::accuracy
