#pragma once
// The pictures of a recorded run, each by itself: what a report shows, in its order.
//
// Left out what the run does not have: no run-up picture without a turning rotor.
// Units    micrometres, amperes, rpm, seconds, hertz, as the labels say.
// Thread   any; offline.

#include <string>
#include <vector>

#include "report/session/recording.hpp"
#include "report/session/run_up.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report {

struct NamedPicture {
  std::string name;     ///< of the file: "bode_de"
  std::string caption;  ///< what is seen, for a person and a screen reader
  svg::Figure figure;
};

struct PictureOptions {
  std::vector<double> speeds_rad_per_s;  ///< of the orbits; empty: chosen from the run
};

[[nodiscard]] std::vector<NamedPicture> Pictures(const Recording& recording,
                                                 const PictureOptions& options);

// The groups, in order; of two bearings, those that belong together stand side by side.
[[nodiscard]] std::vector<NamedPicture> TimePictures(const Recording& recording);
[[nodiscard]] std::vector<NamedPicture> RunUpPictures(const Recording& recording,
                                                      const std::vector<SynchronousPoint>& points);
[[nodiscard]] std::vector<NamedPicture> OrbitPictures(const Recording& recording,
                                                      const std::vector<double>& speeds_rad_per_s);
[[nodiscard]] std::vector<NamedPicture> ClockPictures(const Recording& recording);
/// Torque of measured couplings over the run, and its half spectrum at the top speed.
[[nodiscard]] std::vector<NamedPicture> TorsionPictures(const Recording& recording);
/// How each test signal begins, and the correlation of those that act at one time.
[[nodiscard]] std::vector<NamedPicture> ExcitationPictures(const Recording& recording);

/// Standing, where the synchronous vibration was largest, and the top speed.
[[nodiscard]] std::vector<double> ChosenSpeeds(const Recording& recording,
                                               const std::vector<SynchronousPoint>& points);

// Shared by the groups.
inline constexpr double kUm = 1e6;
/// A picture of one panel as a report shows it.
[[nodiscard]] svg::Figure Wide(svg::Panel panel);
/// A circle about the origin, dashed as SVG has it.
[[nodiscard]] svg::Series Circle(double radius_um, const std::string& name,
                                 const std::string& dashes);
/// A level across the panel, dashed.
[[nodiscard]] svg::Series Level(const std::string& name, double from_x, double to_x, double y);

}  // namespace levitas::report
