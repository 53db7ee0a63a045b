#include "dashboard/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "lcmtypes/checked_decode.hpp"

namespace levitas::dashboard {
namespace {

/// With four digits, finer than a screen: the text stays short.
nlohmann::json RoundedNumber(double value) {
  constexpr double kDigits = 1e4;
  if (!std::isfinite(value)) return {};
  if (value == 0.0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value)))) / kDigits;
  return std::isnormal(unit) ? std::round(value / unit) * unit : value;
}

}  // namespace

void ConvergenceHistory::RunIs(std::int64_t start_utc_ns, double period_s) {
  start_utc_ns_ = start_utc_ns;
  period_s_ = period_s;
  points_.clear();
}

bool ConvergenceHistory::Take(std::span<const std::uint8_t> payload, bool& told) {
  told = false;
  levitas_msg::convergence_t point{};
  if (!message::DecodeChecked(payload, point)) return false;
  if (!(period_s_ > 0.0) || point.start_utc_ns != start_utc_ns_) return true;
  const bool another = !points_.empty() && (point.rows <= points_.back().rows ||
                                            point.outputs != points_.back().outputs);
  if (another) points_.clear();
  points_.push_back(std::move(point));
  if (points_.size() > kMost) points_.pop_front();
  told = true;
  return true;
}

std::string ConvergenceHistory::Json() const {
  if (points_.empty()) return "{}";
  const levitas_msg::convergence_t& newest = points_.back();
  const auto outputs = static_cast<std::size_t>(newest.outputs);
  nlohmann::json json{{"tolerance_percent", RoundedNumber(100.0 * newest.tolerance)},
                      {"converged", newest.converged != 0},
                      {"rows", newest.rows},
                      {"gaps", newest.gaps},
                      {"missing_rows", newest.missing_rows},
                      {"begun_anew", newest.begun_anew},
                      {"changed", newest.changed}};
  json["error_um"] = nlohmann::json::array();
  json["fit_percent"] = nlohmann::json::array();
  for (std::size_t i = 0; i < outputs; ++i) {
    json["error_um"].push_back(RoundedNumber(1e6 * newest.error_rms_m[i]));
    json["fit_percent"].push_back(nlohmann::json::array());
  }
  json["t_s"] = json["change_percent"] = nlohmann::json::array();
  for (const levitas_msg::convergence_t& point : points_) {
    json["t_s"].push_back(std::round(1e3 * static_cast<double>(point.cycle) * period_s_) / 1e3);
    json["change_percent"].push_back(RoundedNumber(100.0 * point.change));
    for (std::size_t i = 0; i < outputs; ++i) {
      json["fit_percent"][i].push_back(RoundedNumber(point.fit_percent[i]));
    }
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace levitas::dashboard
