#include "identification/modal/identify_modal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "identification/modal/modal_quality.hpp"

namespace levitas::identification {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kNearMode = 0.25;

Eigen::Index ModesInBand(const config::RigFile& rig, double highest_hz) {
  const auto most = static_cast<Eigen::Index>(rig.plant.rotor.modes_per_plane) - 2;
  const ModalStart all = StartFromRig(rig.plant, std::max<Eigen::Index>(most, 1));
  const auto& at = all.frame.layout;
  Eigen::Index count = 0;
  while (count < at.bending && std::exp(all.vector[at.frequency + count]) < kTwoPi * highest_hz) {
    ++count;
  }
  return count;
}

bool Matched(const ModalStart& start, const ProposedMode& mode) {
  const auto& at = start.frame.layout;
  for (Eigen::Index i = 0; i < at.bending; ++i) {
    const double known_hz = std::exp(start.vector[at.frequency + i]) / kTwoPi;
    if (std::abs(std::log(mode.frequency_hz / known_hz)) < kNearMode) return true;
  }
  return false;
}

}  // namespace

ModalResult IdentifyModal(const config::RigFile& rig,
                          const std::vector<FrequencyResponse>& responses,
                          const ModalFitOptions& options) {
  const FrequencyResponse& standing = responses.front();
  if (std::abs(standing.speed_rad_per_s) >= 1.0) {
    throw BadInput(fmt::format(
        "the slowest response was taken at {:.0f} rpm; the fit starts from one at standstill",
        standing.speed_rad_per_s * 30.0 / std::numbers::pi));
  }
  ModalFitOptions used = options;
  used.highest_hz = std::min(options.highest_hz, UsableBandHz(standing));
  StabilisationOptions stabilisation;
  stabilisation.highest_hz = used.highest_hz;
  ModalResult result{standing.channels,
                     used,
                     StartFromRig(rig.plant, ModesInBand(rig, used.highest_hz)),
                     Stabilise(standing, stabilisation),
                     {},
                     {},
                     {},
                     {},
                     {},
                     0.0};
  std::ranges::copy_if(result.stabilisation.modes, std::back_inserter(result.unmatched),
                       [&](const ProposedMode& m) { return !Matched(result.start, m); });
  std::vector<FrequencyResponse> spinning;
  if (responses.size() > 1) spinning.push_back(responses.back());
  result.fit = FitModal(result.start, result.start.vector, result.stabilisation.modes, standing,
                        spinning, used);
  result.rig = ToPhysical(result.start.frame, result.fit.vector);
  result.uncertainty = Assess(result.start, result.fit);
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const auto model = ModelOn(result.start, result.fit.vector, responses[i]);
    result.quality.push_back({responses[i].speed_rad_per_s, Misfit(responses[i], model, used),
                              i == 0 || i + 1 == responses.size()});
  }
  return result;
}

}  // namespace levitas::identification
