#include "report/session/pictures.hpp"

#include <algorithm>
#include <iterator>

#include "verdict/session_statistics.hpp"

namespace levitas::report {

svg::Figure Wide(svg::Panel panel) {
  svg::Figure figure;
  figure.panel_width = 440;
  figure.panel_height = 270;
  figure.panels.push_back(std::move(panel));
  return figure;
}

svg::Series Level(const std::string& name, double from_x, double to_x, double y) {
  svg::Series level;
  level.name = name;
  level.x = {from_x, to_x};
  level.y = {y, y};
  level.colour = "#666666";
  level.width = 1.0;
  level.dashes = "6 3";
  return level;
}

std::vector<double> ChosenSpeeds(const Recording& recording,
                                 const std::vector<SynchronousPoint>& points) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const double speed = std::abs(static_cast<double>(recording.speed_rad_per_s[i]));
    if (recording.levitated[i] && speed <= recording.standstill_rad_per_s) {
      speeds.push_back(0.0);
      break;
    }
  }
  const auto size = [](const SynchronousPoint& point) {
    double largest = 0.0;
    for (const auto& forward : point.forward_m) largest = std::max(largest, std::abs(forward));
    return largest;
  };
  const auto worst =
      std::max_element(points.begin(), points.end(),
                       [&](const auto& a, const auto& b) { return size(a) < size(b); });
  if (worst != points.end()) {
    // Unless it is the top speed anyhow.
    if (worst->speed_rad_per_s < 0.97 * recording.top_speed_rad_per_s) {
      speeds.push_back(worst->speed_rad_per_s);
    }
    speeds.push_back(recording.top_speed_rad_per_s);
  }
  return speeds;
}

std::vector<NamedPicture> Pictures(const Recording& recording, const PictureOptions& options) {
  const std::vector<SynchronousPoint> points = Synchronous(recording);
  std::vector<NamedPicture> pictures = TimePictures(recording);
  const auto speeds =
      options.speeds_rad_per_s.empty() ? ChosenSpeeds(recording, points) : options.speeds_rad_per_s;
  for (auto group :
       {OrbitPictures(recording, speeds), RunUpPictures(recording, points),
        TorsionPictures(recording), ExcitationPictures(recording), ClockPictures(recording)}) {
    std::move(group.begin(), group.end(), std::back_inserter(pictures));
  }
  return pictures;
}

}  // namespace levitas::report
