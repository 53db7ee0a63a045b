#include "identification/modal/whirl_start.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/two_pi.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr int kRounds = 4;
/// ln of a frequency ratio beyond which a whirl of the data is another mode's.
constexpr double kOther = 0.08;

/// State matrix of displacements and velocities in both planes, without damping.
Eigen::MatrixXd StateMatrix(const Physical& rig, double speed_rad_per_s) {
  const Index n = rig.frequency_rad_per_s.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4 * n, 4 * n);
  a.topRightCorner(2 * n, 2 * n).setIdentity();
  for (Index plane = 0; plane < 2; ++plane) {
    Eigen::MatrixXd stiffness = rig.frequency_rad_per_s.cwiseAbs2().asDiagonal();
    for (Index b = 0; b < rig.actuator.cols(); ++b) {
      stiffness -=
          rig.ks_n_per_m[2 * b + plane] * rig.actuator.col(b) * rig.actuator.col(b).transpose();
    }
    a.block(2 * n + plane * n, plane * n, n, n) = -stiffness;
  }
  a.block(2 * n, 3 * n, n, n) = -speed_rad_per_s * rig.gyroscopic;
  a.block(3 * n, 2 * n, n, n) = speed_rad_per_s * rig.gyroscopic;
  return a;
}

struct Line {
  double hz;
  std::size_t mode;
  bool forward;
};

std::vector<Line> Ascending(const std::vector<Whirl>& whirls) {
  std::vector<Line> lines;
  lines.reserve(2 * whirls.size());
  for (std::size_t i = 0; i < whirls.size(); ++i) {
    if (whirls[i].backward_hz <= 0.0) continue;
    lines.push_back({whirls[i].backward_hz, i, false});
    lines.push_back({whirls[i].forward_hz, i, true});
  }
  std::ranges::sort(lines, {}, &Line::hz);
  return lines;
}

}  // namespace

std::vector<Whirl> WhirlsInMagnets(const Physical& rig, double speed_rad_per_s) {
  const Index n = rig.frequency_rad_per_s.size();
  const numerics::Spectrum spectrum = numerics::SpectrumOf(StateMatrix(rig, speed_rad_per_s));
  std::vector<std::vector<double>> of_mode(static_cast<std::size_t>(n));
  for (Index k = 0; k < 4 * n; ++k) {
    const double hz = spectrum.values[k].imag() / kTwoPi;
    if (hz <= 0.0) continue;
    const Eigen::VectorXd size = spectrum.vectors.col(k).head(2 * n).cwiseAbs2();
    Index mode = 0;
    (size.head(n) + size.tail(n)).maxCoeff(&mode);
    of_mode[static_cast<std::size_t>(mode)].push_back(hz);
  }
  std::vector<Whirl> whirls(static_cast<std::size_t>(n - 2));
  for (std::size_t i = 0; i < whirls.size(); ++i) {
    const auto& hz = of_mode[i + 2];
    if (hz.size() == 2) whirls[i] = {std::min(hz[0], hz[1]), std::max(hz[0], hz[1])};
  }
  return whirls;
}

void MeetWhirls(const ModalFrame& frame, double speed_rad_per_s,
                const std::vector<ProposedMode>& shown, Eigen::VectorXd& vector) {
  const ModalLayout& at = frame.layout;
  for (int round = 0; round < kRounds; ++round) {
    const auto lines =
        Ascending(WhirlsInMagnets(ToPhysical(frame, vector), std::abs(speed_rad_per_s)));
    std::vector<double> model_hz;
    model_hz.reserve(lines.size());
    for (const Line& line : lines) model_hz.push_back(line.hz);
    const Assigned assigned = AssignModes(model_hz, shown);
    std::vector<double> apart_hz(static_cast<std::size_t>(at.bending), 0.0);
    std::vector<int> sides(apart_hz.size(), 0);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (!assigned[k]) continue;
      if (std::abs(std::log(assigned[k]->frequency_hz / lines[k].hz)) > kOther) continue;
      const double off_hz = assigned[k]->frequency_hz - lines[k].hz;
      apart_hz[lines[k].mode] += lines[k].forward ? off_hz : -off_hz;
      ++sides[lines[k].mode];
    }
    for (Index i = 0; i < at.bending; ++i) {
      const auto mode = static_cast<std::size_t>(i);
      if (sides[mode] == 0) continue;
      const double split_hz = apart_hz[mode] * 2.0 / sides[mode];
      vector[at.gyroscopic_at(1 + i, 1 + i)] += kTwoPi * split_hz / std::abs(speed_rad_per_s);
    }
  }
}

}  // namespace levitas::identification
