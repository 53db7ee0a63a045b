// A program of somebody else's, with switches of its own: every installed header at once, Eigen
// beside ours, an exception across the border; prints the last currents to the last bit.

#include <Eigen/Core>
#include <cstdio>
#include <memory>

#include "all_headers.hpp"

using namespace levitas;

namespace {

// Eigen as the library uses it too: matrices that are allocated, resized and freed.
double OwnEigen() {
  Eigen::MatrixXd a = Eigen::MatrixXd::Identity(24, 24);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(24, 1.0, 2.0);
  a.col(0) += x;
  a.conservativeResize(25, 25);
  a.col(24).setZero();
  a.row(24).setZero();
  x.conservativeResize(25);
  x[24] = 1.0;
  const Eigen::VectorXd y = a.lazyProduct(x);
  return (y - a * x).norm();
}

bool CatchesWhatTheLibraryThrows() {
  try {
    (void)configuration::ParseRig("kind: rig\nname: 7", "mine.yaml");
  } catch (const BadInput& problem) {
    return problem.status() == ExitStatus::kBadInput;
  }
  return false;
}

bool CatchesItAsWhatItIsBelow() {
  try {
    (void)configuration::FindConfig("none_of_that_name", "rigs");
  } catch (const std::runtime_error&) {
    return true;
  }
  return false;
}

}  // namespace

int main() {
  if (!CatchesWhatTheLibraryThrows() || !CatchesItAsWhatItIsBelow()) return 2;
  if (!(OwnEigen() < 1e-9)) return 3;
  const auto rig = configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor", "controllers"), rig.numbers);
  plant::Plant plant(rig.plant, 7);
  plant.RestInTouchdown();
  cycle::ControlCycle control({rig.numbers, controller.law, controller.supervisor});
  cycle::CycleInputs in{.cycle = 1, .frame_present = true};
  cycle::CycleOutputs out;
  in.op.command = OperatorCommand::kLift;
  for (; in.cycle <= 15'000; ++in.cycle) {
    in.frame = plant.Sample();
    out = control.Step(in);
    plant.Advance(plant::CommandOf(out.current));
    in.op.command = OperatorCommand::kNone;
  }
  // Of the mode table, data that stand in both programs.
  std::printf("%s %zu %s\n", Name(out.mode).data(), supervisor::kStates.size(),
              control.decision().standing ? "stands" : "turns");
  for (std::size_t i = 0; i < 4; ++i) {
    std::printf("%a %a\n", out.current.control_current_a[i], plant.ActuatorPosition()[i]);
  }
  return 0;
}
