#pragma once
// The levitated pump under the excitation of H.-L. Chiu (2022), Appl. Sci. 12, 8556, recorded in
// the simulator, and how well the models of identification/nonlinear predict it.
//
// Judged    the `kJudged` rows that lie `kBetween` rows behind the fitted ones. Free runs begin at
//           the first excited row, from rest, and see nothing but the excitation: by the rows that
//           judge they have forgotten how they began.
// Ceiling   what no model can exceed: fit of the simulator itself, same excitation, its noise off.
//           The noise of the readings also passes the controllers and moves the rotor, so this is
//           less than the noise of the readings alone would leave. Rounding of the readings stays.
// Inputs    of the models are the commanded currents, or with `kTestSignals` what the controllers
//           make of the test signals alone (Chiu 2022, 3.3, steps ii to iv): no motion of the rotor
//           enters them. The models then describe the closed loop, which is stable, and run free
//           with these inputs; with commanded ones the known controllers close their loop.
// Ahead     rows predicted from outputs measured up to so many rows before them.
// Failure   std::runtime_error when the scenario does not play to its end. Thread any.

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "controller/scenario/scenario_config.hpp"
#include "identification/nonlinear/hammerstein_wiener.hpp"
#include "identification/nonlinear/narx.hpp"

namespace levitas::accuracy {

enum class PumpInputs : std::uint8_t { kCommanded, kTestSignals };

struct PumpPlan {
  double knee_a{};          ///< of the magnets' iron; 0: straight
  double knee_exponent{4};  ///< sharpness of the bend
  double a2_1_per_m{};      ///< of the sensors' characteristic, alternating in sign by axis
  double a3_1_per_m2{};
  double amplitude{1.0};  ///< of the shipped excitation
  Eigen::Index fitted{40'000};
  PumpInputs inputs{PumpInputs::kCommanded};
  std::vector<Eigen::Index> horizons{};  ///< rows ahead
  /// Of the lagged models, after the fit one step ahead: the error of their free run is minimised
  /// in so many steps, on the last `free_run_rows` fitted rows. 0: not. With `kTestSignals` only.
  int free_run_steps{0};
  Eigen::Index free_run_rows{40'000};
  std::uint64_t noise_seed{1};
  std::uint64_t excitation_seed{0};  ///< added to those of the scenario
};

/// What one model makes of the rows that judge, fit in % per axis.
struct PumpScore {
  std::string model;
  Eigen::VectorXd one_step;  ///< empty: it does not predict from readings
  Eigen::VectorXd free_run;
  std::vector<Eigen::VectorXd> ahead;  ///< of each horizon
  double time_s{};                     ///< of the fit
  bool diverged{};                     ///< the free run left all bounds: its fit says nothing
};

/// Known of the sensor of an axis.
[[nodiscard]] identification::SensorCharacteristic CharacteristicOf(const PumpPlan& plan,
                                                                    std::size_t axis);

class PumpTrial {
 public:
  static constexpr Eigen::Index kBetween = 1000;
  static constexpr Eigen::Index kJudged = 4000;  ///< 0.2 s, as in the paper

  explicit PumpTrial(const PumpPlan& plan);

  [[nodiscard]] const identification::Series& series() const noexcept { return record_.series; }
  [[nodiscard]] const Eigen::MatrixXd& excitation_m() const noexcept {
    return record_.excitation_m;
  }
  [[nodiscard]] Eigen::VectorXd deviation_m() const;  ///< of the judged readings

  /// Fit in % per axis of what is given for all rows, on those that judge.
  [[nodiscard]] Eigen::VectorXd Fit(const Eigen::MatrixXd& predicted) const;

  [[nodiscard]] Eigen::VectorXd CeilingOfReadings() const;  ///< the sensors' noise alone
  [[nodiscard]] Eigen::VectorXd Ceiling() const;            ///< and what it does in the loop
  /// Another record with other noise, as a prediction of this one.
  [[nodiscard]] Eigen::VectorXd Repeated(std::uint64_t noise_seed) const;

  /// `iron`: coefficients of the magnets' curve.
  [[nodiscard]] PumpScore SuspendedRotor(Eigen::Index iron = 3) const;
  /// `products`: with terms of current and position together.
  [[nodiscard]] PumpScore HammersteinWiener(bool products) const;
  [[nodiscard]] PumpScore Narx() const;
  [[nodiscard]] PumpScore Narmax() const;

 private:
  struct PumpRecord {
    identification::Series series;  ///< commanded currents in, readings out
    Eigen::MatrixXd excitation_m;
  };
  struct Twin {
    bool noise{true};
    /// Rows x axes that are injected whatever the scenario's orbit limit makes of its own; null:
    /// the scenario's.
    const Eigen::MatrixXd* excitation_m{};
  };
  [[nodiscard]] PumpRecord Record(std::uint64_t seed, const Twin& twin) const;
  [[nodiscard]] identification::Series Fitted() const;
  [[nodiscard]] PumpScore Scored(const char* name,
                                 const identification::NarxOptions& options) const;
  template <typename Model>
  [[nodiscard]] std::vector<Eigen::VectorXd> Ahead(const Model& model) const;

  PumpPlan plan_;
  configuration::RigFile nominal_, rig_;
  configuration::ControllerFile controller_;
  scenario::ScenarioConfig scenario_;
  PumpRecord record_;
};

}  // namespace levitas::accuracy
