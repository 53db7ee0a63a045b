#pragma once
// One drawn rig balanced from one recorded run-up with the rig file as it is, and again after a
// second one: what each leaves, with quiet probes, and how far the weights are from the truth.

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "identification/balance/balance.hpp"
#include "tests/loop/balance/run_up.hpp"

namespace levitas::balancing {

struct Outcome {
  double before_peak_m{};   ///< largest orbit before
  double rms_percent{};     ///< synchronous response left: rms over the run-up, all probes
  double peak_percent{};    ///< the same of the largest orbit
  double weight_percent{};  ///< largest error of a weight
  double weight_deg{};
  double deviations{};          ///< largest error in standard deviations of the fit
  double before_g_mm_per_kg{};  ///< static unbalance over mass
  double left_g_mm_per_kg{};
  double second_rms_percent{};  ///< after the second correction, of the first response
  double second_peak_percent{};
  double second_g_mm_per_kg{};
  double chi_square{};
};

struct Response {
  double rms_m{}, peak_m{};
};

inline Response ResponseOf(const session::Recording& record) {
  Response made;
  const auto windows = analysis::TrackOrder(record, {});
  for (const auto& window : windows) {
    made.rms_m += window.position_m.squaredNorm();
    made.peak_m = std::max(made.peak_m, Radii(window.position_m).maxCoeff());
  }
  made.rms_m = std::sqrt(made.rms_m / static_cast<double>(windows.size()));
  return made;
}

inline Response Quiet(const configuration::RigFile& rig) {
  return ResponseOf(RecordRunUp(WithQuietProbes(rig), {.seed = 77}));
}

inline std::complex<double> MomentOf(const plant::UnbalanceMass& mass) {
  return std::polar(mass.moment_kg_m, mass.phase_rad);
}

inline double StaticPerMass(const configuration::RigFile& rig, double mass_kg) {
  std::complex<double> sum = 0.0;
  for (const auto& mass : rig.plant.unbalance) sum += MomentOf(mass);
  return 1e6 * std::abs(sum) / mass_kg;
}

/// The true rig with what a balancing adds.
inline configuration::RigFile Corrected(configuration::RigFile rig, const BalanceResult& result) {
  for (std::size_t i = 0; i < result.corrections.size(); ++i) {
    const auto left = MomentOf(rig.plant.unbalance[i]) + result.corrections[i].added_kg_m;
    rig.plant.unbalance[i].moment_kg_m = std::abs(left);
    rig.plant.unbalance[i].phase_rad = std::arg(left);
  }
  return rig;
}

inline BalanceRequest RequestOf(const session::Recording& first) {
  BalanceRequest request;
  request.rig = FlexibleRotor();
  request.runs = {ReadRun(first, request.rig)};
  request.law = ShippedController().law;
  request.planes = PlanesOfRig(request.rig);
  request.top_rad_per_s = request.rig.numbers.max_speed_rad_per_s;
  return request;
}

inline void JudgeWeights(const configuration::RigFile& truth, const BalanceResult& found,
                         Outcome& out) {
  for (std::size_t i = 0; i < found.corrections.size(); ++i) {
    const CorrectionResult& one = found.corrections[i];
    const std::complex<double> wanted = -MomentOf(truth.plant.unbalance[i]);
    const std::complex<double> ratio = one.added_kg_m / wanted;
    out.weight_percent = std::max(out.weight_percent, 100.0 * std::abs(std::abs(ratio) - 1.0));
    out.weight_deg = std::max(out.weight_deg, std::abs(std::arg(ratio)) * 180.0 / std::numbers::pi);
    out.deviations = std::max(
        {out.deviations, std::abs(std::abs(one.added_kg_m) - std::abs(wanted)) / one.deviation_kg_m,
         std::abs(std::arg(ratio)) / one.angle_deviation_rad});
  }
}

inline Outcome BalanceDrawnRig(const configuration::RigFile& truth, std::uint64_t seed) {
  const session::Recording first = RecordRunUp(truth, {.seed = seed});
  BalanceRequest request = RequestOf(first);
  const BalanceResult found = Balance(request);
  Outcome out;
  out.chi_square = found.fit.reduced_chi_square;
  JudgeWeights(truth, found, out);
  const configuration::RigFile corrected = Corrected(truth, found);
  const Response before = Quiet(truth);
  const Response after = Quiet(corrected);
  out.before_peak_m = before.peak_m;
  out.rms_percent = 100.0 * after.rms_m / before.rms_m;
  out.peak_percent = 100.0 * after.peak_m / before.peak_m;
  out.before_g_mm_per_kg = StaticPerMass(truth, found.mass_kg);
  out.left_g_mm_per_kg = StaticPerMass(corrected, found.mass_kg);

  request.runs.push_back(ReadRun(RecordRunUp(corrected, {.seed = seed + 1000}), request.rig));
  for (const CorrectionResult& one : found.corrections) {
    request.runs.back().applied.push_back({one.plane.name, one.added_kg_m});
  }
  const configuration::RigFile again = Corrected(corrected, Balance(request));
  const Response last = Quiet(again);
  out.second_rms_percent = 100.0 * last.rms_m / before.rms_m;
  out.second_peak_percent = 100.0 * last.peak_m / before.peak_m;
  out.second_g_mm_per_kg = StaticPerMass(again, found.mass_kg);
  return out;
}

/// Of one figure of all outcomes.
struct Spread {
  double median{}, worst{};
};

inline Spread SpreadOf(const std::vector<Outcome>& outcomes, double Outcome::*figure) {
  std::vector<double> values;
  for (const Outcome& one : outcomes) values.push_back(one.*figure);
  std::ranges::sort(values);
  return {values[values.size() / 2], values.back()};
}

}  // namespace levitas::balancing
