#include "design/notch/notch_design.hpp"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/synchronous_loop.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "controller/synchronous/inverse_ladder.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/dense/spectrum.hpp"

namespace levitas::design {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using synchronous::BlockConfig;

constexpr std::size_t kFirstSpeeds = 9;

MatrixXcd AnswerAt(const plant::PlantConfig& rig, const law::LawConfig& law,
                   const BlockConfig& block, double speed_rad_per_s) {
  return analysis::SynchronousAnswer(analysis::CloseLoop(rig, law, speed_rad_per_s),
                                     speed_rad_per_s, block.order, block.target);
}

/// Onto what turns one way: of amplitudes (a, b) of x and y, forward is b = -j a.
MatrixXcd Projection(Index axes, Direction direction) {
  MatrixXcd projection = MatrixXcd::Identity(axes, axes);
  if (direction == Direction::kBoth) return projection;
  const std::complex<double> j(0.0, direction == Direction::kForward ? 1.0 : -1.0);
  for (Index x = 0; x + 1 < axes; x += 2) {
    projection.block(x, x, 2, 2) << 0.5, 0.5 * j, -0.5 * j, 0.5;
  }
  return projection;
}

/// T M T projects twice, so that T answers to one direction and moves in it alone.
MatrixXcd InverseOf(const MatrixXcd& answer, Direction direction) {
  const MatrixXcd projection = Projection(answer.rows(), direction);
  if (direction == Direction::kBoth) return Eigen::FullPivLU<MatrixXcd>(answer).inverse();
  const MatrixXcd inverse = Eigen::FullPivLU<MatrixXcd>(answer).inverse();
  return projection * inverse * projection;
}

synchronous::InverseAtSpeed Node(const plant::PlantConfig& rig, const law::LawConfig& law,
                                 const NotchRequest& request, double speed_rad_per_s) {
  const MatrixXcd answer = AnswerAt(rig, law, request.block, speed_rad_per_s);
  return {speed_rad_per_s, analysis::ComplexMatrixOf(InverseOf(answer, request.direction))};
}

/// Largest distance from 1 of an eigenvalue of T times the answer, as the table has T there.
double Departure(const plant::PlantConfig& rig, const law::LawConfig& law, const BlockConfig& block,
                 Direction direction, double speed_rad_per_s) {
  const MatrixXcd answer = AnswerAt(rig, law, block, speed_rad_per_s);
  const MatrixXcd inverse = analysis::MatrixOf(synchronous::InverseAt(block, speed_rad_per_s),
                                               static_cast<std::size_t>(answer.rows()));
  const MatrixXcd projection = Projection(answer.rows(), direction);
  const MatrixXcd off = projection *
                        (inverse * answer - MatrixXcd::Identity(answer.rows(), answer.rows())) *
                        projection;
  Eigen::MatrixXd real(2 * off.rows(), 2 * off.rows());
  real << off.real(), -off.imag(), off.imag(), off.real();
  return numerics::EigenvaluesOf(real).cwiseAbs().maxCoeff();
}

void RefuseUnheld(const plant::PlantConfig& rig, const law::LawConfig& law,
                  double speed_rad_per_s) {
  const auto loop = analysis::CloseLoop(rig, law, speed_rad_per_s);
  const auto judged = analysis::JudgeSynchronous(loop, {}, speed_rad_per_s);
  if (judged.largest_pole_modulus < 1.0 && loop.point.failure.empty()) return;
  throw BadInput(fmt::format(
      "the loop is not stable at {:.0f} rpm without any synchronous control (largest |z| {:.6f}): "
      "choose --from-rpm and --to-rpm where it is, or another law (amb margins shows both)",
      RadPerSToRpm(speed_rad_per_s), judged.largest_pole_modulus));
}

/// Of the eigenvalues of T times the answer; of one direction those of the other are 0 and no part
/// of the judgement.
double SlowestDecay(const plant::PlantConfig& rig, const law::LawConfig& law,
                    const BlockConfig& block, Direction direction, double speed_rad_per_s) {
  const MatrixXcd answer = AnswerAt(rig, law, block, speed_rad_per_s);
  const MatrixXcd projection = Projection(answer.rows(), direction);
  const MatrixXcd rest = MatrixXcd::Identity(answer.rows(), answer.rows()) - projection;
  const MatrixXcd product = analysis::MatrixOf(synchronous::InverseAt(block, speed_rad_per_s),
                                               static_cast<std::size_t>(answer.rows())) *
                                answer * projection +
                            rest;
  Eigen::MatrixXd real(2 * product.rows(), 2 * product.rows());
  real << product.real(), -product.imag(), product.imag(), product.real();
  return numerics::EigenvaluesOf(real).real().minCoeff();
}

}  // namespace

BlockConfig WithInverse(const plant::PlantConfig& rig, const law::LawConfig& law,
                        const NotchRequest& request) {
  BlockConfig block = request.block;
  block.inverse.clear();
  for (std::size_t i = 0; i < kFirstSpeeds; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kFirstSpeeds - 1);
    const double speed = block.from_rad_per_s + share * (block.to_rad_per_s - block.from_rad_per_s);
    RefuseUnheld(rig, law, speed);
    block.inverse.push_back(Node(rig, law, request, speed));
  }
  // The worst gap first, so that a table that is full has spent its speeds where they count.
  std::vector<double> departure(block.inverse.size() - 1, -1.0);
  while (block.inverse.size() < kMostSpeeds) {
    for (std::size_t i = 0; i < departure.size(); ++i) {
      if (departure[i] >= 0.0) continue;
      const double middle =
          0.5 * (block.inverse[i].speed_rad_per_s + block.inverse[i + 1].speed_rad_per_s);
      departure[i] = Departure(rig, law, block, request.direction, middle);
    }
    const auto worst = std::max_element(departure.begin(), departure.end());
    if (*worst <= kBetween) break;
    const auto at = worst - departure.begin();
    const auto low = block.inverse.begin() + at;
    const double middle = 0.5 * (low->speed_rad_per_s + (low + 1)->speed_rad_per_s);
    block.inverse.insert(low + 1, Node(rig, law, request, middle));
    *worst = -1.0;
    departure.insert(departure.begin() + at, -1.0);
  }
  return block;
}

bool NotchFigures::allowed() const noexcept {
  return std::all_of(speeds.begin(), speeds.end(), [](const auto& at) { return at.allowed; });
}

std::string NotchFigures::RefusedSpeeds() const {
  std::string text;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (speeds[i].allowed) continue;
    const std::size_t first = i;
    while (i + 1 < speeds.size() && !speeds[i + 1].allowed) ++i;
    const double low = RadPerSToRpm(speeds[first].speed_rad_per_s);
    const double high = RadPerSToRpm(speeds[i].speed_rad_per_s);
    if (!text.empty()) text += ", ";
    text += first == i ? fmt::format("{:.0f} rpm", low)
                       : fmt::format("{:.0f} to {:.0f} rpm", low, high);
  }
  return text;
}

NotchFigures JudgeNotch(const plant::PlantConfig& rig, const std::vector<plant::PlantConfig>& drawn,
                        const law::LawConfig& law, const BlockConfig& block, Direction direction) {
  synchronous::SynchronousConfig control;
  control.blocks.push_back(block);
  NotchFigures figures;
  figures.rigs = drawn.size();
  std::vector<bool> unheld(drawn.size(), false);
  for (const double speed : analysis::JudgedSpeeds(control, kJudged)) {
    SpeedFigures at;
    at.speed_rad_per_s = speed;
    at.slowest_decay = at.worst_decay = SlowestDecay(rig, law, block, direction, speed);
    at.largest_pole_modulus =
        analysis::JudgeSynchronous(analysis::CloseLoop(rig, law, speed), control, speed)
            .largest_pole_modulus;
    for (std::size_t n = 0; n < drawn.size(); ++n) {
      const auto judged =
          analysis::JudgeSynchronous(analysis::CloseLoop(drawn[n], law, speed), control, speed);
      if (!(judged.largest_pole_modulus_without < 1.0)) {
        unheld[n] = true;
        continue;
      }
      at.worst_decay =
          std::min(at.worst_decay, SlowestDecay(drawn[n], law, block, direction, speed));
      at.largest_pole_modulus = std::max(at.largest_pole_modulus, judged.largest_pole_modulus);
    }
    at.allowed =
        at.slowest_decay >= kLeastDecay && at.worst_decay > 0.0 && at.largest_pole_modulus < 1.0;
    figures.speeds.push_back(at);
  }
  figures.not_held = static_cast<std::size_t>(std::count(unheld.begin(), unheld.end(), true));
  return figures;
}

}  // namespace levitas::design
