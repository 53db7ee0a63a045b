#include "report/balance/balance_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/rotational_speed.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {
namespace {

using namespace balancing;
using Json = nlohmann::ordered_json;
using Complex = std::complex<double>;

double Degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

Json MomentJson(Complex moment_kg_m, double deviation_kg_m, double angle_deviation_rad) {
  return {{"moment_g_mm", 1e6 * std::abs(moment_kg_m)},
          {"angle_deg", Degrees(std::arg(moment_kg_m))},
          {"moment_deviation_g_mm", 1e6 * deviation_kg_m},
          {"angle_deviation_deg", Degrees(angle_deviation_rad)}};
}

Json CorrectionJson(const CorrectionResult& one, bool drill) {
  Json json = MomentJson(drill ? -one.added_kg_m : one.added_kg_m, one.deviation_kg_m,
                         one.angle_deviation_rad);
  json["plane"] = one.plane.name;
  json["z_mm"] = 1e3 * one.plane.z_m;
  if (one.plane.radius_m > 0.0) {
    json["mass_g"] = 1e3 * std::abs(one.added_kg_m) / one.plane.radius_m;
    json["weights"] = Json::array();
    for (const Weight& weight : one.placed.weights) {
      Json at{{"mass_g", 1e3 * weight.mass_kg}, {"angle_deg", Degrees(weight.angle_rad)}};
      if (weight.hole > 0) at["hole"] = weight.hole;
      json["weights"].push_back(std::move(at));
    }
    json["off_g_mm"] = 1e6 * std::abs(one.placed.moment_kg_m - one.added_kg_m);
  }
  return json;
}

Json ModalUnbalanceJson(const ModalUnbalance& one) {
  const bool couple = one.name == "couple";
  const double scale = couple ? 1e9 : 1e6;
  const std::string unit = couple ? "g_mm2" : "g_mm";
  return {{"what", one.name},
          {"frequency_hz", one.frequency_hz},
          {"before_" + unit, scale * std::abs(one.before)},
          {"after_" + unit, scale * std::abs(one.after)},
          {"angle_deg", Degrees(std::arg(one.before))},
          {"deviation_" + unit, scale * one.deviation}};
}

/// Amplitude and angle per axis.
Json AxesJson(const Eigen::VectorXcd& position_m) {
  Json axes = Json::array();
  for (const Complex& one : position_m) {
    axes.push_back({{"amplitude_um", 1e6 * std::abs(one)}, {"angle_deg", Degrees(std::arg(one))}});
  }
  return axes;
}

Json OrbitsJson(const BalanceRequest& request, const BalanceResult& result) {
  Json orbits = Json::array();
  for (const OrbitForecast& at : result.orbits) {
    Json one{{"speed_rpm", RadPerSToRpm(at.speed_rad_per_s)}};
    for (Eigen::Index b = 0; b < at.before_m.size(); ++b) {
      one[request.rig.numbers.bearings[static_cast<std::size_t>(b)]] = {
          {"before_um", 1e6 * at.before_m[b]},
          {"after_um", 1e6 * at.after_m[b]},
          {"after_below_95_um", 1e6 * at.after_high_m[b]}};
    }
    orbits.push_back(std::move(one));
  }
  return orbits;
}

}  // namespace

Json BalanceJson(const BalanceRequest& request, const BalanceResult& result) {
  Json json{{"record", request.runs.back().name},
            {"rig", request.rig.numbers.name},
            {"windows", result.fit.windows},
            {"lowest_rpm", RadPerSToRpm(result.lowest_rad_per_s)},
            {"highest_rpm", RadPerSToRpm(result.highest_rad_per_s)},
            {"converged", result.fit.converged},
            {"reduced_chi_square", result.fit.reduced_chi_square},
            {"rotor_mass_kg", result.mass_kg},
            {"method", request.planes.drill ? "drill" : "add"},
            {"left_percent", 100.0 * result.left_share}};
  for (const PlaneResult& plane : result.planes) {
    Json one = MomentJson(plane.unbalance_kg_m, plane.deviation_kg_m, plane.angle_deviation_rad);
    one["z_mm"] = 1e3 * plane.z_m;
    if (!plane.name.empty()) one["plane"] = plane.name;
    json["unbalance"].push_back(std::move(one));
  }
  for (const CorrectionResult& one : result.corrections) {
    json["corrections"].push_back(CorrectionJson(one, request.planes.drill));
  }
  for (const ModalUnbalance& one : result.modal) {
    json["modal"].push_back(ModalUnbalanceJson(one));
  }
  for (std::size_t i = 0; i < result.unknowns.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    json["rig_as_fitted"].push_back({{"what", NameOf(result.unknowns[i], request.rig.numbers)},
                                     {"off", result.fit.place[at]},
                                     {"deviation", result.fit.place_deviation[at]},
                                     {"tolerance", result.unknowns[i].deviation}});
  }
  for (const InfluenceChange& at : result.influence) {
    json["influence"].push_back({{"speed_rpm", RadPerSToRpm(at.speed_rad_per_s)},
                                 {"measured", AxesJson(at.measured_m)},
                                 {"model", AxesJson(at.model_m)}});
  }
  json["orbits"] = OrbitsJson(request, result);
  return json;
}

void WriteBalancePicture(const std::string& path, const BalanceRequest& request,
                         const BalanceResult& result) {
  if (path.empty()) return;
  svg::Figure figure{.title = "Orbit radius before and after the correction", .columns = 1};
  for (std::size_t b = 0; b < request.rig.numbers.bearings.size(); ++b) {
    const auto at = static_cast<Eigen::Index>(b);
    svg::Series before{.name = "before", .colour = svg::Colour(0)};
    svg::Series after{.name = "after", .colour = svg::Colour(1)};
    svg::Series high{.name = "95 % below", .colour = svg::Colour(1), .dashes = "5 3"};
    for (const OrbitForecast& one : result.orbits) {
      for (auto* series : {&before, &after, &high}) {
        series->x.push_back(RadPerSToRpm(one.speed_rad_per_s));
      }
      before.y.push_back(1e6 * one.before_m[at]);
      after.y.push_back(1e6 * one.after_m[at]);
      high.y.push_back(1e6 * one.after_high_m[at]);
    }
    svg::Panel panel{.title = request.rig.numbers.bearings[b],
                     .x_label = "speed, rpm",
                     .y_label = "amplitude, µm",
                     .y_scale = svg::Scale::kLogarithmic};
    panel.series = {std::move(before), std::move(after), std::move(high)};
    figure.panels.push_back(std::move(panel));
  }
  svg::Write(path, figure);
}

}  // namespace levitas::report
