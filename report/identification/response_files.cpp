#include "report/identification/response_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/output_file.hpp"
#include "common/rotational_speed.hpp"
#include "identification/frf/measured_sensitivity.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {
namespace {

using Index = Eigen::Index;
constexpr double kMicro = 1e6;
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

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
  for (const std::string& axis : r.channels) {
    text += fmt::format(",sensitivity_sigma_{0}_from_{0}", axis);
  }
  return text + "\n";
}

void AppendRows(const FrequencyResponse& r, std::string& text) {
  for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
    text += fmt::format("{:.3f},{:.6f}", RadPerSToRpm(r.speed_rad_per_s), r.frequency_hz[k]);
    for (Index j = 0; j < r.axes(); ++j) {
      for (Index i = 0; i < r.axes(); ++i) {
        text += fmt::format(",{:.8e},{:.8e},{:.4e},{:.5f},{:.8e},{:.8e}", r.plant[k](i, j).real(),
                            r.plant[k](i, j).imag(), std::sqrt(r.variance[k](i, j)),
                            r.coherence[k](i, j), r.sensitivity[k](i, j).real(),
                            r.sensitivity[k](i, j).imag());
      }
    }
    for (const double variance : r.own_variance[k])
      text += fmt::format(",{:.4e}", std::sqrt(variance));
    text += '\n';
  }
}

/// The same pair of places in one plane and in the other: de_x from nde_x beside de_y from nde_y.
struct Pair {
  Index to, from;
};

svg::Panel EmptyPanel(const FrequencyResponse& r, const std::vector<Pair>& pairs,
                      const std::string& unit) {
  svg::Panel panel;
  for (const Pair& p : pairs) {
    panel.title +=
        (panel.title.empty() ? "" : ", ") + Channel(r, p.to) + " from " + Channel(r, p.from);
  }
  panel.x_label = "frequency, Hz";
  panel.y_label = unit;
  panel.x_scale = svg::Scale::kLogarithmic;
  panel.x_range = svg::Range{5.0, std::min(2000.0, r.frequency_hz.back())};
  return panel;
}

double Sigma(const FrequencyResponse& r, std::size_t line, const Pair& p) {
  return std::sqrt(r.variance[line](p.to, p.from));
}

/// Noise alone is larger than twice its standard deviation on 2 % of the lines, than thrice on one
/// in 8000: what is smaller says nothing, and draws nothing.
constexpr double kSaysSize = 2.0, kSaysPhase = 3.0;
bool Says(const FrequencyResponse& r, std::size_t line, const Pair& p, double sigmas) {
  return sigmas * Sigma(r, line, p) < std::abs(r.plant[line](p.to, p.from));
}

/// From somewhat below the noise to above the highest peak: a model goes on far below.
svg::Range MagnitudeRange(const FrequencyResponse& r, const std::vector<Pair>& pairs,
                          const svg::Range& x) {
  svg::Range range{std::numeric_limits<double>::infinity(), 0.0};
  for (const Pair& p : pairs) {
    for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
      if (r.frequency_hz[k] < x.low || r.frequency_hz[k] > x.high) continue;
      range.low = std::min(range.low, 0.5 * kMicro * Sigma(r, k, p));
      range.high = std::max(range.high, 2.0 * kMicro * std::abs(r.plant[k](p.to, p.from)));
    }
  }
  return range;
}

svg::Panel Magnitude(const FrequencyResponse& r, const ModelLines& model,
                     const std::vector<Pair>& pairs) {
  svg::Panel panel = EmptyPanel(r, pairs, "gain, µm/A");
  panel.y_scale = svg::Scale::kLogarithmic;
  panel.y_range = MagnitudeRange(r, pairs, *panel.x_range);
  std::vector<svg::Series> noises, datas, fits;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const Pair& p = pairs[n];
    const std::string& name = Channel(r, p.to);
    svg::Series data{.name = name, .x = r.frequency_hz, .colour = svg::Colour(n)};
    svg::Series noise{
        .name = n == 0 ? "noise" : "", .x = r.frequency_hz, .colour = "#bbbbbb", .width = 0.6};
    svg::Series fit{.name = n == 0 ? "model" : "",
                    .x = r.frequency_hz,
                    .colour = "#111111",
                    .width = 0.9,
                    .dashes = "5 3"};
    for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
      data.y.push_back(Says(r, k, p, kSaysSize) ? kMicro * std::abs(r.plant[k](p.to, p.from))
                                                : kGap);
      noise.y.push_back(kMicro * Sigma(r, k, p));
      if (!model.empty()) fit.y.push_back(kMicro * std::abs(model[k](p.to, p.from)));
    }
    noises.push_back(std::move(noise));
    datas.push_back(std::move(data));
    if (!model.empty()) fits.push_back(std::move(fit));
  }
  for (auto* all : {&noises, &datas, &fits}) {
    std::ranges::move(*all, std::back_inserter(panel.series));
  }
  return panel;
}

svg::Panel Phase(const FrequencyResponse& r, const std::vector<Pair>& pairs) {
  svg::Panel panel = EmptyPanel(r, pairs, "phase, degrees");
  panel.y_range = svg::Range{-190.0, 190.0};
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    svg::Series line{.name = Channel(r, pairs[n].to), .colour = svg::Colour(n)};
    for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
      const bool says = Says(r, k, pairs[n], kSaysPhase);
      const double degrees =
          says ? std::arg(r.plant[k](pairs[n].to, pairs[n].from)) * 180.0 / std::numbers::pi : kGap;
      // Across +-180 degrees there is no line to draw.
      if (!line.y.empty() && std::abs(degrees - line.y.back()) > 180.0) {
        line.x.push_back(r.frequency_hz[k]);
        line.y.push_back(kGap);
      }
      line.x.push_back(r.frequency_hz[k]);
      line.y.push_back(degrees);
    }
    panel.series.push_back(std::move(line));
  }
  return panel;
}

/// With a model the residual says more than the phase.
svg::Panel Residual(const FrequencyResponse& r, const ModelLines& model,
                    const std::vector<Pair>& pairs) {
  svg::Panel panel = EmptyPanel(r, pairs, "|residual| / noise");
  panel.y_scale = svg::Scale::kLogarithmic;
  panel.y_range = svg::Range{0.1, 100.0};
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const Pair& p = pairs[n];
    svg::Series dots{.name = Channel(r, p.to),
                     .x = r.frequency_hz,
                     .colour = svg::Colour(n),
                     .width = 0,
                     .mark = svg::Mark::kDot,
                     .mark_size = 1.2};
    for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
      dots.y.push_back(std::abs(r.plant[k](p.to, p.from) - model[k](p.to, p.from)) /
                       Sigma(r, k, p));
    }
    panel.series.push_back(std::move(dots));
  }
  return panel;
}

/// |S_ii| of a place in both planes, where it is clear of its noise, with the borders of the zones.
svg::Panel Sensitivity(const FrequencyResponse& r, const std::vector<Pair>& pairs) {
  svg::Panel panel = EmptyPanel(r, pairs, "|S| measured");
  panel.title = "sensitivity";
  panel.y_scale = svg::Scale::kLogarithmic;
  for (const double border : {3.0, 4.0, 5.0}) {
    panel.series.push_back({.name = border == 3.0 ? "zones A to D" : "",
                            .x = {panel.x_range->low, panel.x_range->high},
                            .y = {border, border},
                            .colour = "#bbbbbb",
                            .width = 0.8,
                            .dashes = "5 3"});
  }
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const Index i = pairs[n].to;
    svg::Series line{.name = Channel(r, i), .x = r.frequency_hz, .colour = svg::Colour(n)};
    for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
      const double size = std::abs(r.sensitivity[k](i, i));
      line.y.push_back(kSaysSize * std::sqrt(r.own_variance[k][i]) < size ? size : kGap);
    }
    panel.series.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

void WriteResponseCsv(const std::string& path, const std::vector<FrequencyResponse>& responses) {
  if (path.empty() || responses.empty()) return;
  std::string text = CsvHeader(responses.front());
  for (const FrequencyResponse& response : responses) AppendRows(response, text);
  WriteWholeFile(path, text);
}

nlohmann::ordered_json ResponseJson(const FrequencyResponse& r) {
  nlohmann::ordered_json json{
      {"speed_rpm", RadPerSToRpm(r.speed_rad_per_s)},
      {"excited",
       r.point == identification::SummingPoint::kReading ? "measured_position" : "control_current"},
      {"lines", r.frequency_hz.size()},
      {"periods", r.periods},
      {"line_spacing_hz", r.frequency_hz.size() > 1 ? r.frequency_hz[1] - r.frequency_hz[0] : 0.0},
      {"largest_orbit_m", r.largest_orbit_m},
      {"largest_current_a", r.largest_current_a},
      {"left_out_hz", r.left_out_hz},
      {"frequency_hz", r.frequency_hz}};
  for (const auto& peak : identification::MeasuredPeaks(r)) {
    json["measured_sensitivity"].push_back(
        {{"channel", peak.channel},
         {"sensitivity_peak", peak.peak},
         {"sigma", peak.sigma},
         {"fitted_lines", peak.lines},
         {"largest_line", peak.line_peak},
         {"largest_line_sigma", peak.line_sigma},
         {"frequency_hz", peak.frequency_hz},
         {"line_spacing_hz", peak.spacing_hz},
         {"zone", peak.zone ? nlohmann::ordered_json(std::string(analysis::Name(*peak.zone)))
                            : nlohmann::ordered_json(nullptr)},
         {"refused", peak.refused}});
  }
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
  figure.title = fmt::format("Plant P = G Q^-1 at {:.0f} rpm, {} periods averaged",
                             RadPerSToRpm(r.speed_rad_per_s), r.periods);
  // The axes of one plane are every other channel: de_x, nde_x, then de_y, nde_y.
  const Index planes = std::min<Index>(2, r.axes());
  const Index per_plane = r.axes() / planes;
  figure.columns = static_cast<std::size_t>(per_plane);
  figure.panel_width = 640;
  figure.panel_height = 300;
  for (Index from = 0; from < per_plane; ++from) {
    for (const bool magnitude : {true, false}) {
      for (Index to = 0; to < per_plane; ++to) {
        std::vector<Pair> pairs;
        for (Index plane = 0; plane < planes; ++plane) {
          pairs.push_back({planes * to + plane, planes * from + plane});
        }
        figure.panels.push_back(magnitude       ? Magnitude(r, model, pairs)
                                : model.empty() ? Phase(r, pairs)
                                                : Residual(r, model, pairs));
      }
    }
  }
  for (Index place = 0; model.empty() && place < per_plane; ++place) {
    std::vector<Pair> own;
    for (Index plane = 0; plane < planes; ++plane) {
      own.push_back({planes * place + plane, planes * place + plane});
    }
    figure.panels.push_back(Sensitivity(r, own));
  }
  svg::Write(path, figure);
}

}  // namespace levitas::report
