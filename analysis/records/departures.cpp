#include "analysis/records/departures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/rotational_speed.hpp"

namespace levitas::analysis {
namespace {

/// Does a departing order of rotation sweep through the band and account for most of it?
bool ExplainedByAnOrder(const BandReport& band, const ChannelReport& report) {
  double slowest_hz = 1e300;
  double fastest_hz = 0.0;
  for (const auto& window : report.windows) {
    const double turns_hz = std::abs(window.speed_rad_per_s) / (2.0 * std::numbers::pi);
    slowest_hz = std::min(slowest_hz, turns_hz);
    fastest_hz = std::max(fastest_hz, turns_hz);
  }
  return std::any_of(report.orders.begin(), report.orders.end(), [&](const OrderReport& order) {
    return order.ratio >= kDepartureRatio && order.share > 0.5 * band.share &&
           order.order * fastest_hz >= band.low_hz && order.order * slowest_hz <= band.high_hz;
  });
}

/// A window stands out when it is worse than the channel as a whole, not when all are alike.
void CollectWindows(std::size_t channel, const ChannelReport& report,
                    std::vector<Departure>& departures) {
  const double whole = std::max(1.0, report.multiple / report.expected_multiple);
  double total = 0.0;
  for (const auto& window : report.windows) {
    total += std::max(0.0, window.ratio * window.ratio - 1.0);
  }
  for (const auto& window : report.windows) {
    if (window.ratio < kDepartureRatio * whole) continue;
    departures.push_back({channel,
                          fmt::format("{:.2f}-{:.2f} s ({:.0f} rpm)", window.start_s, window.end_s,
                                      RadPerSToRpm(window.speed_rad_per_s)),
                          window.ratio, (window.ratio * window.ratio - 1.0) / total});
  }
}

void Collect(std::size_t channel, const ChannelReport& report, std::vector<Departure>& departures) {
  for (const auto& order : report.orders) {
    if (order.ratio < kDepartureRatio) continue;
    departures.push_back({channel, fmt::format("{}x of rotation", order.order), order.ratio,
                          std::min(1.0, order.share)});
  }
  for (const auto& band : report.bands) {
    if (band.ratio < kDepartureRatio || ExplainedByAnOrder(band, report)) continue;
    departures.push_back({channel, fmt::format("{:.0f}-{:.0f} Hz", band.low_hz, band.high_hz),
                          band.ratio, std::min(1.0, band.share)});
  }
  for (const auto& band : report.excitation) {
    if (band.sigmas < kDepartureSigmas || band.ratio < kDepartureRatio) continue;
    departures.push_back(
        {channel, fmt::format("follows excitation, {:.0f}-{:.0f} Hz", band.low_hz, band.high_hz),
         band.ratio, band.share});
  }
  CollectWindows(channel, report, departures);
}

}  // namespace

std::vector<Departure> Departures(const std::vector<ChannelReport>& channels) {
  std::vector<Departure> departures;
  for (std::size_t channel = 0; channel < channels.size(); ++channel) {
    Collect(channel, channels[channel], departures);
  }
  // A share alone would put the whole of a channel at its noise before most of a wrong one.
  const auto power = [&](const Departure& departure) {
    const ChannelReport& report = channels[departure.channel];
    const double left =
        report.multiple * report.multiple - report.expected_multiple * report.expected_multiple;
    return departure.share * std::max(0.0, left);
  };
  std::stable_sort(departures.begin(), departures.end(),
                   [&](const Departure& a, const Departure& b) { return power(a) > power(b); });
  return departures;
}

}  // namespace levitas::analysis
