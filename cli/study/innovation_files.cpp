#include "cli/study/innovation_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/options/analysis_options.hpp"
#include "cli/text_file.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::cli {
namespace {

using Document = nlohmann::ordered_json;

Document ChannelJson(const InnovationContext& context, std::size_t i) {
  const auto& channel = context.report.channels[i];
  Document json{{"channel", context.rig.channels[i]},
                {"rms_m", channel.rms_m},
                {"sensor_noise_m", context.gain.sensor_noise_m[i]},
                {"multiple_of_noise", channel.multiple},
                {"expected_multiple", channel.expected_multiple},
                {"peak_m", channel.peak_m},
                {"lag_one_correlation", channel.lag_one},
                {"dominant_frequency_hz", channel.dominant_hz},
                {"dominant_density_ratio", channel.dominant_ratio},
                {"unknown_force_n", context.run.unknown_force_n[i]}};
  for (const auto& band : channel.bands) {
    json["bands"].push_back({{"low_hz", band.low_hz},
                             {"high_hz", band.high_hz},
                             {"ratio", band.ratio},
                             {"share", band.share}});
  }
  json["excitation"] = Document::array();
  for (const auto& band : channel.excitation) {
    json["excitation"].push_back({{"low_hz", band.low_hz},
                                  {"high_hz", band.high_hz},
                                  {"ratio", band.ratio},
                                  {"sigmas", band.sigmas},
                                  {"share", band.share}});
  }
  json["orders"] = Document::array();
  for (const auto& order : channel.orders) {
    json["orders"].push_back({{"order", order.order},
                              {"amplitude_m", order.amplitude_m},
                              {"ratio", order.ratio},
                              {"share", order.share}});
  }
  for (const auto& window : channel.windows) {
    json["windows"].push_back({{"start_s", window.start_s},
                               {"end_s", window.end_s},
                               {"speed_rpm", RadPerSToRpm(window.speed_rad_per_s)},
                               {"ratio", window.ratio}});
  }
  return json;
}

/// Logarithmic axes of the picture, in its own pixels.
struct Chart {
  double left{70}, right{880}, top{20}, bottom{430};
  double low_hz{}, high_hz{};
  double low{}, high{};  ///< amplitude density
  [[nodiscard]] double X(double f) const {
    return left + (right - left) * std::log(f / low_hz) / std::log(high_hz / low_hz);
  }
  [[nodiscard]] double Y(double value) const {
    return bottom -
           (bottom - top) * std::log(std::clamp(value, low, high) / low) / std::log(high / low);
  }
};

Chart ChartFor(const InnovationContext& context) {
  Chart chart;
  const auto& channels = context.report.channels;
  chart.low_hz = context.report.line_spacing_hz;
  chart.high_hz = chart.low_hz * static_cast<double>(channels.front().density_m2_per_hz.size() - 1);
  double largest = 0.0;
  double smallest = 1.0;
  for (const auto& channel : channels) {
    for (std::size_t i = 1; i < channel.density_m2_per_hz.size(); ++i) {
      const double amplitude = std::sqrt(channel.density_m2_per_hz[i]);
      largest = std::max(largest, amplitude);
      smallest = std::min(smallest, amplitude);
    }
  }
  chart.low = std::pow(10.0, std::floor(std::log10(std::max(smallest, 1e-12))));
  chart.high = std::max(10.0 * chart.low, std::pow(10.0, std::ceil(std::log10(largest))));
  return chart;
}

std::string Grid(const Chart& chart) {
  std::string svg;
  for (double f = std::pow(10.0, std::ceil(std::log10(chart.low_hz))); f <= chart.high_hz;
       f *= 10) {
    svg += fmt::format(
        "<path d='M{0:.1f} {1}V{2}' stroke='#ccc'/><text x='{0:.1f}' y='{3}' "
        "text-anchor='middle'>{4:g} Hz</text>\n",
        chart.X(f), chart.top, chart.bottom, chart.bottom + 18, f);
  }
  for (double v = chart.low; v <= 1.001 * chart.high; v *= 10) {
    svg += fmt::format(
        "<path d='M{0} {1:.1f}H{2}' stroke='#ccc'/><text x='{3}' y='{4:.1f}' "
        "text-anchor='end'>{5:.0e}</text>\n",
        chart.left, chart.Y(v), chart.right, chart.left - 6, chart.Y(v) + 4, v);
  }
  return svg;
}

}  // namespace

Document InnovationJson(const InnovationContext& context) {
  const auto& [rig, gain, run, report] = context;
  Document json{{"rig", rig.name},
                {"compared_s", report.duration_s},
                {"pieces", run.pieces.size()},
                {"gaps", run.gaps},
                {"settling_samples", run.settling_rows},
                {"not_levitated_samples", run.idle_rows},
                {"line_spacing_hz", report.line_spacing_hz}};
  for (std::size_t i = 0; i < report.channels.size(); ++i) {
    json["channels"].push_back(ChannelJson(context, i));
  }
  json["departures"] = Document::array();
  for (const auto& departure : report.departures) {
    json["departures"].push_back({{"channel", rig.channels[departure.channel]},
                                  {"place", departure.place},
                                  {"ratio", departure.ratio},
                                  {"share", departure.share}});
  }
  return json;
}

void WriteSpectrumCsv(const std::string& path, const InnovationContext& context) {
  if (path.empty()) return;
  std::string text = "frequency_hz";
  for (const auto& channel : context.rig.channels) {
    text += fmt::format(",density_{}_m2_per_hz", channel);
  }
  const auto& channels = context.report.channels;
  for (std::size_t line = 0; line < channels.front().density_m2_per_hz.size(); ++line) {
    text += fmt::format("\n{:.6g}", static_cast<double>(line) * context.report.line_spacing_hz);
    for (const auto& channel : channels) {
      text += fmt::format(",{:.6g}", channel.density_m2_per_hz[line]);
    }
  }
  WriteTextFile(path, text + '\n');
}

void WriteSpectrumSvg(const std::string& path, const InnovationContext& context) {
  if (path.empty()) return;
  constexpr std::array kColours{"#1f77b4", "#ff7f0e", "#2ca02c", "#d62728",
                                "#9467bd", "#8c564b", "#e377c2", "#7f7f7f"};
  const Chart chart = ChartFor(context);
  std::string svg =
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 900 470' font-family='sans-serif' "
      "font-size='12'>\n<rect width='900' height='470' fill='white'/>\n" +
      Grid(chart);
  svg += fmt::format(
      "<text x='{}' y='14'>innovation, m/sqrt(Hz); dashed: what noise explains</text>\n",
      chart.left);
  const double nyquist_hz = 0.5 / context.run.period_s;
  for (std::size_t i = 0; i < context.report.channels.size(); ++i) {
    const auto& density = context.report.channels[i].density_m2_per_hz;
    svg += fmt::format("<polyline fill='none' stroke='{}' points='", kColours[i]);
    for (std::size_t line = 1; line < density.size(); ++line) {
      const double f = static_cast<double>(line) * context.report.line_spacing_hz;
      svg += fmt::format("{:.1f},{:.1f} ", chart.X(f), chart.Y(std::sqrt(density[line])));
    }
    const double expected = context.gain.expected_innovation_m[i] / std::sqrt(nyquist_hz);
    svg += fmt::format(
        "'/>\n<path d='M{} {:.1f}H{}' stroke='{}' stroke-dasharray='6 4'/>\n"
        "<text x='{}' y='{}' fill='{}'>{}</text>\n",
        chart.left, chart.Y(expected), chart.right, kColours[i], 90 + 70 * i, 460, kColours[i],
        context.rig.channels[i]);
  }
  WriteTextFile(path, svg + "</svg>\n");
}

}  // namespace levitas::cli
