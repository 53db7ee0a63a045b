#include "identification/modal/modal_pairing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/two_pi.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;
using Kind = LineKind;

constexpr int kPoleRounds = 8;
constexpr int kApproaches = 3;
/// ln of a frequency of the rig file, where pairings are compared.
constexpr double kKnownFrequency = 0.1;
/// Pairings that are compared beyond the approach.
constexpr std::size_t kFinalists = 3;
/// Scan for a mode that no pole shows: reach and step in ln f, and what tells one place from
/// others.
constexpr int kScanSteps = 24;
constexpr double kScanStep = 0.005;
constexpr double kElsewhere = 0.02;
constexpr double kPlaced = 12.0;
/// A pole of a smaller share of the orders, farther from the rig file's than this, is doubtful.
constexpr double kSureShare = 0.8;
constexpr double kFar = 0.1;

/// Moves the free rotor's frequencies until the poles in the magnets are those of the diagram: a
/// resonance that starts beside its peak is flattened by damping before it finds it.
void MeetPoles(const ModalFrame& frame, const Assigned& assigned, Eigen::VectorXd& vector) {
  const ModalLayout& at = frame.layout;
  for (int round = 0; round < kPoleRounds; ++round) {
    const Physical rig = ToPhysical(frame, vector);
    const auto support = SupportOf(rig, assigned);
    for (Index i = 0; i < at.bending; ++i) {
      const ModeSupport& mode = support[static_cast<std::size_t>(i)];
      if (mode.shown_hz <= 0.0) continue;
      if (mode.plant_hz <= 0.0) {  // the magnets pull the mode away altogether
        vector[at.frequency + i] += 0.1;
        continue;
      }
      const double off = mode.shown_hz * mode.shown_hz - mode.plant_hz * mode.plant_hz;
      const double hz = rig.frequency_rad_per_s[2 + i] / (kTwoPi);
      const double lowest = 0.25 * mode.shown_hz * mode.shown_hz;
      vector[at.frequency + i] = std::log(kTwoPi * std::sqrt(std::max(hz * hz + off, lowest)));
    }
  }
}

/// Alternately the poles and everything else, on few lines: leads a poor start into the valley.
void Approach(Search& search, const ModalStart& start, const Assigned& assigned,
              const FitData& standing, ModalFit& fit) {
  for (int round = 0; round < kApproaches; ++round) {
    MeetPoles(start.frame, assigned, fit.vector);
    search.Run({.name = "log magnitude, poles held",
                .data = {&standing},
                .kind = Kind::kLogMagnitude,
                .robust = true,
                .poles_free = false,
                .iterations = 6,
                .stride = 8});
  }
  MeetPoles(start.frame, assigned, fit.vector);
}

/// Everything free, still forgiving: from here the pairings can be compared.
void Settle(Search& search, const ModalStart& start, const Assigned& assigned,
            const FitData& standing, ModalFit& fit) {
  search.Run({.name = "complex, soft L1, poles held",
              .data = {&standing},
              .robust = true,
              .poles_free = false,
              .iterations = 20,
              .stride = 4});
  MeetPoles(start.frame, assigned, fit.vector);
  search.Run({.name = "complex, soft L1",
              .data = {&standing},
              .robust = true,
              .iterations = 40,
              .stride = 2});
}

/// The search begins with the poles of the diagram where it shows some, else with the rig file's.
void TakePoles(const ModalStart& start, const Assigned& assigned, Eigen::VectorXd& vector) {
  const ModalLayout& at = start.frame.layout;
  for (Index i = 0; i < at.bending; ++i) {
    vector[at.frequency + i] = start.vector[at.frequency + i];
    vector[at.damping + i] = start.vector[at.damping + i];
    if (const auto& mode = assigned[static_cast<std::size_t>(i)]; mode) {
      vector[at.frequency + i] = std::log(kTwoPi * mode->frequency_hz);
      vector[at.damping + i] = std::log(std::clamp(mode->damping_ratio, 5e-4, 0.01));
    }
  }
}

/// Prior cost of a pairing: the rig file's frequencies are known to some per cent.
double Strangeness(const ModalStart& start, const Assigned& assigned) {
  const ModalLayout& at = start.frame.layout;
  double cost = 0.0;
  for (Index i = 0; i < at.bending; ++i) {
    const auto& mode = assigned[static_cast<std::size_t>(i)];
    if (!mode) continue;
    const double apart = std::log(kTwoPi * mode->frequency_hz) - start.vector[at.frequency + i];
    cost += 0.5 * std::pow(apart / kKnownFrequency, 2);
  }
  return cost;
}

/// ln of the frequency ratio at which the mode is placed.
std::optional<double> FindMode(const Search& search, const ModalStart& start, Index mode,
                               const FitData& standing, const Eigen::VectorXd& vector) {
  const ModalLayout& at = start.frame.layout;
  Eigen::VectorXd moved = vector;
  moved.segment(at.shape_at(mode, 0), 2 * at.bearings) =
      start.vector.segment(at.shape_at(mode, 0), 2 * at.bearings);
  moved[at.damping + mode] = start.vector[at.damping + mode];
  std::vector<double> cost;
  for (int step = -kScanSteps; step <= kScanSteps; ++step) {
    moved[at.frequency + mode] = start.vector[at.frequency + mode] + step * kScanStep;
    cost.push_back(search.CostAt(moved, {.name = "scan", .data = {&standing}}));
  }
  const auto best = std::ranges::min_element(cost) - cost.begin();
  double elsewhere = std::numeric_limits<double>::infinity();
  for (std::ptrdiff_t n = 0; n < std::ssize(cost); ++n) {
    if (static_cast<double>(std::abs(n - best)) * kScanStep < kElsewhere) continue;
    elsewhere = std::min(elsewhere, cost[static_cast<std::size_t>(n)]);
  }
  if (cost[static_cast<std::size_t>(best)] + kPlaced > elsewhere) return std::nullopt;
  return static_cast<double>(best - kScanSteps) * kScanStep;
}

bool IsDoubtful(const ModalStart& start, Index mode, const ProposedMode& pole) {
  const double own = start.vector[start.frame.layout.frequency + mode];
  return pole.share < kSureShare && pole.evidence <= 0.0 &&
         std::abs(std::log(kTwoPi * pole.frequency_hz) - own) > kFar;
}

}  // namespace

Assigned BestPairing(const ModalStart& start, const Eigen::VectorXd& begin,
                     const std::vector<Assigned>& candidates, const FitData& standing,
                     const ModalFitOptions& options, ModalFit& fit) {
  std::vector<ModalFit> approached(candidates.size());
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    approached[n].vector = begin;
    TakePoles(start, candidates[n], approached[n].vector);
    Search search(start, candidates[n], options, approached[n]);
    Approach(search, start, candidates[n], standing, approached[n]);
    order.emplace_back(approached[n].cost + Strangeness(start, candidates[n]), n);
  }
  std::ranges::sort(order);
  double lowest = std::numeric_limits<double>::infinity();
  std::size_t best = order.front().second;
  for (std::size_t k = 0; k < std::min(order.size(), kFinalists); ++k) {
    const std::size_t n = order[k].second;
    Search search(start, candidates[n], options, approached[n]);
    Settle(search, start, candidates[n], standing, approached[n]);
    const double cost = approached[n].cost + Strangeness(start, candidates[n]);
    if (cost >= lowest) continue;
    lowest = cost;
    best = n;
  }
  fit = std::move(approached[best]);
  return candidates[best];
}

Assigned PlaceOthers(const ModalStart& start, const Assigned& assigned, const FitData& standing,
                     const ModalFitOptions& options, ModalFit& fit) {
  const ModalLayout& at = start.frame.layout;
  Assigned placed = assigned;
  for (Index i = 0; i < at.bending; ++i) {
    auto& mode = placed[static_cast<std::size_t>(i)];
    if (mode && !IsDoubtful(start, i, *mode)) continue;
    const Search search(start, placed, options, fit);
    const auto moved = FindMode(search, start, i, standing, fit.vector);
    mode.reset();
    fit.vector[at.frequency + i] = start.vector[at.frequency + i] + moved.value_or(0.0);
    fit.vector[at.damping + i] = start.vector[at.damping + i];
    fit.vector.segment(at.shape_at(i, 0), 2 * at.bearings) =
        start.vector.segment(at.shape_at(i, 0), 2 * at.bearings);
    if (!moved) continue;
    mode = ProposedMode{std::exp(fit.vector[at.frequency + i]) / kTwoPi,
                        std::exp(fit.vector[at.damping + i]), 0.0, 0.0};
  }
  return placed;
}

}  // namespace levitas::identification
