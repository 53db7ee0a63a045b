#pragma once
// The sampled linear loop of a rig and its law, as matrices: common ground of poles and margins.
//
// Plant     x[n+1] = A x[n] + B u[n], y[n] = C x[n]; delay included as states.
//           Linear about the point at which the rotor stands under its static load with this law.
// Law       decentralised (or, with a state-space law, one model of all axes), per axis  w[n+1] =
//           Aw w[n] + Bw y[n],  u[n] = -(Cw w[n] + Dw y[n]); the sections of the discrete law
//           itself, not a second discretisation of it.
// Frame     bearing frame: probe and amplifier polarity cancel against the controller's.
// Units     SI: y [m], u [A].
// Thread    any; pure.

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "controller/law/discrete_law.hpp"
#include "controller/law/law_config.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/operating_point.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

/// One axis of the law without its minus sign, as the cascade it is and as a state-space model.
struct AxisModel {
  std::vector<law::Section> sections;
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  Eigen::RowVectorXd c;
  double d{1.0};
  double beside{};  ///< of d what is beside the cascade, not in it
  /// C(z) [A/m]; z must not be a pole.
  [[nodiscard]] std::complex<double> At(std::complex<double> z) const;
};

[[nodiscard]] AxisModel ModelOf(std::vector<law::Section> sections);

/// A state-space law between all axes, signal scales included, as u = -(C w + D y).
struct CoupledModel {
  law::StateSpaceConfig blocks;  ///< in discrete time
  Eigen::MatrixXd a, b, c, d;
  /// C(z) [A/m]; z must not be a pole.
  [[nodiscard]] Eigen::MatrixXcd At(std::complex<double> z) const;
};

[[nodiscard]] CoupledModel ModelOf(const law::StateSpaceConfig& law, double period_s);

struct SampledLoop {
  plant::LinearModel plant;
  plant::OperatingPoint point;          ///< with a failure: the model is that of the centred rotor
  std::vector<AxisModel> law;           ///< one per axis; empty when the law is coupled
  std::optional<CoupledModel> coupled;  ///< instead of `law`
  double period_s{};
  Eigen::Index modes{};  ///< per plane; the plant's state starts with x plane, then y plane
};

/// Throws BadInput when the law's axes do not fit the plant's.
[[nodiscard]] SampledLoop CloseLoop(const plant::PlantConfig& plant, const law::LawConfig& law,
                                    double speed_rad_per_s);

/// The loop at a lower bias than the rig's, in all its magnets: the law as bias saving passes it
/// on (controller/bias/bias_saving.hpp), the magnets' constants at that bias. std::invalid_argument
/// for a magnet whose force is not that of the gap squared.
[[nodiscard]] SampledLoop CloseLoopAtBias(const plant::PlantConfig& plant,
                                          const law::LawConfig& law, double speed_rad_per_s,
                                          double bias_a);

/// System matrix of the closed loop; the plant's states come first.
[[nodiscard]] Eigen::MatrixXd ClosedLoopMatrix(const SampledLoop& loop);

}  // namespace levitas::analysis
