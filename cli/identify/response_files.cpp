#include "cli/identify/response_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/analysis_options.hpp"
#include "common/problem.hpp"
#include "report/svg/figure.hpp"

namespace levitas::cli {
namespace {

using Index = Eigen::Index;
constexpr double kMicro = 1e6;

const std::string& Channel(const FrequencyResponse& r, Index i) {
  return r.channels[static_cast<std::size_t>(i)];
}

std::string CsvHeader(const FrequencyResponse& r) {
  std::string text = "speed_rpm,frequency_hz";
  for (Index j = 0; j < r.axes(); ++j) {
    for (Index i = 0; i < r.axes(); ++i) {
      const std::string pair = Channel(r, i) + "_from_" + Channel(r, j);
      text += fmt::format(
          ",plant_re_{0}_m_per_a,plant_im_{0}_m_per_a,plant_sigma_{0}_m_per_a,coherence_{0},"
          "sensitivity_re_{0},sensitivity_im_{0}",
          pair);
    }
  }
  return text + "\n";
}

void AppendRows(const FrequencyResponse& r, std::string& text) {
  for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
    text += fmt::format("{:.3f},{:.6f}", Rpm(r.speed_rad_per_s), r.frequency_hz[k]);
    for (Index j = 0; j < r.axes(); ++j) {
      for (Index i = 0; i < r.axes(); ++i) {
        text += fmt::format(",{:.8e},{:.8e},{:.4e},{:.5f},{:.8e},{:.8e}", r.plant[k](i, j).real(),
                            r.plant[k](i, j).imag(), std::sqrt(r.variance[k](i, j)),
                            r.coherence[k](i, j), r.sensitivity[k](i, j).real(),
                            r.sensitivity[k](i, j).imag());
      }
    }
    text += '\n';
  }
}

svg::Panel EmptyPanel(const FrequencyResponse& r, Index i, Index j, const std::string& unit) {
  svg::Panel panel;
  panel.title = Channel(r, i) + " from " + Channel(r, j);
  panel.x_label = "Hz";
  panel.y_label = unit;
  panel.x_scale = svg::Scale::kLogarithmic;
  panel.x_range = svg::Range{5.0, std::min(2000.0, r.frequency_hz.back())};
  return panel;
}

svg::Panel Magnitude(const FrequencyResponse& r, const ModelLines& model, Index i, Index j) {
  svg::Panel panel = EmptyPanel(r, i, j, "um/A");
  panel.y_scale = svg::Scale::kLogarithmic;
  svg::Series data{.name = "data", .colour = svg::Colour(0)};
  svg::Series noise{.name = "noise", .colour = "#aaaaaa", .width = 0.8};
  svg::Series fit{.name = "model", .colour = svg::Colour(1), .dashes = "6 3"};
  for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
    data.y.push_back(kMicro * std::abs(r.plant[k](i, j)));
    noise.y.push_back(kMicro * std::sqrt(r.variance[k](i, j)));
    if (!model.empty()) fit.y.push_back(kMicro * std::abs(model[k](i, j)));
  }
  for (svg::Series* s : {&noise, &data, &fit}) {
    if (s->y.empty()) continue;
    s->x = r.frequency_hz;
    panel.series.push_back(std::move(*s));
  }
  return panel;
}

/// Phase of the data; with a model the residual instead, which says more.
svg::Panel Second(const FrequencyResponse& r, const ModelLines& model, Index i, Index j) {
  svg::Panel panel = EmptyPanel(r, i, j, model.empty() ? "degrees" : "|residual| / noise");
  svg::Series line{.colour = svg::Colour(model.empty() ? 0 : 2), .width = 0.8};
  line.x = r.frequency_hz;
  line.y.reserve(line.x.size());
  for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
    const auto data = r.plant[k](i, j);
    line.y.push_back(model.empty()
                         ? std::arg(data) * 180.0 / std::numbers::pi
                         : std::abs(data - model[k](i, j)) / std::sqrt(r.variance[k](i, j)));
  }
  if (!model.empty()) {
    panel.y_scale = svg::Scale::kLogarithmic;
    panel.y_range = svg::Range{0.1, 1000.0};
  }
  panel.series.push_back(std::move(line));
  return panel;
}

}  // namespace

void WriteResponseCsv(const std::string& path, const std::vector<FrequencyResponse>& responses) {
  if (path.empty() || responses.empty()) return;
  std::string text = CsvHeader(responses.front());
  for (const FrequencyResponse& response : responses) AppendRows(response, text);
  std::ofstream file(path);
  file << text;
  file.flush();
  if (!file) {
    throw BadInput(path + ": cannot be written; check that the folder exists and is yours");
  }
}

nlohmann::ordered_json ResponseJson(const FrequencyResponse& r) {
  nlohmann::ordered_json json{
      {"speed_rpm", Rpm(r.speed_rad_per_s)},
      {"lines", r.frequency_hz.size()},
      {"periods", r.periods},
      {"line_spacing_hz", r.frequency_hz.size() > 1 ? r.frequency_hz[1] - r.frequency_hz[0] : 0.0},
      {"largest_orbit_m", r.largest_orbit_m},
      {"largest_current_a", r.largest_current_a},
      {"left_out_hz", r.left_out_hz},
      {"frequency_hz", r.frequency_hz}};
  for (Index j = 0; j < r.axes(); ++j) {
    for (Index i = 0; i < r.axes(); ++i) {
      auto& entry = json["plant"][Channel(r, i)][Channel(r, j)];
      for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
        entry["re_m_per_a"].push_back(r.plant[k](i, j).real());
        entry["im_m_per_a"].push_back(r.plant[k](i, j).imag());
        entry["sigma_m_per_a"].push_back(std::sqrt(r.variance[k](i, j)));
        entry["coherence"].push_back(r.coherence[k](i, j));
      }
    }
  }
  return json;
}

void WriteBode(const std::string& path, const FrequencyResponse& r, const ModelLines& model) {
  if (path.empty()) return;
  svg::Figure figure;
  figure.title = fmt::format("Plant P = G S^-1 at {:.0f} rpm, {} periods averaged",
                             Rpm(r.speed_rad_per_s), r.periods);
  // The axes of one plane are every other channel: de_x, nde_x, then de_y, nde_y.
  const auto per_plane = static_cast<std::size_t>((r.axes() + 1) / 2);
  figure.columns = per_plane * per_plane;
  figure.panel_width = 380;
  figure.panel_height = 250;
  for (Index plane = 0; plane < std::min<Index>(2, r.axes()); ++plane) {
    for (const bool magnitude : {true, false}) {
      for (Index j = plane; j < r.axes(); j += 2) {
        for (Index i = plane; i < r.axes(); i += 2) {
          figure.panels.push_back(magnitude ? Magnitude(r, model, i, j) : Second(r, model, i, j));
        }
      }
    }
  }
  svg::Write(path, figure);
}

}  // namespace levitas::cli
