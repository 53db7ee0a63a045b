#include "trials/held_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/flight.hpp"
#include "diagnosis/load.hpp"
#include "diagnosis/search.hpp"

namespace levitas::trials {
namespace {

using diagnosis::Record;
using diagnosis::Trajectory;
using effect::Id;

bool ChangesTheModel(const effect::EffectConfig& entry) {
  return entry.id != Id::kSensorNoise && entry.id != Id::kDroppedSamples &&
         entry.id != Id::kSampleJitter && entry.id != Id::kMainsPickup;
}

/// Innovations become what the nominal rig's are more than these.
void Subtract(const std::vector<Trajectory>& nominal, std::size_t axes,
              std::vector<Trajectory>& runs) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t n = 0; n < runs[r].moments.size(); ++n) {
      for (std::size_t a = 0; a < axes; ++a) {
        float& own = runs[r].moments[n].innovation_m[a];
        own = nominal[r].moments[n].innovation_m[a] - own;
      }
    }
  }
}

diagnosis::Whitener OfTheNoise(const diagnosis::ObserverPair& gains, std::size_t axes) {
  diagnosis::Whitener whitener;
  for (std::size_t a = 0; a < axes; ++a) {
    whitener.filter.push_back({1.0 / gains.steady->expected_innovation_m[a]});
  }
  return whitener;
}

}  // namespace

std::optional<double> HeldEvidence(const config::RigFile& rig, const std::vector<Record>& records,
                                   const std::vector<effect::EffectConfig>& hidden) {
  if (!rig.plant.shafts.empty() || hidden.empty()) return std::nullopt;
  if (!std::all_of(hidden.begin(), hidden.end(), ChangesTheModel)) return std::nullopt;
  const diagnosis::RigView nominal(rig.numbers, rig.plant);
  plant::PlantConfig spoilt = rig.plant;
  spoilt.effects.insert(spoilt.effects.end(), hidden.begin(), hidden.end());
  const diagnosis::RigView with(rig.numbers, spoilt);
  std::vector<Record> flown = records;
  for (Record& record : flown) diagnosis::LeaveOutContact(nominal, record);

  const auto terms = diagnosis::AllTerms(nominal, rig.tolerances.value_or(config::Tolerances{}),
                                         diagnosis::LargestOrbit(flown, nominal.axes));
  const diagnosis::Search search(nominal, terms);
  const std::vector<double> nothing(terms.size(), 0.0);
  const diagnosis::Gains gains = search.DesignGains(flown, diagnosis::kSlow);
  std::vector<Trajectory> runs = diagnosis::Search(with, terms).Run(flown, gains, nothing);
  const diagnosis::Slopes slopes(nominal, runs, terms, nothing, search.Nuisances());
  Subtract(search.Run(flown, gains, nothing), nominal.axes, runs);
  const diagnosis::LinearProblem problem =
      search.About(slopes.Sum(runs, OfTheNoise(gains.front(), nominal.axes)), nothing);
  const diagnosis::Fit fit = diagnosis::Evidence(problem, terms, {}).Solve();
  const double held = 0.5 * (fit.squared_sum + fit.penalty);
  // A model that loses the rotor without the effect needs it.
  return std::isfinite(held) ? held : std::numeric_limits<double>::infinity();
}

}  // namespace levitas::trials
