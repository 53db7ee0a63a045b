#include "cli/study/free_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/text_file.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "report/svg/figure.hpp"
#include "report/text/text_table.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::cli {
namespace {

using analysis::FreeRunSegment;

constexpr double kShownS = 0.1;  // of a segment, in the picture

std::string FitText(double percent) {
  return std::isfinite(percent) ? fmt::format("{:.2f}", percent) : "-";
}

double TimeOf(const session::Recording& recording, std::size_t row) {
  return static_cast<double>(recording.cycle[row] - recording.cycle.front()) * recording.period_s();
}

bool Excited(const FreeRunSegment& segment, std::size_t axis) {
  return std::ranges::find(segment.excited, axis) != segment.excited.end();
}

std::vector<std::string> ChannelsOf(const FreeRunContext& c, const FreeRunSegment& segment) {
  std::vector<std::string> names;
  for (const std::size_t axis : segment.excited) names.push_back(c.rig.channels[axis]);
  return names;
}

double MotionOf(const session::Column& column, const session::RowRange& rows) {
  const auto [low, high] =
      std::minmax_element(column.begin() + static_cast<std::ptrdiff_t>(rows.begin),
                          column.begin() + static_cast<std::ptrdiff_t>(rows.end));
  return *high - *low;
}

svg::Series Curve(const FreeRunContext& c, const session::Column& column,
                  const session::RowRange& rows) {
  svg::Series curve;
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    curve.x.push_back(TimeOf(c.recording, row));
    curve.y.push_back(1e6 * column[row]);
  }
  return curve;
}

svg::Panel PanelOf(const FreeRunContext& c, const FreeRunSegment& segment, std::size_t excited,
                   std::size_t axis) {
  const auto shown = static_cast<std::size_t>(std::lround(kShownS / c.recording.period_s()));
  const session::RowRange rows{segment.rows.begin,
                               std::min(segment.rows.end, segment.rows.begin + shown)};
  svg::Panel panel;
  panel.title = fmt::format("{}, excited at {}, {:.0f} rpm: fit {} %", c.rig.channels[axis],
                            c.rig.channels[excited], RadPerSToRpm(segment.speed_rad_per_s),
                            FitText(segment.fit_percent[axis]));
  panel.x_label = "time, s";
  panel.y_label = "position, µm";
  svg::Series measured = Curve(c, c.recording.position_m[axis], rows);
  measured.name = "measured";
  measured.colour = svg::Colour(0);
  svg::Series model = Curve(c, c.run.model_m[axis], rows);
  model.name = "model, free run";
  model.colour = svg::Colour(1);
  model.dashes = "5 2";
  panel.series = {std::move(measured), std::move(model)};
  return panel;
}

/// The axis beside the excited one that moves most; the same one on a rig that has no other.
std::size_t Companion(const FreeRunContext& c, const FreeRunSegment& segment, std::size_t excited) {
  std::size_t best = excited;
  double most = -1.0;
  for (std::size_t axis = 0; axis < c.rig.axes(); ++axis) {
    const double motion = MotionOf(c.recording.position_m[axis], segment.rows);
    if (axis == excited || motion <= most) continue;
    most = motion;
    best = axis;
  }
  return best;
}

}  // namespace

std::optional<ControllerOfRecord> ControllerIfKnown(const std::string& record_path,
                                                    const std::string& controller_name,
                                                    const configuration::RigFile& rig) {
  if (!controller_name.empty()) {
    const std::string path = configuration::FindConfig(controller_name, "controllers");
    auto file = configuration::LoadController(path, rig.numbers);
    std::string name = fmt::format("{} ({})", file.name, path);
    return ControllerOfRecord{std::move(name), std::move(file)};
  }
  std::string text;
  if (session::IsSession(record_path)) {
    text = session::SessionReader(record_path).header().controller_yaml;
  }
  if (text.empty()) return std::nullopt;
  auto file = configuration::ParseController(text, record_path + " (header)", rig.numbers);
  std::string name = file.name + " (of the session)";
  return ControllerOfRecord{std::move(name), std::move(file)};
}

std::optional<LawOfRecord> LawIfKnown(const std::string& record_path,
                                      const std::string& controller_name,
                                      const configuration::RigFile& rig) {
  const auto known = ControllerIfKnown(record_path, controller_name, rig);
  if (!known) return std::nullopt;
  return LawOfRecord{known->name, known->file.law};
}

LawOfRecord FindLaw(const std::string& record_path, const std::string& controller_name,
                    const configuration::RigFile& rig) {
  auto known = LawIfKnown(record_path, controller_name, rig);
  if (known) return std::move(*known);
  throw BadInput(record_path +
                 ": names no controller, and a free run is one of model and law in closed loop: "
                 "give the law with --controller");
}

void PrintFreeRun(const FreeRunContext& c) {
  fmt::print(
      "\nFree run in closed loop with the law {}: fit in percent (100: the same; 0: no better "
      "than the mean), * excited\n",
      c.law);
  report::TextTable table;
  std::vector<std::string> head{"from s", "to s", "rpm"};
  head.insert(head.end(), c.rig.channels.begin(), c.rig.channels.end());
  table.Add(std::move(head));
  for (const FreeRunSegment& segment : c.run.segments) {
    std::vector<std::string> row{fmt::format("{:.2f}", TimeOf(c.recording, segment.rows.begin)),
                                 fmt::format("{:.2f}", TimeOf(c.recording, segment.rows.end - 1)),
                                 fmt::format("{:.0f}", RadPerSToRpm(segment.speed_rad_per_s))};
    for (std::size_t axis = 0; axis < c.rig.axes(); ++axis) {
      const std::string fit = FitText(segment.fit_percent[axis]);
      row.push_back(Excited(segment, axis) ? fmt::format("*{}", fit) : fit);
    }
    table.Add(std::move(row));
  }
  std::vector<std::string> all{"all", "", ""};
  std::vector<std::string> one_step{"one step", "", ""};
  for (std::size_t axis = 0; axis < c.rig.axes(); ++axis) {
    all.push_back(FitText(c.run.fit_percent[axis]));
    one_step.push_back(FitText(c.run.one_step_fit_percent[axis]));
  }
  table.Add(std::move(all));
  table.Add(std::move(one_step));
  fmt::print("{}", table.Text());
  if (!c.run.finite) fmt::print("The model's loop diverges: its numbers are no longer finite.\n");
}

nlohmann::ordered_json FreeRunJson(const FreeRunContext& c) {
  auto segments = nlohmann::ordered_json::array();
  for (const FreeRunSegment& segment : c.run.segments) {
    segments.push_back({{"from_s", TimeOf(c.recording, segment.rows.begin)},
                        {"to_s", TimeOf(c.recording, segment.rows.end - 1)},
                        {"speed_rpm", RadPerSToRpm(segment.speed_rad_per_s)},
                        {"excited", ChannelsOf(c, segment)},
                        {"fit_percent", segment.fit_percent}});
  }
  return {{"law", c.law},
          {"channels", c.rig.channels},
          {"fit_percent", c.run.fit_percent},
          {"one_step_fit_percent", c.run.one_step_fit_percent},
          {"finite", c.run.finite},
          {"segments", std::move(segments)}};
}

void WriteFreeRunCsv(const std::string& path, const FreeRunContext& c) {
  if (path.empty()) return;
  std::string text = "time_s,speed_rpm";
  for (const std::string& channel : c.rig.channels) {
    text += fmt::format(",measured_{0}_m,model_{0}_m", channel);
  }
  text += '\n';
  for (const FreeRunSegment& segment : c.run.segments) {
    for (std::size_t row = segment.rows.begin; row < segment.rows.end; ++row) {
      text += fmt::format("{:.9g},{:.12g}", TimeOf(c.recording, row),
                          RadPerSToRpm(c.recording.speed_rad_per_s[row]));
      for (std::size_t axis = 0; axis < c.rig.axes(); ++axis) {
        text += fmt::format(",{:.9g},{:.9g}", c.recording.position_m[axis][row],
                            c.run.model_m[axis][row]);
      }
      text += '\n';
    }
  }
  WriteTextFile(path, text);
}

void WriteFreeRunSvg(const std::string& path, const FreeRunContext& c) {
  if (path.empty()) return;
  svg::Figure figure;
  figure.title = "Response to the test signal: measured, and model in closed loop";
  figure.columns = 2;
  figure.panel_width = 520;
  std::set<std::size_t> shown;
  for (const FreeRunSegment& segment : c.run.segments) {
    for (const std::size_t axis : segment.excited) {
      if (!shown.insert(axis).second) continue;
      figure.panels.push_back(PanelOf(c, segment, axis, axis));
      const std::size_t beside = Companion(c, segment, axis);
      if (beside != axis) figure.panels.push_back(PanelOf(c, segment, axis, beside));
    }
  }
  svg::Write(path, figure);
}

}  // namespace levitas::cli
