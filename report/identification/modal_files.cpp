#include "report/identification/modal_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/output_file.hpp"
#include "common/rotational_speed.hpp"
#include "identification/modal/modal_quality.hpp"
#include "report/identification/response_files.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {
namespace {

using namespace identification;
using Json = nlohmann::ordered_json;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

std::vector<double> Row(const Eigen::MatrixXd& matrix, Eigen::Index row) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(matrix.cols()));
  for (Eigen::Index i = 0; i < matrix.cols(); ++i) values.push_back(matrix(row, i));
  return values;
}

std::vector<double> Values(const Eigen::VectorXd& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

svg::Figure StabilisationPicture(const ModalResult& r) {
  svg::Series all{.name = "pole", .colour = "#bbbbbb", .width = 0, .mark = svg::Mark::kCross};
  svg::Series stable{
      .name = "stable", .colour = svg::Colour(0), .width = 0, .mark = svg::Mark::kDot};
  for (const OrderPole& pole : r.stabilisation.poles) {
    svg::Series& to = pole.stable ? stable : all;
    to.x.push_back(pole.frequency_hz);
    to.y.push_back(static_cast<double>(pole.order));
  }
  svg::Panel panel{.title = "Poles of rational fits of growing order",
                   .x_label = "Hz",
                   .y_label = "order",
                   .x_scale = svg::Scale::kLogarithmic};
  panel.series = {all, stable};
  return {.panel_width = 900, .panel_height = 420, .panels = {panel}};
}

svg::Figure Campbell(const ModalResult& r) {
  constexpr int kSpeeds = 31;
  const double highest = std::max(1.2 * r.quality.back().speed_rad_per_s, 300.0);
  svg::Panel panel{.title = "Bending modes of the free rotor over speed",
                   .x_label = "speed, rpm",
                   .y_label = "frequency, Hz"};
  const std::size_t modes = WhirlFrequenciesHz(r.rig, 0.0).size();
  std::vector<svg::Series> lines(modes);
  for (int n = 0; n < kSpeeds; ++n) {
    const double speed = highest * n / (kSpeeds - 1);
    const auto f = WhirlFrequenciesHz(r.rig, speed);
    for (std::size_t i = 0; i < std::min(modes, f.size()); ++i) {
      lines[i].x.push_back(RadPerSToRpm(speed));
      lines[i].y.push_back(std::abs(f[i]));
      lines[i].colour = svg::Colour(f[i] > 0.0 ? 0 : 1);
    }
  }
  if (modes > 0) lines.front().name = "backward";
  if (modes > 0) lines.back().name = "forward";
  svg::Series rotation{.name = "1x",
                       .x = {0.0, RadPerSToRpm(highest)},
                       .y = {0.0, highest / kTwoPi},
                       .colour = "#888888",
                       .dashes = "4 4"};
  panel.series = std::move(lines);
  panel.series.push_back(std::move(rotation));
  return {.panel_width = 700, .panel_height = 480, .panels = {panel}};
}

/// `i`: bending mode, the first is 0.
Json ModeJson(const ModalResult& r, Eigen::Index i) {
  const ModalLayout& at = r.start.frame.layout;
  const Eigen::VectorXd& deviation = r.uncertainty.deviation;
  const double f = r.rig.frequency_rad_per_s[2 + i] / kTwoPi;
  return {{"frequency_hz", f},
          {"frequency_sigma_hz", f * deviation[at.frequency + i]},
          {"damping_ratio", r.rig.damping_ratio[2 + i]},
          {"damping_sigma", r.rig.damping_ratio[2 + i] * deviation[at.damping + i]},
          {"shown_by_the_data", r.support[static_cast<std::size_t>(i)].support == Support::kShown},
          {"actuator_deflection", Row(r.rig.actuator, 2 + i)},
          {"sensor_deflection", Row(r.rig.sensor, 2 + i)}};
}

Json AxisJson(const ModalResult& r, Eigen::Index a) {
  const ModalLayout& at = r.start.frame.layout;
  const Eigen::VectorXd& deviation = r.uncertainty.deviation;
  return {{"channel", r.channels[static_cast<std::size_t>(a)]},
          {"ki_n_per_a", r.rig.ki_n_per_a[a]},
          {"ki_sigma_n_per_a", r.rig.ki_n_per_a[a] * deviation[at.ki + a]},
          {"ks_n_per_m", r.rig.ks_n_per_m[a]},
          {"ks_sigma_n_per_m", r.rig.ks_n_per_m[a] * deviation[at.ks + a]},
          {"sensor_gain", r.rig.gain[a]}};
}

}  // namespace

Json ModalJson(const ModalResult& r) {
  Json json{{"unknowns", std::count(r.fit.fitted.begin(), r.fit.fitted.end(), true)},
            {"residuals", r.fit.residuals},
            {"reduced_chi_square", r.fit.reduced_chi_square},
            {"converged", r.fit.converged},
            {"time_s", r.time_s},
            {"highest_hz", r.options.highest_hz},
            {"mass_kg", r.rig.mass_kg},
            {"transverse_inertia_kg_m2", r.rig.inertia_kg_m2},
            {"centre_z_m", r.rig.centre_z_m},
            {"delay_samples", r.rig.delay_samples}};
  const ModalLayout& at = r.start.frame.layout;
  for (Eigen::Index i = 0; i < at.bending; ++i) json["modes"].push_back(ModeJson(r, i));
  for (Eigen::Index a = 0; a < at.axes(); ++a) json["axes"].push_back(AxisJson(r, a));
  for (Eigen::Index i = 1; i < at.modes(); ++i) {
    json["gyroscopic"].push_back(Row(r.rig.gyroscopic, i));
  }
  json["not_identifiable"] = Json::array();
  for (const Unidentifiable& d : r.uncertainty.directions) {
    json["not_identifiable"].push_back({{"unknowns", d.unknowns}, {"experiment", d.experiment}});
  }
  for (const SpeedQuality& q : r.quality) {
    json["speeds"].push_back({{"speed_rpm", RadPerSToRpm(q.speed_rad_per_s)},
                              {"misfit", q.misfit},
                              {"fitted", q.fitted},
                              {"fit_percent", q.percent.fit},
                              {"ceiling_percent", q.percent.ceiling},
                              {"channel_misfit_rig_file", Values(q.before)},
                              {"channel_misfit_identified", Values(q.after)}});
  }
  return json;
}

Json DecibelJson(const ModalResult& r, const DecibelFit& fit) {
  const auto left = [](const DecibelLeft& of, double misfit) {
    return Json{{"weighted_rms_db", of.weighted_rms_db},
                {"around_extremes_rms_db", of.rms_db[0]},
                {"noisy_rms_db", of.rms_db[1]},
                {"elsewhere_rms_db", of.rms_db[2]},
                {"misfit", misfit}};
  };
  const auto stage = [](const DecibelStage& of) {
    return Json{{"unknowns", of.unknowns}, {"converged", of.converged}};
  };
  Json json{{"standing", stage(fit.standing)}, {"gyroscopic", stage(fit.gyroscopic)}};
  for (const DecibelSpeed& s : fit.speeds) {
    json["speeds"].push_back({{"speed_rpm", RadPerSToRpm(s.speed_rad_per_s)},
                              {"around_extremes_percent", 100.0 * s.share[0]},
                              {"noisy_percent", 100.0 * s.share[1]},
                              {"of_modal_fit", left(s.modal, s.modal_misfit)},
                              {"of_decibel_fit", left(s.decibel, s.decibel_misfit)}});
  }
  for (Eigen::Index i = 2; i < 2 + r.start.frame.layout.bending; ++i) {
    json["modes"].push_back({{"frequency_hz", fit.rig.frequency_rad_per_s[i] / kTwoPi},
                             {"damping_ratio", fit.rig.damping_ratio[i]}});
  }
  return json;
}

std::vector<std::string> WriteModalPictures(const std::string& prefix, const ModalResult& r,
                                            const std::vector<FrequencyResponse>& responses) {
  if (prefix.empty()) return {};
  const auto lines = [&](const FrequencyResponse& response) {
    return ModelOn(r.start, r.fit.vector, response);
  };
  std::vector<std::string> written{prefix + "_bode.svg"};
  WriteBode(written.back(), responses.front(), lines(responses.front()));
  if (responses.size() > 2) {
    written.push_back(prefix + "_validation.svg");
    WriteBode(written.back(), responses[1], lines(responses[1]));
  }
  written.push_back(prefix + "_campbell.svg");
  svg::Write(written.back(), Campbell(r));
  written.push_back(prefix + "_stabilisation.svg");
  svg::Write(written.back(), StabilisationPicture(r));
  return written;
}

void WriteRigFile(const std::string& path, const configuration::RigFile& rig) {
  WriteWholeFile(path, configuration::WriteRig(rig));
}

}  // namespace levitas::report
