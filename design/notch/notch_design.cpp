#include "design/notch/notch_design.hpp"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "analysis/loop_response.hpp"
#include "analysis/synchronous_loop.hpp"
#include "common/ellipse.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "controller/synchronous/inverse_ladder.hpp"
#include "design/notch/bearing_phase.hpp"
#include "design/uncertainty/uncertain_plant.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::design {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using synchronous::BlockConfig;

constexpr std::size_t kFirstSpeeds = 9;

MatrixXcd AnswerAt(const analysis::SampledLoop& loop, const NotchRequest& request,
                   double speed_rad_per_s) {
  const BlockConfig& block = request.block;
  if (!request.measured.empty()) {
    return MeasuredAnswer(request.measured, loop, block, speed_rad_per_s);
  }
  const analysis::LoopResponse response(loop);
  return analysis::SynchronousAnswer(response, speed_rad_per_s, block.order, block.target);
}

/// Orthonormal basis of the amplitudes that a block moves: of (a, b) of x and y, forward is
/// b = -j a.
MatrixXcd BasisOf(Index axes, Direction direction) {
  if (direction == Direction::kBoth) return MatrixXcd::Identity(axes, axes);
  const std::complex<double> j(0.0, direction == Direction::kForward ? -1.0 : 1.0);
  MatrixXcd basis = MatrixXcd::Zero(axes, axes / 2);
  for (Index b = 0; b < basis.cols(); ++b) {
    basis(2 * b, b) = std::sqrt(0.5);
    basis(2 * b + 1, b) = j * std::sqrt(0.5);
  }
  return basis;
}

/// The inverse on those: B (B^H M B)^-1 B^H.
MatrixXcd InverseOf(const MatrixXcd& answer, Direction direction) {
  const MatrixXcd basis = BasisOf(answer.rows(), direction);
  const MatrixXcd within = basis.adjoint() * answer * basis;
  return basis * Eigen::FullPivLU<MatrixXcd>(within).inverse() * basis.adjoint();
}

/// T of one speed, as asked for.
MatrixXcd WantedAt(const plant::PlantConfig& rig, const analysis::SampledLoop& loop,
                   const NotchRequest& request, double speed_rad_per_s) {
  if (request.knowledge == Knowledge::kRotor) {
    return InverseOf(AnswerAt(loop, request, speed_rad_per_s), request.direction);
  }
  const MatrixXcd whole = PhaseAlignedT(rig, loop, request.block, speed_rad_per_s);
  const MatrixXcd basis = BasisOf(whole.rows(), request.direction);
  return basis * (basis.adjoint() * whole * basis) * basis.adjoint();
}

synchronous::InverseAtSpeed Node(const plant::PlantConfig& rig, const law::LawConfig& law,
                                 const NotchRequest& request, double speed_rad_per_s) {
  const auto loop = analysis::CloseLoop(rig, law, speed_rad_per_s);
  return {speed_rad_per_s,
          analysis::ComplexMatrixOf(WantedAt(rig, loop, request, speed_rad_per_s))};
}

/// How far the table's T is from the one wanted there: of the rotor's knowledge the largest
/// distance from 1 of an eigenvalue of T times the answer, else a share of the largest element.
double Departure(const plant::PlantConfig& rig, const law::LawConfig& law, const BlockConfig& block,
                 const NotchRequest& request, double speed_rad_per_s) {
  const auto loop = analysis::CloseLoop(rig, law, speed_rad_per_s);
  const MatrixXcd inverse = analysis::MatrixOf(synchronous::InverseAt(block, speed_rad_per_s),
                                               static_cast<std::size_t>(loop.plant.c.rows()));
  if (request.knowledge == Knowledge::kBearings) {
    const MatrixXcd wanted = WantedAt(rig, loop, request, speed_rad_per_s);
    return (inverse - wanted).cwiseAbs().maxCoeff() / wanted.cwiseAbs().maxCoeff();
  }
  const MatrixXcd answer = AnswerAt(loop, request, speed_rad_per_s);
  const MatrixXcd basis = BasisOf(answer.rows(), request.direction);
  const MatrixXcd off =
      basis.adjoint() * inverse * answer * basis - MatrixXcd::Identity(basis.cols(), basis.cols());
  return analysis::EigenvaluesWithConjugates(off).cwiseAbs().maxCoeff();
}

void RefuseUnheld(const plant::PlantConfig& rig, const law::LawConfig& law,
                  double speed_rad_per_s) {
  const auto loop = analysis::CloseLoop(rig, law, speed_rad_per_s);
  const double modulus = analysis::LargestPoleModulus(loop);
  if (modulus < 1.0 && loop.point.failure.empty()) return;
  throw BadInput(fmt::format(
      "the loop is not stable at {:.0f} rpm without any synchronous control (largest |z| {:.6f}): "
      "choose --from-rpm and --to-rpm where it is, or another law (amb margins shows both)",
      RadPerSToRpm(speed_rad_per_s), modulus));
}

}  // namespace

BlockConfig WithInverse(const configuration::RigFile& file, const law::LawConfig& law,
                        const NotchRequest& request) {
  const plant::PlantConfig& rig = file.plant;
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
      departure[i] = Departure(rig, law, block, request, middle);
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
  return std::all_of(speeds.begin(), speeds.end(), [](const auto& at) { return at.allowed(); });
}

namespace {

std::string RangeText(double from_rpm, double to_rpm) {
  return from_rpm == to_rpm ? fmt::format("{:.0f} rpm", from_rpm)
                            : fmt::format("{:.0f} to {:.0f} rpm", from_rpm, to_rpm);
}

}  // namespace

std::string NotchFigures::AllowedSpeeds() const {
  std::string text;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (!speeds[i].allowed()) continue;
    const std::size_t first = i;
    while (i + 1 < speeds.size() && speeds[i + 1].allowed()) ++i;
    // The window's hysteresis has to be allowed as well; rounded to whole numbers inwards.
    const double from = speeds[first].speed_rad_per_s + hysteresis_rad_per_s;
    const double to = speeds[i].speed_rad_per_s - hysteresis_rad_per_s;
    const double low = std::ceil(RadPerSToRpm(from) - 1e-6);
    const double high = std::floor(RadPerSToRpm(to) + 1e-6);
    if (!(high > low)) continue;
    if (!text.empty()) text += ", ";
    text += RangeText(low, high);
  }
  return text.empty() ? "nowhere" : text;
}

// Neighbours of the same reason as one range, with the reason of its first.
std::string NotchFigures::RefusedSpeeds() const {
  std::string text;
  const auto kind = [](const SpeedFigures& at) {
    return at.refused.substr(0, at.refused.find(':'));
  };
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (speeds[i].allowed()) continue;
    const std::size_t first = i;
    while (i + 1 < speeds.size() && kind(speeds[i + 1]) == kind(speeds[first])) ++i;
    if (!text.empty()) text += "; ";
    text += fmt::format("{} ({})",
                        RangeText(RadPerSToRpm(speeds[first].speed_rad_per_s),
                                  RadPerSToRpm(speeds[i].speed_rad_per_s)),
                        kind(speeds[first]));
  }
  return text;
}

namespace {

std::string WhyRefused(const SpeedFigures& at, const NotchRequest& request) {
  const bool vibration = request.block.target == synchronous::Target::kVibration;
  if (!vibration && at.growth > request.most_growth) {
    return fmt::format(
        "without its synchronous force the orbit could grow more than {:.3g}-fold: {:.3g}-fold",
        request.most_growth, at.growth);
  }
  if (vibration && at.condition > kMostCondition) {
    return fmt::format("the magnets hardly move what the sensors read: condition {:.3g}",
                       at.condition);
  }
  if (vibration && at.current_a > request.block.largest_current_a) {
    return fmt::format("more current than its largest_current_a: {:.3g} A", at.current_a);
  }
  if (!(at.slowest_decay >= kLeastDecay)) {
    return fmt::format("an eigenvalue of T times the answer below {}: {:.3g}", kLeastDecay,
                       at.slowest_decay);
  }
  if (!(at.worst_decay > 0.0)) {
    return fmt::format("a drawn rig has an eigenvalue below 0: {:.3g}", at.worst_decay);
  }
  if (request.measured.empty() && !(at.largest_pole_modulus < 1.0)) {
    return fmt::format("the loop with the block has a pole outside the unit circle: |z| {:.6f}",
                       at.largest_pole_modulus);
  }
  return {};
}

double LargestOrbit(const Eigen::VectorXcd& position_m) {
  double largest_m = 0.0;
  for (Index x = 0; x + 1 < position_m.size(); x += 2) {
    largest_m = std::max(largest_m, LargestRadius(position_m[x], position_m[x + 1]));
  }
  return largest_m;
}

/// Orbit and current that the rig file's unbalance leaves, once the block has adapted.
void AddSize(const configuration::RigFile& rig, const analysis::SampledLoop& loop,
             const NotchRequest& request, SpeedFigures& at) {
  const BlockConfig& block = request.block;
  const double speed = at.speed_rad_per_s;
  const analysis::LoopResponse response(loop);
  const MatrixXcd answer = AnswerAt(loop, request, speed);
  const MatrixXcd inverse = InverseOf(answer, request.direction);
  at.growth = analysis::LargestSingularValue(inverse);
  at.condition = at.growth * analysis::LargestSingularValue(answer);
  const bool known = block.order == 1.0 && rig.plant.shafts.empty() && answer.rows() > 1 &&
                     !rig.plant.unbalance.empty();
  if (!known) return;
  const Eigen::VectorXcd open_m =
      uncertainty::UncertainPlant(rig, {}, speed).PositionOf(rig.plant.unbalance, speed);
  const Eigen::VectorXcd left_m = response.Sensitivity(speed / kTwoPi) * open_m;
  at.orbit_alone_m = LargestOrbit(left_m);
  if (block.target == synchronous::Target::kCurrent) {
    at.orbit_m = LargestOrbit(open_m);
  } else {
    at.current_a = (inverse * left_m).cwiseAbs().maxCoeff();
  }
}

/// Slowest decay of the block where the rig answers as it was measured.
double MeasuredDecay(const analysis::SampledLoop& loop, const NotchRequest& request,
                     double speed_rad_per_s) {
  const MatrixXcd answer = AnswerAt(loop, request, speed_rad_per_s);
  const MatrixXcd inverse =
      analysis::MatrixOf(synchronous::InverseAt(request.block, speed_rad_per_s),
                         static_cast<std::size_t>(answer.rows()));
  const MatrixXcd basis = BasisOf(answer.rows(), request.direction);
  return analysis::EigenvaluesWithConjugates(basis.adjoint() * inverse * answer * basis)
      .real()
      .minCoeff();
}

}  // namespace

NotchFigures JudgeNotch(const configuration::RigFile& rig,
                        const std::vector<configuration::RigFile>& drawn, const law::LawConfig& law,
                        const NotchRequest& request) {
  synchronous::SynchronousConfig control;
  control.blocks.push_back(request.block);
  NotchFigures figures;
  figures.rigs = drawn.size();
  figures.hysteresis_rad_per_s = request.block.hysteresis_rad_per_s;
  std::vector<bool> unheld(drawn.size(), false);
  for (const double speed : analysis::JudgedSpeeds(control, kJudged)) {
    SpeedFigures at;
    at.speed_rad_per_s = speed;
    const auto loop = analysis::CloseLoop(rig.plant, law, speed);
    const auto nominal = analysis::JudgeSynchronous(loop, control, speed);
    at.slowest_decay = at.worst_decay = nominal.blocks.front().slowest_decay;
    at.largest_pole_modulus = nominal.largest_pole_modulus;
    if (!request.measured.empty()) {
      at.slowest_decay = at.worst_decay = MeasuredDecay(loop, request, speed);
    }
    AddSize(rig, loop, request, at);
    at.refused = WhyRefused(at, request);
    for (std::size_t n = 0; n < drawn.size() && at.allowed(); ++n) {
      const auto drawn_loop = analysis::CloseLoop(drawn[n].plant, law, speed);
      if (!(analysis::LargestPoleModulus(drawn_loop) < 1.0)) {
        unheld[n] = true;
        continue;
      }
      const auto judged = analysis::JudgeSynchronous(drawn_loop, control, speed);
      at.worst_decay = std::min(at.worst_decay, judged.blocks.front().slowest_decay);
      at.largest_pole_modulus = std::max(at.largest_pole_modulus, judged.largest_pole_modulus);
    }
    at.refused = WhyRefused(at, request);
    figures.speeds.push_back(std::move(at));
  }
  figures.not_held = static_cast<std::size_t>(std::count(unheld.begin(), unheld.end(), true));
  return figures;
}

}  // namespace levitas::design
