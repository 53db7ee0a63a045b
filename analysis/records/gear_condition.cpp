#include "analysis/records/gear_condition.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "analysis/turn_windows.hpp"
#include "numerics/fourier_transform.hpp"
#include "plant_sim/gear/repeat.hpp"
#include "plant_sim/plant/train_model.hpp"

namespace levitas::analysis {
namespace {

using Complex = std::complex<double>;

constexpr double kSameSpeed = 0.005;
constexpr int kShaftOrders = 3;          ///< of every shaft: unbalance, coupling, run-out
constexpr int kSideTurns = 2;            ///< about a mesh line: its modulation by whole shafts
constexpr double kMeshMultiples = 3.5;   ///< up to which lines count
constexpr double kHighestShare = 0.125;  ///< of the sampling rate

/// How the shafts turn within one repeat.
struct Repeat {
  double turns{1.0};              ///< of the first shaft
  std::vector<std::size_t> per;   ///< turns of each shaft
  std::vector<std::size_t> mesh;  ///< engagements of each pair
};

Repeat RepeatOf(const plant::PlantConfig& rig) {
  if (rig.gears.empty()) throw std::invalid_argument("condition of gears: the rig has none");
  Repeat repeat;
  for (const auto& pair : rig.gears) {
    repeat.turns *= gear::TurnsPerRepeat(pair);
  }
  for (const double ratio : plant::SpeedRatios(rig)) {
    repeat.per.push_back(static_cast<std::size_t>(std::lround(std::abs(ratio) * repeat.turns)));
  }
  for (const auto& pair : rig.gears) {
    repeat.mesh.push_back(repeat.per[pair.driving.shaft] *
                          static_cast<std::size_t>(pair.driving.teeth));
  }
  return repeat;
}

/// Lines that every rig has: shafts and teeth.
bool IsRegular(const Repeat& repeat, const plant::PlantConfig& rig, std::size_t line) {
  for (const std::size_t n : repeat.per) {
    if (line % n == 0 && line / n <= kShaftOrders) return true;
  }
  for (std::size_t pair = 0; pair < rig.gears.size(); ++pair) {
    const std::size_t mesh = repeat.mesh[pair];
    const std::size_t away = std::min(line % mesh, mesh - line % mesh);
    if (away == 0) return true;
    for (const std::size_t shaft : {rig.gears[pair].driving.shaft, rig.gears[pair].driven.shaft}) {
      const std::size_t n = repeat.per[shaft];
      if (away % n == 0 && away / n <= kSideTurns) return true;
    }
  }
  return false;
}

/// Repeats of the record, sampled anew at even angles.
class Orbits {
 public:
  Orbits(const session::Recording& recording, const HeldSpeed& held, double repeat_turns,
         std::size_t points)
      : recording_(recording), first_(held.rows.begin), points_(points) {
    double total = 0.0;
    turned_.push_back(0.0);
    for (std::size_t i = first_ + 1; i < held.rows.end; ++i) {
      total += AngleStep(recording, i);
      turned_.push_back(total);
    }
    const double sense = total < 0.0 ? -1.0 : 1.0;
    repeat_rad_ = 2.0 * std::numbers::pi * repeat_turns;
    for (double& at : turned_) at *= sense;
    // One row before and two behind the place are needed.
    start_rad_ = turned_.size() > 4 ? turned_[1] : 0.0;
    const double usable = turned_.size() > 4 ? turned_[turned_.size() - 3] - start_rad_ : 0.0;
    count_ = static_cast<std::size_t>(std::max(0.0, std::floor(usable / repeat_rad_)));
  }

  [[nodiscard]] std::size_t count() const { return count_; }

  /// Coefficients c_m of repeat `r` at a bearing; index m and, backward, points - m.
  [[nodiscard]] std::vector<Complex> Lines(std::size_t bearing, std::size_t r) const {
    std::vector<Complex> orbit(points_);
    const double from = start_rad_ + static_cast<double>(r) * repeat_rad_;
    std::size_t i = static_cast<std::size_t>(
        std::upper_bound(turned_.begin() + 1, turned_.end() - 2, from) - turned_.begin() - 1);
    for (std::size_t k = 0; k < points_; ++k) {
      const double at = from + repeat_rad_ * static_cast<double>(k) / static_cast<double>(points_);
      while (turned_[i + 1] <= at) ++i;
      const double u = (at - turned_[i]) / (turned_[i + 1] - turned_[i]);
      orbit[k] = Between(bearing, first_ + i, u) / static_cast<double>(points_);
    }
    numerics::FourierTransform(orbit);
    return orbit;
  }

 private:
  [[nodiscard]] Complex At(std::size_t bearing, std::size_t row) const {
    return {recording_.position_m[2 * bearing][row], recording_.position_m[2 * bearing + 1][row]};
  }
  /// Cubic through the four samples about the place (Catmull & Rom 1974).
  [[nodiscard]] Complex Between(std::size_t bearing, std::size_t row, double u) const {
    const Complex before = At(bearing, row - 1);
    const Complex a = At(bearing, row);
    const Complex b = At(bearing, row + 1);
    const Complex after = At(bearing, row + 2);
    return a + 0.5 * u *
                   ((b - before) + u * ((2.0 * before - 5.0 * a + 4.0 * b - after) +
                                        u * (3.0 * (a - b) + after - before)));
  }

  const session::Recording& recording_;
  std::size_t first_;
  std::size_t points_;
  std::vector<double> turned_;  ///< [rad] of the first shaft, growing, from the first row
  double repeat_rad_{};
  double start_rad_{};
  std::size_t count_{};
};

/// A line over the repeats.
struct Line {
  Complex mean;
  double of_mean{};  ///< variance of the mean
};

Line LineOf(const std::vector<std::vector<Complex>>& repeats, std::size_t at) {
  const auto count = static_cast<double>(repeats.size());
  Complex mean;
  for (const auto& repeat : repeats) mean += repeat[at] / count;
  double scatter = 0.0;
  for (const auto& repeat : repeats) scatter += std::norm(repeat[at] - mean);
  return {mean, scatter / (count - 1.0) / count};
}

double Fm4(const std::vector<Complex>& series) {
  double square = 0.0;
  double fourth = 0.0;
  for (const Complex& d : series) {
    for (const double part : {d.real(), d.imag()}) {
      square += part * part;
      fourth += part * part * part * part;
    }
  }
  return square > 0.0 ? 2.0 * static_cast<double>(series.size()) * fourth / (square * square) : 0.0;
}

/// The spectra of one bearing's orbit, repeat by repeat, and mean and scatter of their lines.
class Bearing {
 public:
  Bearing(const Orbits& orbits, std::size_t bearing) {
    for (std::size_t r = 0; r < orbits.count(); ++r) {
      repeats_.push_back(orbits.Lines(bearing, r));
    }
  }

  [[nodiscard]] std::size_t Backward(std::size_t line) const {
    return repeats_.front().size() - line;
  }
  [[nodiscard]] Line At(std::size_t index) const { return LineOf(repeats_, index); }

  /// FM4 of the lines, and its deviation.
  [[nodiscard]] Measured Peakedness(const std::vector<std::size_t>& lines,
                                    std::size_t turns) const {
    const auto count = repeats_.size();
    Measured fm4{Fm4(Residual(lines, turns, count)), 0.0};
    std::vector<double> without;
    for (std::size_t r = 0; r < count; ++r) without.push_back(Fm4(Residual(lines, turns, r)));
    const double mean =
        std::accumulate(without.begin(), without.end(), 0.0) / static_cast<double>(count);
    double sum = 0.0;
    for (const double one : without) sum += (one - mean) * (one - mean);
    fm4.deviation = std::sqrt(sum * static_cast<double>(count - 1) / static_cast<double>(count));
    return fm4;
  }

 private:
  /// Over one turn of a shaft that turns `turns` times, the mean of the repeats but `left_out`.
  [[nodiscard]] std::vector<Complex> Residual(const std::vector<std::size_t>& lines,
                                              std::size_t turns, std::size_t left_out) const {
    const std::size_t points = repeats_.front().size();
    std::vector<Complex> spectrum(points);
    for (std::size_t r = 0; r < repeats_.size(); ++r) {
      if (r == left_out) continue;
      for (const std::size_t line : lines) {
        spectrum[line] += std::conj(repeats_[r][line]);
        spectrum[points - line] += std::conj(repeats_[r][points - line]);
      }
    }
    numerics::FourierTransform(spectrum);  // of the conjugates: the inverse, conjugate
    spectrum.resize(points / turns);
    return spectrum;
  }

  std::vector<std::vector<Complex>> repeats_;
};

std::string WheelsOn(const plant::PlantConfig& rig, std::size_t shaft) {
  std::string names;
  for (const auto& pair : rig.gears) {
    for (const auto* wheel : {&pair.driving, &pair.driven}) {
      if (wheel->shaft != shaft) continue;
      names += names.empty() ? "" : " or ";
      names += (wheel == &pair.driving ? "driving wheel of " : "driven wheel of ") + pair.name;
    }
  }
  return names;
}

/// Multiples of a shaft's rotation that no other shaft has; where there are none, all of its
/// multiples, and `of.shared` then names the other shafts.
std::vector<std::size_t> LinesOf(const Repeat& repeat, const plant::PlantConfig& rig,
                                 std::size_t highest, ShaftCondition& of) {
  std::vector<std::size_t> own;
  std::vector<std::size_t> all;
  const std::size_t n = repeat.per[of.shaft];
  for (std::size_t line = n; line <= highest; line += n) {
    if (IsRegular(repeat, rig, line)) continue;
    all.push_back(line);
    bool others = false;
    for (std::size_t s = 0; s < repeat.per.size(); ++s) {
      others = others || (s != of.shaft && line % repeat.per[s] == 0);
    }
    if (!others) own.push_back(line);
  }
  if (!own.empty()) return own;
  for (std::size_t s = 0; s < repeat.per.size(); ++s) {
    if (s != of.shaft && n % repeat.per[s] == 0) of.shared.push_back(s);
  }
  return all;
}

void AddLine(const Line& line, double& energy_m2, double& variance_m4, double repeats) {
  const double unbiased = std::norm(line.mean) - line.of_mean;
  energy_m2 += unbiased;
  variance_m4 += line.of_mean * line.of_mean * repeats / (repeats - 1.0) +
                 2.0 * std::max(0.0, unbiased) * line.of_mean;
}

/// The bearing that sees a shaft best: its own, else the first.
std::size_t BearingOf(const plant::PlantConfig& rig, std::size_t shaft) {
  for (std::size_t b = 0; b < rig.bearings.size(); ++b) {
    if (rig.bearings[b].shaft == shaft) return b;
  }
  return 0;
}

ShaftCondition MeasureShaft(const std::vector<Bearing>& bearings, const plant::PlantConfig& rig,
                            const Repeat& repeat, std::size_t highest, std::size_t shaft,
                            double repeats) {
  ShaftCondition of;
  of.shaft = shaft;
  of.wheels = WheelsOn(rig, shaft);
  const auto lines = LinesOf(repeat, rig, highest, of);
  double variance = 0.0;
  for (const std::size_t line : lines) {
    double energy = 0.0;
    for (const Bearing& bearing : bearings) {
      AddLine(bearing.At(line), energy, variance, repeats);
      AddLine(bearing.At(bearing.Backward(line)), energy, variance, repeats);
    }
    of.line_m2.push_back(energy);
    of.energy_m2.value += energy;
  }
  of.energy_m2.deviation = std::sqrt(variance);
  of.fm4 = bearings[BearingOf(rig, shaft)].Peakedness(lines, repeat.per[shaft]);
  double once = 0.0;
  for (const Bearing& bearing : bearings) {
    const std::size_t n = repeat.per[shaft];
    once += std::norm(bearing.At(n).mean) + std::norm(bearing.At(bearing.Backward(n)).mean);
  }
  of.once_m = std::sqrt(once / static_cast<double>(bearings.size()));
  return of;
}

bool IsHeld(const session::Recording& r, std::size_t row) {
  if (!r.levitated[row]) return false;
  for (std::size_t a = 0; a < r.axes(); ++a) {
    if (r.ExcitationOf(a, row) != 0.0 || r.PositionExcitationOf(a, row) != 0.0) return false;
    if (!std::isfinite(r.position_m[a][row])) return false;
  }
  return true;
}

void TakeMeans(const session::Recording& r, const session::RowRange& rows, GearCondition& of) {
  const auto count = static_cast<double>(rows.end - rows.begin);
  const auto mean = [&](const session::Column& column) {
    const auto* first = column.data() + rows.begin;
    return std::accumulate(first, first + (rows.end - rows.begin), 0.0) / count;
  };
  for (std::size_t a = 0; a < r.axes(); ++a) {
    of.mean_position_m.push_back(mean(r.position_m[a]));
    of.mean_current_a.push_back(mean(r.current_a[a]));
  }
}

}  // namespace

double ShaftCondition::Amplitude() const noexcept {
  return std::sqrt(std::max(0.0, energy_m2.value));
}

std::vector<HeldSpeed> HeldSpeeds(const session::Recording& r, double least_s) {
  std::vector<HeldSpeed> held;
  const auto settle = static_cast<std::size_t>(std::ceil(kSettleAtSpeedS / r.period_s()));
  const auto least = static_cast<std::size_t>(std::ceil(least_s / r.period_s()));
  std::size_t first = 0;
  double sum = 0.0;
  const auto end_at = [&](std::size_t end) {
    if (end >= first + settle + least && sum != 0.0) {
      held.push_back({{first + settle, end}, sum / static_cast<double>(end - first)});
    }
    first = end;
    sum = 0.0;
  };
  for (std::size_t i = 0; i < r.rows(); ++i) {
    if (i > first) {
      const double mean = sum / static_cast<double>(i - first);
      const bool same = std::abs(r.speed_rad_per_s[i] - mean) <= kSameSpeed * std::abs(mean);
      if (!same || !r.Follows(i)) end_at(i);
    }
    if (!IsHeld(r, i)) {
      end_at(i);
      first = i + 1;
      continue;
    }
    sum += r.speed_rad_per_s[i];
  }
  end_at(r.rows());
  return held;
}

double RepeatSeconds(const plant::PlantConfig& rig, double speed_rad_per_s) {
  return RepeatOf(rig).turns * 2.0 * std::numbers::pi / std::abs(speed_rad_per_s);
}

GearCondition MeasureGears(const session::Recording& recording, const HeldSpeed& held,
                           const plant::PlantConfig& rig) {
  const Repeat repeat = RepeatOf(rig);
  const double samples =
      RepeatSeconds(rig, held.speed_rad_per_s) / recording.period_s();  // in a repeat
  const std::size_t largest_mesh = *std::max_element(repeat.mesh.begin(), repeat.mesh.end());
  const auto highest = static_cast<std::size_t>(
      std::min(kMeshMultiples * static_cast<double>(largest_mesh), kHighestShare * samples));
  // A multiple of every shaft's turns, so that one turn is a whole number of points.
  std::size_t points = 1;
  for (const std::size_t n : repeat.per) points = std::lcm(points, n);
  const std::size_t whole = points;
  while (static_cast<double>(points) < samples) points += whole;

  GearCondition of;
  of.speed_rad_per_s = held.speed_rad_per_s;
  TakeMeans(recording, held.rows, of);
  const Orbits orbits(recording, held, repeat.turns, points);
  of.repeats = orbits.count();
  if (of.repeats < kLeastRepeats) return of;
  std::vector<Bearing> bearings;
  for (std::size_t b = 0; b < rig.bearings.size(); ++b) bearings.emplace_back(orbits, b);
  std::vector<bool> carries(rig.shafts.size());
  double mesh = 0.0;
  for (std::size_t pair = 0; pair < rig.gears.size(); ++pair) {
    carries[rig.gears[pair].driving.shaft] = carries[rig.gears[pair].driven.shaft] = true;
    for (std::size_t line = repeat.mesh[pair]; line <= highest; line += repeat.mesh[pair]) {
      for (const Bearing& bearing : bearings) {
        mesh +=
            std::norm(bearing.At(line).mean) + std::norm(bearing.At(bearing.Backward(line)).mean);
      }
    }
  }
  of.mesh_m = std::sqrt(mesh / static_cast<double>(bearings.size()));
  for (std::size_t s = 0; s < rig.shafts.size(); ++s) {
    if (!carries[s]) continue;
    of.shafts.push_back(
        MeasureShaft(bearings, rig, repeat, highest, s, static_cast<double>(of.repeats)));
  }
  return of;
}

}  // namespace levitas::analysis
