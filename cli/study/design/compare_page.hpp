#pragma once
// What `amb design compare` found of each controller, as rows of a table and as a page.
//
// Page   one HTML file without scripts: the table, Bode of the laws at rest, |S| and the largest
//        synchronous current over speed, orbits with the circles of the objective, and the worst
//        orbit of the drawn rigs over speed.
// Units  SI in the figures, micrometres and amperes on the page. Thread: any; pure.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "design/gate/gate.hpp"

namespace levitas::cli {

/// What one controller does.
struct Compared {
  std::string name;
  law::LawConfig law;
  std::vector<design::RunFigures> runs;  ///< at the speeds asked
  std::vector<double> speed_rpm, peak;   ///< |S| over speed
  design::Peak mu;
  std::vector<design::DrawnSpeed> drawn;  ///< of the drawn rigs, speed by speed
  std::size_t rigs{};                     ///< drawn
  double step_ns{};                       ///< one period of the law on this machine

  [[nodiscard]] std::size_t Runs() const { return rigs * drawn.size(); }
  [[nodiscard]] std::size_t Lost() const;
  [[nodiscard]] double WorstOrbit() const;  ///< [m] of those that were not lost
};

/// The first row is the head.
[[nodiscard]] std::vector<std::vector<std::string>> ComparedRows(
    const std::vector<Compared>& compared, const std::vector<double>& speeds_rpm);

[[nodiscard]] std::string ComparePage(const std::vector<Compared>& compared,
                                      const configuration::RigFile& rig,
                                      const std::vector<double>& speeds_rpm);

}  // namespace levitas::cli
