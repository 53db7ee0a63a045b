#include "benchmark/speed/candidate_steps.hpp"

namespace levitas::bench {

CandidateStep::CandidateStep(const plant::PlantModel& model) : model_(model), work_(model) {
  const std::size_t count = 2 * model.layout().modes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto mode = static_cast<Eigen::Index>(i % model.layout().modes);
    const double w = model.parameters().modes.frequency_rad_per_s[mode];
    stiffness_.push_back(w * w);
    damping_.push_back(2.0 * model.parameters().modes.damping_ratio[mode] * w);
  }
  kick_.resize(count);
  trial_ = {std::vector<double>(count), std::vector<double>(count)};
  slopes_.fill(trial_);
}

void CandidateStep::Derivative(const plant::Currents& currents, const plant::Spin& spin,
                               const Modal& at, Modal& slope) {
  plant::ModalForces(model_, currents, spin, at.position.data(), at.velocity.data(),
                     slope.velocity.data(), report_);
  for (std::size_t i = 0; i < stiffness_.size(); ++i) {
    slope.position[i] = at.velocity[i];
    slope.velocity[i] -= stiffness_[i] * at.position[i] + damping_[i] * at.velocity[i];
  }
}

void CandidateStep::RungeKutta4(double h, const Instants& at, Modal& modal) {
  const std::size_t count = stiffness_.size();
  const auto towards = [&](const Modal& slope, double step) {
    for (std::size_t i = 0; i < count; ++i) {
      trial_.position[i] = modal.position[i] + step * slope.position[i];
      trial_.velocity[i] = modal.velocity[i] + step * slope.velocity[i];
    }
  };
  Derivative(at.start, at.spin_start, modal, slopes_[0]);
  towards(slopes_[0], h / 2.0);
  Derivative(at.middle, at.spin_middle, trial_, slopes_[1]);
  towards(slopes_[1], h / 2.0);
  Derivative(at.middle, at.spin_middle, trial_, slopes_[2]);
  towards(slopes_[2], h);
  Derivative(at.end, at.spin_end, trial_, slopes_[3]);
  for (std::size_t i = 0; i < count; ++i) {
    modal.position[i] += h / 6.0 *
                         (slopes_[0].position[i] + 2.0 * slopes_[1].position[i] +
                          2.0 * slopes_[2].position[i] + slopes_[3].position[i]);
    modal.velocity[i] += h / 6.0 *
                         (slopes_[0].velocity[i] + 2.0 * slopes_[1].velocity[i] +
                          2.0 * slopes_[2].velocity[i] + slopes_[3].velocity[i]);
  }
}

void CandidateStep::KickDriftKick(const plant::StepTable& table, const Instants& at, Modal& modal) {
  const std::size_t count = stiffness_.size();
  const double half = table.duration_s / 2.0;
  plant::ModalForces(model_, at.start, at.spin_start, modal.position.data(), modal.velocity.data(),
                     kick_.data(), report_);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = modal.position[i];
    const double v = modal.velocity[i] + half * kick_[i];
    modal.position[i] = table.xx[i] * x + table.xv[i] * v;
    modal.velocity[i] = table.vx[i] * x + table.vv[i] * v;
  }
  // Forces that depend on velocity (gyroscopic, contact) see the velocity before this kick.
  plant::ModalForces(model_, at.end, at.spin_end, modal.position.data(), modal.velocity.data(),
                     kick_.data(), report_);
  for (std::size_t i = 0; i < count; ++i) modal.velocity[i] += half * kick_[i];
}

void CandidateStep::ExponentialTrapezoid(const plant::StepTable& table, const Instants& at,
                                         Modal& modal) {
  plant::StepRotor(model_, table, at.start, at.end, at.spin_start, at.spin_end,
                   modal.position.data(), modal.velocity.data(), work_, report_);
}

}  // namespace levitas::bench
