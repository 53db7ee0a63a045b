#include "diagnosis/record_errors/other_rig.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/problem.hpp"
#include "diagnosis/record_errors/plant_fit.hpp"
#include "plant_sim/magnet/magnet.hpp"

namespace levitas::diagnosis {
namespace {

constexpr ObserverSpeed kBetweenSpeeds{0.003, 1e-5};
constexpr Eigen::Index kLags = 12;
constexpr double kFewest = 1.0;  ///< left at least
constexpr double kSteady = 0.1;  ///< of the speed
constexpr Eigen::Index kFewestSteady = 3000;
constexpr std::array kSprings{-0.3, -0.1, 0.1, 0.3, 1.0, 3.0, 10.0};  ///< of a magnet's ks

/// What is left of innovations when what went before foretells them; see the header.
double LeftToKnow(const Eigen::MatrixXd& error, const Eigen::MatrixXd& current) {
  const Eigen::Index axes = error.cols();
  const Eigen::Index size = 2 * kLags * axes + 1;
  constexpr Eigen::Index kBlock = 256;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(size, axes);
  Eigen::VectorXd power = Eigen::VectorXd::Zero(axes);
  Eigen::MatrixXd block(kBlock, size);
  Eigen::MatrixXd target(kBlock, axes);
  Eigen::Index filled = 0;
  const auto take = [&] {
    const auto used = block.topRows(filled);
    gram.selfadjointView<Eigen::Lower>().rankUpdate(used.transpose());
    right += used.transpose() * target.topRows(filled);
    power += target.topRows(filled).colwise().squaredNorm().transpose();
    filled = 0;
  };
  Eigen::Index counting = 0;  // rows up to this one that count
  for (Eigen::Index n = 0; n < error.rows(); ++n) {
    counting = error.row(n).isZero(0.0) ? 0 : counting + 1;
    if (counting <= kLags) continue;
    for (Eigen::Index lag = 1; lag <= kLags; ++lag) {
      block.row(filled).segment((lag - 1) * axes, axes) = error.row(n - lag);
      block.row(filled).segment((kLags + lag - 1) * axes, axes) = current.row(n - lag);
    }
    block(filled, size - 1) = 1.0;
    target.row(filled) = error.row(n);
    if (++filled == kBlock) take();
  }
  take();
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
  const Eigen::VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * gram * scale.asDiagonal();
  scaled.diagonal().array() += 1e-10;
  const Eigen::MatrixXd known = scale.asDiagonal() * right;
  const Eigen::MatrixXd solved = scaled.ldlt().solve(known);
  const Eigen::VectorXd left = power - solved.cwiseProduct(known).colwise().sum().transpose();
  return (power.array().max(1e-300) / left.array().max(1e-12 * power.array()).max(1e-300))
      .log()
      .sum();
}

struct Share {
  double told{}, left{};

  [[nodiscard]] double value() const { return std::max(0.0, told) / (std::max(0.0, told) + left); }
};

/// Nothing where no observer exists or too few rows count.
std::optional<Share> ShareOf(const RigNumbers& numbers, const plant::PlantConfig& plant,
                             const Columns& columns) try {
  const RigView rig(numbers, plant);
  const PlantFit fit(rig, columns, kBetweenSpeeds, false);
  ColumnUses uses;
  const Eigen::VectorXd with = fit.Ratios(uses);
  if (with.size() == 0) return std::nullopt;
  Share share;
  share.left = LeftToKnow(fit.Innovations(uses), columns.current_a);
  for (ColumnUse& current : uses.current) current.factor = 0.0;
  share.told = (fit.Ratios(uses).array() / with.array()).log().sum();
  return share;
} catch (const Problem&) {
  return std::nullopt;
}

plant::PlantConfig WithNoise(const RigView& rig, const AxisArray& noise_m) {
  plant::PlantConfig plant = rig.model->config();
  for (std::size_t b = 0; b < plant.bearings.size(); ++b) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t a = 2 * b; a < std::min(2 * b + 2, rig.axes); ++a) {
      sum += noise_m[a];
      count += 1.0;
    }
    if (!(sum > 0.0)) continue;
    plant.bearings[b].sensor.noise_rms_m = sum / count;
    plant.bearings[b].sensor.adc_bits = 0;
  }
  return plant;
}

/// Whether a spring at the drive end makes the file right enough.
bool SpringExplains(const RigView& rig, const plant::PlantConfig& plant, const Columns& columns) {
  if (rig.geared()) return false;
  const double ks = std::abs(magnet::NegativeStiffness(rig.magnet(0).magnet, rig.bias_a(0)));
  return std::ranges::any_of(kSprings, [&](double times) {
    plant::PlantConfig with = plant;
    effect::EffectConfig spring;
    spring.id = effect::Id::kCouplingStiffness;
    spring.values = {0.0, times * ks, 0.0};
    with.effects.push_back(spring);
    const std::optional<Share> share = ShareOf(rig.numbers, with, columns);
    return share && share->value() >= kLeastShare;
  });
}

bool IsSteady(const Columns& columns) {
  const double slowest = columns.speed_rad_per_s.minCoeff();
  const double fastest = columns.speed_rad_per_s.maxCoeff();
  return fastest - slowest <= kSteady * std::max(std::abs(slowest), std::abs(fastest));
}

}  // namespace

void FindOtherRig(const RigView& rig, const Columns& columns, const AxisArray& noise_m,
                  RecordErrors& out) {
  if (columns.rows() < kFewestSteady || !IsSteady(columns)) return;
  if (!(columns.excitation_a.cwiseAbs().maxCoeff() > 0.0)) return;
  const plant::PlantConfig plant = WithNoise(rig, noise_m);
  const std::optional<Share> share = ShareOf(rig.numbers, plant, columns);
  if (!share || share->left < kFewest || share->value() >= kLeastShare) return;
  if (SpringExplains(rig, plant, columns)) return;
  out.errors.push_back(
      {RecordErrorKind::kOtherRig,
       {},
       share->value(),
       std::exp(share->left),
       fmt::format("the rig file may be another rig's: of what the currents do to the rotor it "
                   "foretells {:.0f} %, of its own rig, healthy or with most faults, 70 % and more",
                   100.0 * share->value()),
       "give the file of the rig that was recorded (--rig); compare rotor, magnets and places of "
       "the probes",
       false});
}

}  // namespace levitas::diagnosis
