#include "identification/modal/identify_modal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "identification/modal/modal_quality.hpp"
#include "plant_sim/plant/plain_sensors.hpp"

namespace levitas::identification {
namespace {

Eigen::Index ModesInBand(const configuration::RigFile& rig, double highest_hz) {
  const auto most = static_cast<Eigen::Index>(rig.plant.rotor.modes_per_plane) - 2;
  const ModalStart all = StartFromRig(rig.plant, std::max<Eigen::Index>(most, 1));
  const auto& at = all.frame.layout;
  Eigen::Index count = 0;
  while (count < at.bending && std::exp(all.vector[at.frequency + count]) < kTwoPi * highest_hz) {
    ++count;
  }
  return count;
}

std::vector<double> BendingHz(const ModalLayout& at, const Eigen::VectorXd& vector) {
  std::vector<double> frequencies;
  for (Eigen::Index i = 0; i < at.bending; ++i) {
    frequencies.push_back(std::exp(vector[at.frequency + i]) / kTwoPi);
  }
  return frequencies;
}

}  // namespace

ResponseOptions ModalResponseOptions(const configuration::RigFile& rig) {
  ResponseOptions options;
  options.amplifier_hz = rig.plant.bearings.front().amplifier.bandwidth_hz;
  return options;
}

ModalResult IdentifyModal(const configuration::RigFile& rig,
                          const std::vector<FrequencyResponse>& responses,
                          const ModalFitOptions& options) {
  if (!plant::HasPlainSensors(rig.plant)) {
    throw BadInput(fmt::format("rig {}: the modal identification {}", rig.numbers.name,
                               plant::kPlainSensorsOnly));
  }
  const FrequencyResponse& standing = responses.front();
  if (std::abs(standing.speed_rad_per_s) >= 1.0) {
    throw BadInput(fmt::format(
        "the slowest response was taken at {:.0f} rpm; the fit starts from one at standstill",
        RadPerSToRpm(standing.speed_rad_per_s)));
  }
  ModalFitOptions used = options;
  used.highest_hz = std::min(options.highest_hz, UsableBandHz(standing));
  StabilisationOptions stabilisation;
  stabilisation.highest_hz = used.highest_hz;
  const ModalStart start = StartFromRig(rig.plant, ModesInBand(rig, used.highest_hz));
  return IdentifyModal(start, start.vector, Stabilise(standing, stabilisation), responses, used);
}

ModalResult IdentifyModal(const ModalStart& start, const Eigen::VectorXd& begin,
                          const Stabilisation& stabilisation,
                          const std::vector<FrequencyResponse>& responses,
                          const ModalFitOptions& options) {
  const FrequencyResponse& standing = responses.front();
  ModalResult result{standing.channels, options, start, stabilisation, {}, {}, {}, {}, {}, {}, 0.0};
  std::vector<FrequencyResponse> spinning;
  if (responses.size() > 1) spinning.push_back(responses.back());
  const auto candidates =
      PairModes(BendingHz(start.frame.layout, start.vector), stabilisation.modes);
  result.fit = FitModal(start, begin, candidates, standing, spinning, options);
  const Assigned& assigned = result.fit.assigned;
  for (const ProposedMode& mode : stabilisation.modes) {
    const bool claimed = std::ranges::any_of(assigned, [&mode](const auto& own) {
      return own && own->frequency_hz == mode.frequency_hz;
    });
    if (!claimed) result.unmatched.push_back(mode);
  }
  result.rig = ToPhysical(start.frame, result.fit.vector);
  result.support = SupportOf(result.rig, assigned);
  result.uncertainty = Assess(start, result.fit);
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const auto model = ModelOn(start, result.fit.vector, responses[i]);
    result.quality.push_back(
        {responses[i].speed_rad_per_s, Misfit(responses[i], model, options),
         i == 0 || i + 1 == responses.size(), FitOf(responses[i], model, options),
         MisfitByChannel(responses[i], ModelOn(start, start.vector, responses[i]), options),
         MisfitByChannel(responses[i], model, options)});
  }
  return result;
}

}  // namespace levitas::identification
