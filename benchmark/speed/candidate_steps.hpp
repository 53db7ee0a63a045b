#pragma once
// Time steps that were considered for the rotor and not taken, on the same force model as the one
// that was: they give the decision table of docs/derivations.md.

#include <vector>

#include "plant_sim/plant/time_step.hpp"

namespace levitas::bench {

/// Forces at the start, the middle and the end of a substep.
struct Instants {
  plant::Currents start, middle, end;
  plant::Spin spin_start, spin_middle, spin_end;
};

/// Displacement and velocity of all modes, both planes.
struct Modal {
  std::vector<double> position, velocity;
};

class CandidateStep {
 public:
  explicit CandidateStep(const plant::PlantModel& model);

  /// Classical Runge-Kutta of fourth order on the whole equation.
  void RungeKutta4(double duration_s, const Instants& at, Modal& modal);
  /// Half kick by the forces, exact modal motion, half kick (Strang).
  void KickDriftKick(const plant::StepTable& table, const Instants& at, Modal& modal);
  /// The step of the plant.
  void ExponentialTrapezoid(const plant::StepTable& table, const Instants& at, Modal& modal);

 private:
  void Derivative(const plant::Currents& currents, const plant::Spin& spin, const Modal& at,
                  Modal& slope);

  const plant::PlantModel& model_;
  std::vector<double> stiffness_, damping_, kick_;
  Modal trial_;
  std::array<Modal, 4> slopes_;
  plant::Workspace work_;
  plant::ForceReport report_;
};

}  // namespace levitas::bench
