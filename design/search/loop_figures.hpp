#pragma once
// What a search weighs: mu, |S|, orbit and current of a law over speed, from linear models.
//
// mu        about the complex upper bound on a grid with every lightly damped pole; real parameters
//           have less.
// |S|       largest of an axis, the same grid.
// Orbit     at the sensors: unbalance of the rig file and a force of `third_n` at three times the
//           speed, against rotation, at the shaft's drive end, each by its largest radius, summed.
// Current   of both, summed, plus nothing for noise.
// Cached    the plant's responses do not depend on the law: made once.
// Not proven  anything between grid points, saturation, contact: design/gate does that.
// Thread    one instance per thread.

#include <memory>
#include <vector>

#include "configuration/rig_file.hpp"
#include "design/uncertainty/uncertain_plant.hpp"

namespace levitas::design {

struct LoopFigures {
  bool stable{};
  double pole_modulus{};
  double mu{}, mu_hz{}, mu_rpm{};
  double sensitivity{}, sensitivity_hz{}, sensitivity_rpm{};
  double orbit_m{}, orbit_rpm{};
  double current_a{}, current_rpm{};
};

struct FigureOptions {
  std::vector<double> speeds_rad_per_s;        ///< at which mu, |S| and poles are taken
  std::vector<double> orbit_speeds_rad_per_s;  ///< at which orbit and current are
  double third_n{0.8};
  int grid_points{160};
  uncertainty::AnalysisWeights weights;
};

class FigureMaker {
 public:
  FigureMaker(configuration::RigFile rig, const std::vector<uncertainty::Parameter>& parameters,
              FigureOptions options);

  [[nodiscard]] LoopFigures Of(const law::LawConfig& law) const;

 private:
  struct Speed {
    double rad_per_s{};
    std::unique_ptr<uncertainty::UncertainPlant> plant;
    std::vector<uncertainty::PlantPoint> grid;
  };
  struct Harmonic {
    double speed_rad_per_s{};
    uncertainty::PlantPoint point;
    Eigen::VectorXcd position_m;  ///< without control, per axis
  };
  void Note(const Speed& speed, const uncertainty::PlantPoint& point, const Eigen::MatrixXcd& law,
            LoopFigures& out) const;
  void AddHarmonics(const uncertainty::LawResponse& law, LoopFigures& out) const;

  configuration::RigFile rig_;
  FigureOptions options_;
  std::vector<Speed> speeds_;
  std::vector<Harmonic> harmonics_;  ///< a speed's stand side by side
};

}  // namespace levitas::design
