#include "verdict/measure_sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "identification/frf/frequency_response.hpp"
#include "identification/frf/measured_sensitivity.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::verdict {
namespace {

constexpr double kSameSpeedRadPerS = 0.1;  // about 1 rpm

analysis::SensitivityResult ComputedAt(double speed_rad_per_s, const configuration::RigFile& rig,
                                       const law::LawConfig& law,
                                       std::span<const analysis::SensitivityResult> known) {
  const auto found = std::ranges::find_if(known, [&](const analysis::SensitivityResult& one) {
    return std::abs(one.speed_rad_per_s - speed_rad_per_s) <= kSameSpeedRadPerS;
  });
  return found != known.end() ? *found
                              : analysis::SensitivityPeaks(rig.plant, law, speed_rad_per_s);
}

MeasuredSpeed MeasuredAt(const identification::FrequencyResponse& response,
                         const analysis::SensitivityResult& computed) {
  MeasuredSpeed out{response.speed_rad_per_s, {}};
  const auto peaks = identification::MeasuredPeaks(response);
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    MeasuredAxis axis{peaks[i].channel,
                      peaks[i].peak,
                      peaks[i].sigma,
                      peaks[i].line_peak,
                      peaks[i].frequency_hz,
                      peaks[i].zone,
                      peaks[i].refused,
                      0.0,
                      false};
    if (i < computed.axes.size()) {
      axis.computed_peak = computed.axes[i].peak;
      axis.differs =
          axis.zone && computed.stable && identification::Disagree(axis.computed_peak, axis.peak);
    }
    out.axes.push_back(std::move(axis));
  }
  return out;
}

}  // namespace

MeasuredSensitivity MeasureSensitivity(const session::Recording& record,
                                       const configuration::RigFile& rig, const law::LawConfig& law,
                                       std::span<const analysis::SensitivityResult> computed) {
  MeasuredSensitivity out;
  try {
    const double delay_s = rig.plant.delay_samples * rig.numbers.period_s();
    for (const auto& response : identification::EstimateResponses(record, delay_s)) {
      out.speeds.push_back(
          MeasuredAt(response, ComputedAt(response.speed_rad_per_s, rig, law, computed)));
    }
  } catch (const BadInput& problem) {
    out.speeds.clear();
    out.why_not = problem.what();
  }
  return out;
}

const MeasuredAxis* FindGraded(const MeasuredSensitivity& measured, const std::string& channel,
                               double speed_rad_per_s) {
  for (const MeasuredSpeed& at : measured.speeds) {
    if (std::abs(at.speed_rad_per_s - speed_rad_per_s) > kSameSpeedRadPerS) continue;
    const auto axis = std::find_if(at.axes.begin(), at.axes.end(), [&](const MeasuredAxis& one) {
      return one.channel == channel && one.zone;
    });
    if (axis != at.axes.end()) return &*axis;
  }
  return nullptr;
}

}  // namespace levitas::verdict
