#include "diagnosis/record_errors/plant_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "analysis/records/observer.hpp"
#include "plant_sim/plant/linear_model.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kShortStretchS = 0.1;
constexpr double kMostSettlingS = 0.15;
constexpr std::uint64_t kLongestBridge = 20;  ///< missing rows
constexpr std::size_t kFewestCounted = 500;   ///< rows that count

/// State: plant, commands on their way, unknown forces.
struct Filter {
  Eigen::MatrixXd forward;  ///< of the state, without correction
  Eigen::MatrixXd closed;   ///< with it
  Eigen::MatrixXd reading;  ///< of a reading into the state
  Eigen::MatrixXd current;  ///< of a command
  Eigen::MatrixXd output;   ///< reading of the state
  Eigen::VectorXd expected_m;
  std::size_t settling_rows{};
};

Filter MakeFilter(const RigView& rig, double speed_rad_per_s, const ObserverSpeed& speed,
                  double period_factor) {
  plant::PlantConfig config = rig.model->config();
  config.period_ns = std::llround(static_cast<double>(config.period_ns) * period_factor);
  const double period_s = static_cast<double>(config.period_ns) * 1e-9;
  const analysis::ObserverGain gain = analysis::DesignObserver(
      config, {speed_rad_per_s, speed.force_noise_share, speed.force_drift_share});
  const plant::LinearModel sampled =
      plant::Discretise(plant::Linearise(*rig.model, speed_rad_per_s), period_s,
                        rig.model->delay_samples() / period_factor);
  const Eigen::Index states = sampled.a.rows();
  const auto axes = static_cast<Eigen::Index>(rig.axes);
  Filter f;
  f.forward = Eigen::MatrixXd::Identity(states + axes, states + axes);
  f.forward.topLeftCorner(states, states) = sampled.a;
  f.forward.topRightCorner(states, axes).setZero();
  f.forward.block(0, states, gain.force_step.rows(), axes) = gain.force_step;
  f.output = Eigen::MatrixXd::Zero(axes, states + axes);
  f.output.leftCols(states) = sampled.c.topRows(axes);
  f.current = Eigen::MatrixXd::Zero(states + axes, axes);
  f.current.topRows(states) = sampled.b.leftCols(axes);
  Eigen::MatrixXd correction = Eigen::MatrixXd::Zero(states + axes, axes);
  correction.topRows(gain.state.rows()) = gain.state;
  correction.bottomRows(axes) = gain.force_n_per_m;
  f.reading = f.forward * correction;
  f.closed = f.forward - f.reading * f.output;
  f.expected_m = Eigen::Map<const Eigen::VectorXd>(gain.expected_innovation_m.data(), axes);
  f.settling_rows =
      static_cast<std::size_t>(std::ceil(std::min(gain.settling_s, kMostSettlingS) / period_s));
  return f;
}

/// Columns of a state, one for each pair of a column and its place.
struct Drives {
  std::vector<std::size_t> column, place;
};

Drives MakeDrives(std::size_t axes, bool every_place) {
  Drives drives;
  for (std::size_t c = 0; c < axes; ++c) {
    for (std::size_t p = 0; p < axes; ++p) {
      if (!every_place && p != c) continue;
      drives.column.push_back(c);
      drives.place.push_back(p);
    }
  }
  return drives;
}

/// Into `next` what was read of row n, unless the frame is lost, and its currents, each through its
/// place: the state of the row after it.
void DriveStates(const Filter& filter, const Drives& drives, const Columns& columns, Eigen::Index n,
                 bool arrived, Eigen::MatrixXd& state, Eigen::MatrixXd& next) {
  const auto count = static_cast<Eigen::Index>(drives.column.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto c = static_cast<Eigen::Index>(drives.column[static_cast<std::size_t>(i)]);
    const auto p = static_cast<Eigen::Index>(drives.place[static_cast<std::size_t>(i)]);
    if (arrived) next.col(i) += filter.reading.col(p) * columns.position_m(n, c);
    next.col(count + i) += filter.current.col(p) * columns.current_a(n, c);
  }
  state.swap(next);
}

}  // namespace

PlantFit::PlantFit(const RigView& rig, const Columns& columns, const ObserverSpeed& speed,
                   bool every_place, double period_factor)
    : axes_(rig.axes), every_place_(every_place) {
  Run(rig, columns, speed, period_factor);
  MakeBasis(columns, static_cast<std::size_t>(std::llround(kShortStretchS / rig.period_s)));
}

void PlantFit::Run(const RigView& rig, const Columns& columns, const ObserverSpeed& speed,
                   double period_factor) {
  const Filter filter = MakeFilter(rig, columns.mean_speed_rad_per_s, speed, period_factor);
  expected_m_ = filter.expected_m;
  const Drives drives = MakeDrives(axes_, every_place_);
  const auto count = static_cast<Eigen::Index>(drives.column.size());
  const auto axes = static_cast<Eigen::Index>(axes_);
  const Eigen::Index rows = columns.rows();
  of_position_.assign(drives.column.size(), Eigen::MatrixXd::Zero(rows, axes));
  of_current_ = of_position_;
  counts_.assign(static_cast<std::size_t>(rows), 0);
  Eigen::MatrixXd state = Eigen::MatrixXd::Zero(filter.forward.rows(), 2 * count);
  Eigen::MatrixXd next = state;
  Eigen::MatrixXd error(axes, 2 * count);
  std::size_t since = 0;
  for (Eigen::Index n = 0; n < rows; ++n) {
    const auto row = static_cast<std::size_t>(n);
    const std::uint64_t missing = columns.missing[row];
    if (missing > kLongestBridge) {
      state.setZero();
      since = 0;
    } else {
      for (std::uint64_t k = 0; k < missing; ++k) {
        next.noalias() = filter.forward * state;
        DriveStates(filter, drives, columns, n - 1, false, state, next);
      }
    }
    const bool arrived = columns.repeated[row] == 0;
    error.noalias() = -filter.output * state;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      error(static_cast<Eigen::Index>(drives.place[at]), i) +=
          columns.position_m(n, static_cast<Eigen::Index>(drives.column[at]));
      of_position_[at].row(n) = error.col(i);
      of_current_[at].row(n) = error.col(count + i);
    }
    next.noalias() = (arrived ? filter.closed : filter.forward) * state;
    DriveStates(filter, drives, columns, n, arrived, state, next);
    counts_[row] = arrived && ++since > filter.settling_rows ? 1 : 0;
  }
}

void PlantFit::MakeBasis(const Columns& columns, std::size_t rows_a_stretch) {
  const Eigen::Index rows = columns.rows();
  // A column that is taken late or early reads over a break.
  std::vector<std::uint8_t> near(counts_.size(), 0);
  for (Eigen::Index n = 0; n < rows; ++n) {
    const bool edge = columns.missing[static_cast<std::size_t>(n)] > 0 || n + 1 == rows;
    if (!edge) continue;
    for (Eigen::Index k = std::max<Eigen::Index>(0, n - kEdge); k < std::min(rows, n + kEdge);
         ++k) {
      near[static_cast<std::size_t>(k)] = 1;
    }
  }
  for (std::size_t n = 0; n < counts_.size(); ++n) {
    if (near[n] != 0) counts_[n] = 0;
    counted_ += counts_[n];
  }
  for (Eigen::Index from = 0; from < rows;) {
    Eigen::Index to = from + 1;
    const auto most = static_cast<Eigen::Index>(rows_a_stretch);
    while (to < rows && to - from < most &&
           columns.missing[static_cast<std::size_t>(to)] != kNewSpan) {
      ++to;
    }
    Stretch stretch{from, to, Eigen::MatrixXd::Zero(to - from, 5)};
    Eigen::Index counting = 0;
    for (Eigen::Index n = from; n < to; ++n) {
      if (counts_[static_cast<std::size_t>(n)] == 0) continue;
      ++counting;
      const double angle = columns.angle_rad[n];
      stretch.basis.row(n - from) << 1.0, std::cos(angle), std::sin(angle), std::cos(2.0 * angle),
          std::sin(2.0 * angle);
    }
    if (counting > 50) {
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(stretch.basis);
      const Eigen::Index rank = qr.rank();
      stretch.basis = qr.householderQ() * Eigen::MatrixXd::Identity(to - from, rank);
      stretches_.push_back(std::move(stretch));
    }
    from = to;
  }
}

Eigen::MatrixXd PlantFit::Raw(const Stretch& s, const ColumnUses& uses) const {
  const Eigen::Index length = s.to - s.from;
  Eigen::MatrixXd error = Eigen::MatrixXd::Zero(length, static_cast<Eigen::Index>(axes_));
  const auto add = [&](const std::vector<Eigen::MatrixXd>& of, const ColumnUse& use,
                       std::size_t place) {
    const Eigen::MatrixXd& response = of[Slot(use.from, place)];
    const Eigen::Index from =
        std::clamp<Eigen::Index>(s.from + use.late, 0, response.rows() - length);
    error += use.factor * response.middleRows(from, length);
  };
  for (std::size_t a = 0; a < axes_; ++a) {
    add(of_position_, uses.position[a], a);
    add(of_current_, uses.current[a], a);
  }
  for (Eigen::Index n = s.from; n < s.to; ++n) {
    if (counts_[static_cast<std::size_t>(n)] == 0) error.row(n - s.from).setZero();
  }
  return error;
}

Eigen::VectorXd PlantFit::Ratios(const ColumnUses& uses) const {
  const Eigen::VectorXd squares = MeanSquares(uses);
  if (squares.size() == 0) return {};
  return squares.cwiseQuotient(expected_m_.cwiseAbs2());
}

Eigen::VectorXd PlantFit::MeanSquares(const ColumnUses& uses) const {
  if (counted_ < kFewestCounted) return {};
  const auto axes = static_cast<Eigen::Index>(axes_);
  Eigen::VectorXd power = Eigen::VectorXd::Zero(axes);
  double count = 0.0;
  for (const Stretch& s : stretches_) {
    const Eigen::MatrixXd error = Raw(s, uses);
    const Eigen::MatrixXd within = s.basis.transpose() * error;
    power += (error.colwise().squaredNorm() - within.colwise().squaredNorm()).transpose();
    for (Eigen::Index n = s.from; n < s.to; ++n) count += counts_[static_cast<std::size_t>(n)];
    count -= static_cast<double>(s.basis.cols());
  }
  if (count < 100.0) return {};
  return power / count;
}

}  // namespace levitas::diagnosis
