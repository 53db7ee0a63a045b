#include "cli/commands/comparison_text.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/rotational_speed.hpp"
#include "report/text/text_table.hpp"
#include "rt/say.hpp"

namespace levitas::cli {
namespace {

using analysis::OrderAmplitudes;
using Axes = std::vector<OrderAmplitudes> analysis::SynchronousRows::*;

std::string Number(double value, double unit, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", unit * value, digits) : "-";
}

/// Which quantity a table is of.
struct Quantity {
  Axes axes;
  double unit;
  int digits;
  bool radius;  ///< with the largest distance from the centre
};

/// Rows of one record at one speed: one per order, or the mean of a rotor that stands.
void AddRows(report::TextTable& table, const Quantity& quantity, const report::Comparison& c,
             const report::ComparedRecord& record, std::size_t speed) {
  const auto& at = record.speeds[speed];
  std::vector<std::string> start{fmt::format("{:.0f}", RadPerSToRpm(c.speeds_rad_per_s[speed])),
                                 rt::OneLine(record.label)};
  if (!at) {
    start.emplace_back("not in it");
    table.Add(std::move(start));
    return;
  }
  const bool standing = (at->found.*quantity.axes).front().amplitude.empty();
  const std::size_t rows = standing ? 1 : c.orders.size();
  for (std::size_t k = 0; k < rows; ++k) {
    std::vector<std::string> row = start;
    row.push_back(standing ? "mean"
                           : fmt::format("{}{:g}x", at->found.held ? "" : "~", c.orders[k]));
    for (const OrderAmplitudes& axis : at->found.*quantity.axes) {
      const double value = standing ? std::abs(axis.mean) : axis.amplitude[k];
      row.push_back(Number(value, quantity.unit, quantity.digits));
    }
    for (const double radius_m : at->found.largest_radius_m) {
      if (quantity.radius) row.push_back(k == 0 ? Number(radius_m, 1e6, 2) : "");
    }
    table.Add(std::move(row));
  }
}

std::string Table(const report::Comparison& c, const Quantity& quantity) {
  report::TextTable table;
  std::vector<std::string> head{"rpm", "record", "order"};
  head.insert(head.end(), c.channels.begin(), c.channels.end());
  if (quantity.radius) {
    for (const std::string& bearing : c.bearings) head.push_back("radius " + bearing);
  }
  table.Add(std::move(head));
  for (std::size_t speed = 0; speed < c.speeds_rad_per_s.size(); ++speed) {
    for (const auto& record : c.records) AddRows(table, quantity, c, record, speed);
  }
  return table.Text();
}

nlohmann::ordered_json AxesJson(const report::Comparison& c, const analysis::SynchronousRows& at) {
  auto axes = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < c.channels.size(); ++i) {
    axes.push_back({{"channel", c.channels[i]},
                    {"position_mean_m", at.position_m[i].mean},
                    {"position_m", at.position_m[i].amplitude},
                    {"control_current_mean_a", at.current_a[i].mean},
                    {"control_current_a", at.current_a[i].amplitude}});
  }
  return axes;
}

nlohmann::ordered_json SpeedJson(const report::Comparison& c, double speed_rad_per_s,
                                 const std::optional<report::AtSpeed>& at) {
  nlohmann::ordered_json json{{"speed_rpm", RadPerSToRpm(speed_rad_per_s)},
                              {"found", at ? at->found.held ? "held" : "passed" : "absent"}};
  if (!at) return json;
  json["mean_speed_rpm"] = RadPerSToRpm(at->found.speed_rad_per_s);
  json["from_s"] = at->from_s;
  json["duration_s"] = at->duration_s;
  json["turns"] = at->found.turns;
  json["axes"] = AxesJson(c, at->found);
  json["largest_radius_m"] = at->found.largest_radius_m;
  return json;
}

}  // namespace

std::string ComparisonText(const report::Comparison& c) {
  std::string text;
  for (const auto& record : c.records) {
    text += fmt::format("{}: {}, rig {}, {}{}\n", rt::OneLine(record.label),
                        rt::OneLine(record.path), rt::OneLine(record.rig),
                        record.controller.empty() ? "no controller named"
                                                  : "controller " + rt::OneLine(record.controller),
                        record.damage.empty() ? "" : "; not read whole: " + record.damage);
  }
  const Quantity current{&analysis::SynchronousRows::current_a, 1.0, 4, false};
  const Quantity position{&analysis::SynchronousRows::position_m, 1e6, 2, true};
  text += "\nControl current, amplitude [A]\n" + Table(c, current);
  text += "\nPosition, amplitude, and largest distance from the centre [um]\n" + Table(c, position);
  return text;
}

nlohmann::ordered_json ComparisonJson(const report::Comparison& c) {
  auto records = nlohmann::ordered_json::array();
  for (const auto& record : c.records) {
    auto speeds = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < record.speeds.size(); ++i) {
      speeds.push_back(SpeedJson(c, c.speeds_rad_per_s[i], record.speeds[i]));
    }
    auto over_speed = nlohmann::ordered_json::array();
    for (const auto& rows : record.over_speed) {
      over_speed.push_back({{"speed_rpm", RadPerSToRpm(rows.speed_rad_per_s)},
                            {"axes", AxesJson(c, rows)},
                            {"largest_radius_m", rows.largest_radius_m}});
    }
    records.push_back({{"label", record.label},
                       {"record", record.path},
                       {"rig", record.rig},
                       {"controller", record.controller},
                       {"damage", record.damage},
                       {"speeds", std::move(speeds)},
                       {"over_speed", std::move(over_speed)}});
  }
  return {{"channels", c.channels},
          {"bearings", c.bearings},
          {"orders", c.orders},
          {"records", std::move(records)}};
}

}  // namespace levitas::cli
