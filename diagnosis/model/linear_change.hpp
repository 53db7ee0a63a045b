#pragma once
// By how much the terms in force alter the linear model along which derivatives are propagated.
//
// Why     a lightly damped mode that is a per cent off rings at another frequency: derivatives
//         taken about the file's mode instead of the calibrated one are out of phase after a few
//         cycles, and a fit along them does not converge.
// Filled  by Term::change at the calibrated theta; what varies from sample to sample is in
//         SamplePoint::added (Term::slope).
// Thread  plain data.

#include <array>
#include <vector>

#include "diagnosis/model/mesh_view.hpp"
#include "diagnosis/model/sample_point.hpp"

namespace levitas::diagnosis {

struct Term;

struct LinearChange {
  struct Axis {
    std::array<double, kMaxModes> drive{};     ///< added to the shape through which the force acts
    std::array<double, kMaxModes> sensor_q{};  ///< added to the reading per modal displacement
    std::array<double, kMaxModes> sensor_v{};  ///< [s] added to the reading per modal velocity
    double coil_rate{1.0};                     ///< times the amplifier's bandwidth
  };
  struct Mode {
    double frequency{1.0};  ///< ratio
    double damping{1.0};    ///< ratio of 2 z w
    double drive{1.0};      ///< ratio of what all forces do to it
  };
  struct Mesh {
    double stiffness{1.0}, damping{1.0};  ///< ratios
  };
  std::array<Axis, kMaxAxes> axis{};
  std::array<Mode, kMaxModes> mode{};
  std::array<Mesh, kMostMeshes> mesh{};
  double gyroscopic{1.0};  ///< ratio
  double late_periods{};   ///< by which commands act later; negative: earlier
};

/// What all terms do to the linear model at theta.
[[nodiscard]] LinearChange ChangeOf(const std::vector<Term>& terms,
                                    const std::vector<double>& theta);

}  // namespace levitas::diagnosis
