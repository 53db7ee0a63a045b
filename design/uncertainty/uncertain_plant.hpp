#pragma once
// The weighted loop of a rig at one speed, its uncertainty drawn out: M with mu(M) < 1 wanted.
//
// Plant      the continuous linear model about the centred rotor, G(jw), by its eigenvectors; the
//            law's current through delay and hold e^{-jwT(delay + 1/2)} sinc(wT/2), the law at
//            e^{jwT}: exact up to images above half the sampling rate. Perturbations act on the
//            rotor without the loop's delay.
// Order      w = (perturbations; disturbance per axis; noise per axis), z = (perturbations;
//            current, position per axis), weighted (analysis_weights.hpp). A mode's perturbation
//            appears once in each plane, as two of their own: a larger set than the rotor's.
// Real       every perturbation is a real scalar of at most 1.
// Shares     no line with the synthesis: another model of the delay, another form of the plant.
// Units      Hz in; M has none. Thread: any; pure.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "controller/law/discrete_law.hpp"
#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "design/uncertainty/analysis_weights.hpp"

namespace levitas::uncertainty {

/// At one frequency: of [z; y] by [w; u], unweighted perturbations inside.
struct PlantPoint {
  double hz{};
  Eigen::MatrixXcd zw, zu, yw, yu;  ///< z: perturbations; w: perturbations; u [A], y [m]
};

class UncertainPlant {
 public:
  UncertainPlant(const configuration::RigFile& rig, const std::vector<Parameter>& parameters,
                 double speed_rad_per_s);

  [[nodiscard]] PlantPoint At(double hz) const;
  /// Force phasors along x and y at a place of the shaft -> y [m], one entry per axis.
  [[nodiscard]] Eigen::VectorXcd PositionOf(double hz, double z_m, std::complex<double> force_x,
                                            std::complex<double> force_y) const;
  /// The same of unbalance, at once the speed: amplitudes of e^{j angle}.
  [[nodiscard]] Eigen::VectorXcd PositionOf(const std::vector<plant::UnbalanceMass>& unbalance,
                                            double speed_rad_per_s) const;
  [[nodiscard]] Eigen::Index perturbations() const noexcept { return seen_.rows(); }
  [[nodiscard]] Eigen::Index axes() const noexcept { return read_.rows(); }
  /// Natural frequencies of the free rotor at this speed, for the grid.
  [[nodiscard]] std::vector<double> ModesHz() const;

 private:
  Eigen::VectorXcd poles_;
  Eigen::MatrixXcd push_, drive_, seen_, read_;             ///< in the eigenvectors' coordinates
  Eigen::MatrixXcd inverse_;                                ///< of the eigenvectors
  std::vector<std::pair<double, Eigen::VectorXd>> shapes_;  ///< of nodes: place, modes
  Eigen::Index v_x_{}, v_y_{}, states_{};
  double period_s_{}, delay_s_{};
};

/// The law at e^{jwT}: u [A] of y [m], the minus inside.
class LawResponse {
 public:
  explicit LawResponse(const law::LawConfig& law);
  [[nodiscard]] Eigen::MatrixXcd At(double hz) const;

 private:
  law::LawConfig law_;
  std::vector<std::vector<law::Section>> sections_;  ///< per axis, of a decentralised law
  law::StateSpaceConfig blocks_;                     ///< in z, of a state-space law
};

/// M of the closed loop.
[[nodiscard]] Eigen::MatrixXcd LoopMatrix(const PlantPoint& plant, const Eigen::MatrixXcd& law,
                                          const AnalysisWeights& weights);

/// (I - P K)^-1: the sensitivity at the sensors.
[[nodiscard]] Eigen::MatrixXcd SensitivityOf(const PlantPoint& plant, const Eigen::MatrixXcd& law);

/// Upper bound of mu with complex perturbations: the largest singular value after balancing rows
/// against columns (E. E. Osborne, J. ACM 7, 1960). Real ones have at most this.
[[nodiscard]] double ComplexMu(const Eigen::MatrixXcd& m, Eigen::Index perturbations);
/// About the same by twelve steps of a power iteration, for a search: it may be a few per cent low.
[[nodiscard]] double QuickMu(const Eigen::MatrixXcd& m, Eigen::Index perturbations);

}  // namespace levitas::uncertainty
