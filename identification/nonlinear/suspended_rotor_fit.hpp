#pragma once
// Numbers of a suspended rotor with which its free run in the known loop is that of the record.
//
// Equation  minimises sum_k |y_k - y^_k(theta)|^2 over the closed loop's free run, driven by the
//           excitation alone, by Levenberg-Marquardt on differences. What the sensors' noise does
//           in the loop has nothing to do with the excitation, so the minimum is that of the
//           rotor whatever colour the noise has there, which one-step prediction in a loop only
//           has with a true model of the noise (Van den Hof 1998, Annual Reviews in Control 22,
//           173: output error on tailor-made parameters).
// Start     a model that the controllers hold: design numbers. First a common factor of all
//           forces, then forces and gaps alone on the first rows, then everything. The scale of a
//           mode's eta and the directions of rigid modes are kept.
// Thread    any. Failure: BadInput by RefuseUnfit, or when the start does not run free.

#include "identification/nonlinear/suspended_rotor.hpp"
#include "plant_sim/plant/plant_parameters.hpp"

namespace levitas::identification {

/// From what the rig file says, standing: nominal magnets, amplifiers, modes, straight iron.
/// `iron`: coefficients of its curve that are to be found. BadInput for a delay that is no whole
/// number of samples and for sensors that are not where the magnets are.
[[nodiscard]] SuspendedRotor DesignOf(const plant::PlantParameters& rig, Eigen::Index iron);

struct SuspendedRotorOptions {
  Eigen::Index skip{5000};  ///< rows until a wrong start is forgotten; they judge nothing
  int most_iterations{25};
  double least_gain{3e-4};  ///< relative, of the sum of squares: stops below
};

struct SuspendedRotorFit {
  SuspendedRotor model;
  double rms_before_m{}, rms_after_m{};  ///< over all axes
  Eigen::Index unknowns{};
  int iterations{};  ///< with everything free
};

/// Controllers at rest and the excitation from its first row: the feedback of a new run.
using LoopAtRest = std::function<Feedback()>;

/// `series.output` holds the readings from the first excited row on.
[[nodiscard]] SuspendedRotorFit FitSuspendedRotor(const SuspendedRotor& start, const Series& series,
                                                  const LoopAtRest& at_rest,
                                                  const SuspendedRotorOptions& options = {});

}  // namespace levitas::identification
