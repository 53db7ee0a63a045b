#include "cli/study/design/compare_page.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/rotational_speed.hpp"
#include "controller/law/law_schedule.hpp"
#include "design/uncertainty/uncertain_plant.hpp"
#include "report/html/escaped_text.hpp"
#include "report/html/table.hpp"
#include "report/svg/figure.hpp"

namespace levitas::cli {
namespace {

std::string Slashed(const std::vector<double>& values, double scale, const char* format) {
  std::string out;
  for (const double value : values)
    out += (out.empty() ? "" : "/") + fmt::format(fmt::runtime(format), scale * value);
  return out;
}

void AddBode(const std::vector<Compared>& compared, const configuration::RigFile& rig,
             svg::Figure& figure) {
  constexpr int kPoints = 400;
  for (std::size_t b = 0; b < rig.numbers.bearings.size(); ++b) {
    const std::size_t axis = 2 * b;
    svg::Panel gain{fmt::format("controller, {}", rig.numbers.channels[axis]), "frequency [Hz]",
                    "|current/position| [A/mm]", svg::Scale::kLogarithmic,
                    svg::Scale::kLogarithmic};
    svg::Panel phase{gain.title, "frequency [Hz]", "phase [deg]", svg::Scale::kLogarithmic};
    for (std::size_t c = 0; c < compared.size(); ++c) {
      const uncertainty::LawResponse response(law::LawAt(compared[c].law, 0.0));
      svg::Series size{compared[c].name};
      size.colour = svg::Colour(c);
      svg::Series angle = size;
      for (int i = 0; i < kPoints; ++i) {
        const double hz = 0.1 * std::pow(4e4, i / (kPoints - 1.0));
        const auto k = static_cast<Eigen::Index>(axis);
        const std::complex<double> at = -response.At(hz)(k, k);
        size.x.push_back(hz);
        size.y.push_back(1e-3 * std::abs(at));
        angle.x.push_back(hz);
        angle.y.push_back(std::arg(at) * 180.0 / std::numbers::pi);
      }
      gain.series.push_back(std::move(size));
      phase.series.push_back(std::move(angle));
    }
    figure.panels.push_back(std::move(gain));
    figure.panels.push_back(std::move(phase));
  }
}

svg::Series Circle(double radius_um) {
  svg::Series out{"objective"};
  out.colour = "#666666";
  out.dashes = "5 3";
  for (int i = 0; i <= 72; ++i) {
    const double angle = i * std::numbers::pi / 36.0;
    out.x.push_back(radius_um * std::cos(angle));
    out.y.push_back(radius_um * std::sin(angle));
  }
  return out;
}

double Largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::ranges::max_element(values);
}

svg::Panel CurrentOverSpeed(const std::vector<Compared>& compared,
                            const std::vector<double>& speeds_rpm) {
  svg::Panel panel{"largest synchronous control current", "speed [rpm]", "[A]"};
  for (std::size_t c = 0; c < compared.size(); ++c) {
    svg::Series line{compared[c].name};
    line.colour = svg::Colour(c);
    for (std::size_t i = 0; i < speeds_rpm.size(); ++i) {
      if (compared[c].runs[i].lost) continue;
      line.x.push_back(speeds_rpm[i]);
      line.y.push_back(Largest(compared[c].runs[i].synchronous_a));
    }
    panel.series.push_back(std::move(line));
  }
  return panel;
}

svg::Panel WorstOverSpeed(const std::vector<Compared>& compared) {
  svg::Panel panel{"worst orbit of the drawn rigs, those that were lost left out", "speed [rpm]",
                   "[µm]"};
  for (std::size_t c = 0; c < compared.size(); ++c) {
    svg::Series line{compared[c].name};
    line.colour = svg::Colour(c);
    for (const design::DrawnSpeed& at : compared[c].drawn) {
      line.x.push_back(RadPerSToRpm(at.speed_rad_per_s));
      line.y.push_back(1e6 * Largest(at.worst_orbit_m));
    }
    panel.series.push_back(std::move(line));
  }
  return panel;
}

svg::Panel PeakOverSpeed(const std::vector<Compared>& compared) {
  svg::Panel peaks{"largest |S| of an axis", "speed [rpm]", "[1]"};
  for (std::size_t c = 0; c < compared.size(); ++c) {
    svg::Series line{compared[c].name, compared[c].speed_rpm, compared[c].peak};
    line.colour = svg::Colour(c);
    peaks.series.push_back(std::move(line));
  }
  return peaks;
}

/// Which orbit of the runs.
struct OrbitAt {
  std::size_t speed{}, bearing{};
};

svg::Panel OrbitPanel(const std::vector<Compared>& compared, const configuration::RigFile& rig,
                      const std::vector<double>& speeds_rpm, OrbitAt at) {
  const double speed_rpm = speeds_rpm[at.speed];
  const double objective_m = speed_rpm > 0.0 ? rig.numbers.spinning_orbit_objective_m
                                             : rig.numbers.standing_orbit_objective_m;
  svg::Panel panel{
      fmt::format("orbit, {}, {:.0f} rpm", rig.numbers.bearings[at.bearing], speed_rpm), "x [µm]",
      "y [µm]"};
  panel.same_scale = true;
  if (objective_m > 0.0) panel.series.push_back(Circle(1e6 * objective_m));
  for (std::size_t c = 0; c < compared.size(); ++c) {
    svg::Series orbit{compared[c].name};
    orbit.colour = svg::Colour(c);
    for (const AxisArray& centre_m : compared[c].runs[at.speed].positions_m) {
      orbit.x.push_back(1e6 * centre_m[2 * at.bearing]);
      orbit.y.push_back(1e6 * centre_m[2 * at.bearing + 1]);
    }
    panel.series.push_back(std::move(orbit));
  }
  return panel;
}

svg::Figure Picture(const std::vector<Compared>& compared, const configuration::RigFile& rig,
                    const std::vector<double>& speeds_rpm) {
  svg::Figure figure;
  figure.columns = 2;
  AddBode(compared, rig, figure);
  figure.panels.push_back(PeakOverSpeed(compared));
  figure.panels.push_back(CurrentOverSpeed(compared, speeds_rpm));
  for (std::size_t i = 0; i < speeds_rpm.size(); ++i)
    for (std::size_t b = 0; b < rig.numbers.bearings.size(); ++b)
      figure.panels.push_back(OrbitPanel(compared, rig, speeds_rpm, {i, b}));
  figure.panels.push_back(WorstOverSpeed(compared));
  return figure;
}

/// The first row is the head.
std::string HtmlTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<html::Column> head;
  for (const std::string& title : rows.front()) head.push_back({title});
  html::Table table(std::move(head));
  for (std::size_t r = 1; r < rows.size(); ++r) table.Add(rows[r]);
  return table.Html();
}

}  // namespace

std::size_t Compared::Lost() const {
  std::size_t sum = 0;
  for (const design::DrawnSpeed& at : drawn) sum += at.lost;
  return sum;
}

double Compared::WorstOrbit() const {
  double worst_m = 0.0;
  for (const design::DrawnSpeed& at : drawn) worst_m = std::max(worst_m, Largest(at.worst_orbit_m));
  return worst_m;
}

std::vector<std::vector<std::string>> ComparedRows(const std::vector<Compared>& compared,
                                                   const std::vector<double>& speeds_rpm) {
  std::vector<std::vector<std::string>> rows{{""}};
  for (const Compared& c : compared) rows.front().push_back(c.name);
  const auto row = [&](const std::string& name, const auto& text_of) {
    rows.push_back({name});
    for (const Compared& c : compared) rows.back().push_back(text_of(c));
  };
  for (std::size_t i = 0; i < speeds_rpm.size(); ++i) {
    row(fmt::format("largest orbit of the run at {:.0f} rpm [um]", speeds_rpm[i]),
        [&](const Compared& c) {
          return c.runs[i].lost ? std::string("LOST") : Slashed(c.runs[i].orbit_m, 1e6, "{:.1f}");
        });
    row(fmt::format("{} current at {:.0f} rpm [A]", speeds_rpm[i] > 0.0 ? "1x" : "static",
                    speeds_rpm[i]),
        [&](const Compared& c) {
          return Slashed(speeds_rpm[i] > 0.0 ? c.runs[i].synchronous_a : c.runs[i].static_a, 1.0,
                         "{:.3f}");
        });
  }
  row("|S| over speed, largest",
      [](const Compared& c) { return fmt::format("{:.2f}", Largest(c.peak)); });
  row("mu, at most",
      [](const Compared& c) { return fmt::format("{:.2f} at {:.1f} Hz", c.mu.value, c.mu.hz); });
  row("drawn rigs at 20 speeds: lost, largest orbit [um]", [](const Compared& c) {
    return fmt::format("{} of {} runs, {:.1f}", c.Lost(), c.Runs(), 1e6 * c.WorstOrbit());
  });
  row("one period of the law, here [ns]",
      [](const Compared& c) { return fmt::format("{:.0f}", c.step_ns); });
  return rows;
}

std::string ComparePage(const std::vector<Compared>& compared, const configuration::RigFile& rig,
                        const std::vector<double>& speeds_rpm) {
  const std::string title =
      fmt::format("Controllers compared on rig {}", html::Escaped(rig.numbers.name));
  return fmt::format(
             "<!doctype html><meta charset=\"utf-8\"><title>{0}</title>\n<style>"
             "body{{font-family:sans-serif;margin:2em}}table{{border-collapse:collapse}}"
             "td,th{{border:1px solid #ccc;padding:.2em .6em;text-align:right}}"
             "td:first-child{{text-align:left}}</style>\n<h1>{0}</h1>\n",
             title) +
         HtmlTable(ComparedRows(compared, speeds_rpm)) +
         "<p>Orbits and currents: drive end and other end, axis by axis; dashed circles are the "
         "rig file's objectives.</p>\n" +
         svg::Draw(Picture(compared, rig, speeds_rpm)) + "\n";
}

}  // namespace levitas::cli
