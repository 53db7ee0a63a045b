#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/rotational_speed.hpp"
#include "report/balance/balance_files.hpp"
#include "report/text/text_table.hpp"

namespace levitas::report {
namespace {

using namespace balancing;
using Complex = std::complex<double>;

constexpr double k95 = 1.96;
/// Speeds of the table of orbits: every so many of the forecast's.
constexpr std::size_t kEvery = 10;

double TurnDegrees(double angle_rad) {
  const double degrees = angle_rad * 180.0 / std::numbers::pi;
  return degrees < -1e-9 ? degrees + 360.0 : degrees;
}

/// Half of a 95 % interval; a direction that is not known is 180.
std::string HalfDegrees(double deviation_rad) {
  return fmt::format("{:.1f}", std::min(180.0, k95 * deviation_rad * 180.0 / std::numbers::pi));
}

std::string UnbalanceTable(const BalanceResult& result) {
  TextTable table;
  table.Add({"plane", "z mm", "g mm", "+-", "deg", "+-"});
  for (const PlaneResult& plane : result.planes) {
    table.Add({plane.name.empty() ? "(rig file)" : plane.name,
               fmt::format("{:.1f}", 1e3 * plane.z_m),
               fmt::format("{:.3f}", 1e6 * std::abs(plane.unbalance_kg_m)),
               fmt::format("{:.3f}", 1e6 * k95 * plane.deviation_kg_m),
               fmt::format("{:.1f}", TurnDegrees(std::arg(plane.unbalance_kg_m))),
               HalfDegrees(plane.angle_deviation_rad)});
  }
  return table.Text();
}

std::string HolesText(const PlacedWeights& placed) {
  std::string text;
  for (const Weight& weight : placed.weights) {
    if (weight.hole == 0) continue;
    if (!text.empty()) text += ", ";
    text += fmt::format("hole {} ({:.1f} deg): {:.3f} g", weight.hole,
                        TurnDegrees(weight.angle_rad), 1e3 * weight.mass_kg);
  }
  return text;
}

std::string CorrectionTable(const BalanceResult& result, bool drill) {
  TextTable table;
  table.Add({"plane", "g mm", "+-", "g", "deg", "+-", "off g mm"});
  std::string holes;
  for (const CorrectionResult& one : result.corrections) {
    const Complex moment = drill ? -one.added_kg_m : one.added_kg_m;
    const bool mass = one.plane.radius_m > 0.0;
    table.Add({one.plane.name, fmt::format("{:.3f}", 1e6 * std::abs(moment)),
               fmt::format("{:.3f}", 1e6 * k95 * one.deviation_kg_m),
               mass ? fmt::format("{:.4f}", 1e3 * std::abs(moment) / one.plane.radius_m) : "-",
               fmt::format("{:.1f}", TurnDegrees(std::arg(moment))),
               HalfDegrees(one.angle_deviation_rad),
               fmt::format("{:.3f}", 1e6 * std::abs(one.placed.moment_kg_m - one.added_kg_m))});
    const std::string split = HolesText(one.placed);
    if (!split.empty()) holes += fmt::format("  {}: {}\n", one.plane.name, split);
    if (std::abs(one.added_kg_m) < k95 * one.deviation_kg_m) {
      holes += fmt::format(
          "  {0}: may be none at all: {1:.3f} g mm, give or take {2:.3f}; without a plane {0} the "
          "others have smaller intervals\n",
          one.plane.name, 1e6 * std::abs(moment), 1e6 * k95 * one.deviation_kg_m);
    }
    if (one.placed.weights.empty() && mass) {
      holes +=
          fmt::format("  {}: no weight, the correction is below the smallest\n", one.plane.name);
    }
  }
  return table.Text() + holes;
}

std::string ModalTable(const BalanceResult& result) {
  TextTable table;
  table.Add({"what", "Hz", "before", "+-", "deg", "after", "unit"});
  for (const ModalUnbalance& one : result.modal) {
    const bool couple = one.name == "couple";
    const double scale = couple ? 1e9 : 1e6;
    table.Add({one.name, one.frequency_hz > 0.0 ? fmt::format("{:.1f}", one.frequency_hz) : "-",
               fmt::format("{:.3f}", scale * std::abs(one.before)),
               fmt::format("{:.3f}", scale * k95 * one.deviation),
               fmt::format("{:.1f}", TurnDegrees(std::arg(one.before))),
               fmt::format("{:.3f}", scale * std::abs(one.after)), couple ? "g mm2" : "g mm"});
  }
  return table.Text();
}

std::string OrbitTable(const BalanceRequest& request, const BalanceResult& result) {
  TextTable table;
  std::vector<std::string> head{"rpm"};
  for (const std::string& bearing : request.rig.numbers.bearings) {
    head.insert(head.end(), {bearing + " before", "after", "95 % below"});
  }
  table.Add(std::move(head));
  for (std::size_t i = 0; i < result.orbits.size(); i += kEvery) {
    const OrbitForecast& at = result.orbits[i];
    std::vector<std::string> row{fmt::format("{:.0f}", RadPerSToRpm(at.speed_rad_per_s))};
    for (Eigen::Index b = 0; b < at.before_m.size(); ++b) {
      row.push_back(fmt::format("{:.2f}", 1e6 * at.before_m[b]));
      row.push_back(fmt::format("{:.3f}", 1e6 * at.after_m[b]));
      row.push_back(fmt::format("{:.3f}", 1e6 * at.after_high_m[b]));
    }
    table.Add(std::move(row));
  }
  return table.Text();
}

/// One complex number for all probes: measured by model in the least-squares sense.
std::string InfluenceTable(const BalanceResult& result) {
  TextTable table;
  table.Add({"rpm", "measured um", "model um", "measured/model", "deg"});
  for (std::size_t i = 0; i < result.influence.size(); i += kEvery) {
    const InfluenceChange& at = result.influence[i];
    const Complex ratio = at.model_m.dot(at.measured_m) / at.model_m.squaredNorm();
    table.Add({fmt::format("{:.0f}", RadPerSToRpm(at.speed_rad_per_s)),
               fmt::format("{:.2f}", 1e6 * Radii(at.measured_m).maxCoeff()),
               fmt::format("{:.2f}", 1e6 * Radii(at.model_m).maxCoeff()),
               fmt::format("{:.3f}", std::abs(ratio)),
               fmt::format("{:+.1f}", std::arg(ratio) * 180.0 / std::numbers::pi)});
  }
  return table.Text();
}

/// Empty where the planes explain the run.
std::string UnexplainedText(const BalanceRequest& request, const BalanceResult& result) {
  constexpr double kExplained = 1.5;  // of the noise, rms: below it a weight still does its work
  if (std::sqrt(result.fit.reduced_chi_square) < kExplained) return {};
  if (request.runs.size() > 1) {
    return "WARNING: the two runs do not differ by the weights of --applied. Are plane, grams and "
           "angle right, and is the record of --after the earlier one? Weights are not worth their "
           "numbers before\n";
  }
  return "WARNING: unbalance in these planes does not explain the run. Is there a wheel or a "
         "coupling elsewhere (add its plane to rotor.unbalance of the rig file, moment_g_mm: 0), a "
         "bent shaft, or a run-out? amb diagnose tells them apart; weights are not worth their "
         "numbers before\n";
}

}  // namespace

std::string BalanceText(const BalanceRequest& request, const BalanceResult& result) {
  const RecordedRun& now = request.runs.back();
  std::string text = fmt::format(
      "{}: {} windows from {:.0f} to {:.0f} rpm, rig {}; remainder {:.2f} of what noise alone "
      "leaves{}\n",
      now.name, result.fit.windows, RadPerSToRpm(result.lowest_rad_per_s),
      RadPerSToRpm(result.highest_rad_per_s), request.rig.numbers.name,
      std::sqrt(result.fit.reduced_chi_square),
      result.fit.converged ? "" : "; WARNING: the fit did not settle");
  text += UnexplainedText(request, result);
  text += "\nUnbalance of the rotor, intervals of 95 %:\n" + UnbalanceTable(result);
  text +=
      fmt::format("\nCorrection, {}:\n", request.planes.drill ? "mass taken away" : "mass added");
  text += CorrectionTable(result, request.planes.drill);
  text += "\nBy mode, before and after:\n" + ModalTable(result);
  if (!result.influence.empty()) {
    text += "\nWhat the weights did, largest orbit, measured beside the model:\n" +
            InfluenceTable(result);
  }
  text += fmt::format("\nOrbit radius [um] of the shaft at the sensors, law {}:\n",
                      result.law_known ? "of the controller" : "as the record shows it");
  text += OrbitTable(request, result);
  text +=
      fmt::format("left over all speeds: {:.2f} % (root mean square)\n", 100.0 * result.left_share);
  if (result.highest_rad_per_s < 0.98 * request.top_rad_per_s) {
    text +=
        fmt::format("NOTE: the record ends at {:.0f} rpm; above it the forecast is the model's\n",
                    RadPerSToRpm(result.highest_rad_per_s));
  }
  return text;
}

}  // namespace levitas::report
