#include "identification/frf/experiments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "identification/frf/excitation_period.hpp"
#include "identification/frf/sine_steps.hpp"

namespace levitas::identification {
namespace {

constexpr double kPauseS = 0.2;
/// Speeds closer than this, relative or in rad/s, are the same: a drive holds its speed.
constexpr double kSameSpeed = 0.01;
constexpr double kStandsRadPerS = 1.0;

/// A frequency that comes again begins a sweep of its own; steps are farther apart.
constexpr double kSameFrequency = 2e-3;
constexpr std::size_t kMostBlocks = 8;
/// Strokes are alike within this share of the largest.
constexpr double kSameStroke = 1e-6;

/// What is excited in a row.
struct Excited {
  std::size_t axis{};
  SummingPoint point{};
  [[nodiscard]] bool operator==(const Excited&) const = default;
};

struct Piece {
  Excited excited;
  std::size_t begin{};
  std::size_t end{};
  std::size_t available{};  ///< row at which something else begins
};

std::string Where(const session::Recording& record, std::size_t axis, std::size_t row) {
  return fmt::format("{}: excitation of {} from {:.4f} s", record.name, record.channels[axis],
                     static_cast<double>(record.cycle[row] - record.cycle[0]) * record.period_s());
}

/// The axis and the point excited in a row; nothing when none is.
std::optional<Excited> ExcitedIn(const session::Recording& record, std::size_t row) {
  std::optional<Excited> found;
  for (std::size_t axis = 0; axis < record.axes(); ++axis) {
    const bool current = record.ExcitationOf(axis, row) != 0.0;
    const bool reading = record.PositionExcitationOf(axis, row) != 0.0;
    if (!current && !reading) continue;
    if (current && reading) {
      throw BadInput(Where(record, axis, row) +
                     ": excites its current and its reading together: their responses cannot be "
                     "told apart; excite one point after the other");
    }
    if (found) {
      throw BadInput(fmt::format(
          "{}: excites {} and {} together: their responses cannot be told apart; excite one axis "
          "after the other",
          Where(record, axis, row), record.channels[found->axis], record.channels[axis]));
    }
    found = Excited{axis, reading ? SummingPoint::kReading : SummingPoint::kCurrent};
  }
  return found;
}

std::vector<Piece> FindPieces(const session::Recording& record) {
  const auto pause = static_cast<std::size_t>(std::lround(kPauseS / record.period_s()));
  std::vector<Piece> pieces;
  for (std::size_t row = 0; row < record.rows(); ++row) {
    const auto excited = ExcitedIn(record, row);
    if (!excited) continue;
    const bool goes_on =
        !pieces.empty() && pieces.back().excited == *excited && row - pieces.back().end <= pause;
    if (goes_on) {
      pieces.back().end = row + 1;
    } else {
      if (!pieces.empty()) pieces.back().available = row;
      pieces.push_back({*excited, row, row + 1, record.rows()});
    }
  }
  return pieces;
}

bool Alike(const session::Recording& record, const Piece& a, const Piece& b) {
  if (a.excited != b.excited || a.end - a.begin != b.end - b.begin) return false;
  const session::Column& signal = SignalColumn(record, a.excited.axis, a.excited.point);
  double largest = 0.0;
  double apart = 0.0;
  for (std::size_t n = 0; n < a.end - a.begin; ++n) {
    largest = std::max(largest, std::abs(signal[a.begin + n]));
    apart = std::max(apart, std::abs(signal[a.begin + n] - signal[b.begin + n]));
  }
  return apart <= kSameStroke * largest;
}

/// Strokes that are alike, shorter than the pauses and evenly spaced are one train.
std::vector<Piece> JoinTrains(const session::Recording& record, const std::vector<Piece>& pieces) {
  std::vector<Piece> joined;
  for (std::size_t first = 0; first < pieces.size();) {
    std::size_t last = first;
    const std::size_t length = pieces[first].end - pieces[first].begin;
    while (last + 1 < pieces.size() && Alike(record, pieces[first], pieces[last + 1])) {
      const std::size_t distance = pieces[last + 1].begin - pieces[last].begin;
      const std::size_t spacing = pieces[first + 1].begin - pieces[first].begin;
      if (distance != spacing || 2 * length > spacing) break;
      ++last;
    }
    joined.push_back(
        {pieces[first].excited, pieces[first].begin, pieces[last].end, pieces[last].available});
    first = last + 1;
  }
  return joined;
}

void CheckRows(const session::Recording& record, const Piece& piece, std::size_t end) {
  for (std::size_t row = piece.begin; row < end; ++row) {
    if (row > piece.begin && record.cycle[row] <= record.cycle[row - 1]) {
      throw BadInput(fmt::format(
          "{}: no frame arrived after {:.4f} s; record it again",
          Where(record, piece.excited.axis, piece.begin),
          static_cast<double>(record.cycle[row - 1] - record.cycle[0]) * record.period_s()));
    }
    if (row > piece.begin && record.cycle[row] != record.cycle[row - 1] + 1) {
      throw BadInput(fmt::format(
          "{}: {} samples are missing at {:.4f} s; record it again",
          Where(record, piece.excited.axis, piece.begin),
          record.cycle[row] - record.cycle[row - 1] - 1,
          static_cast<double>(record.cycle[row] - record.cycle[0]) * record.period_s()));
    }
    if (record.levitated[row] == 0) {
      throw BadInput(Where(record, piece.excited.axis, piece.begin) +
                     ": the rotor is not levitated throughout");
    }
  }
}

double SteadySpeed(const session::Recording& record, const Experiment& experiment) {
  const auto begin = record.speed_rad_per_s.begin() + static_cast<std::ptrdiff_t>(experiment.begin);
  const auto end = record.speed_rad_per_s.begin() + static_cast<std::ptrdiff_t>(experiment.end());
  const auto [low, high] = std::minmax_element(begin, end);
  const double mean = 0.5 * (*low + *high);
  if (*high - *low > std::max(kStandsRadPerS, kSameSpeed * std::abs(mean))) {
    throw BadInput(fmt::format("{}: the speed changes from {:.0f} to {:.0f} rpm meanwhile",
                               Where(record, experiment.axis, experiment.begin), RadPerSToRpm(*low),
                               RadPerSToRpm(*high)));
  }
  return mean;
}

std::span<const double> SignalOf(const session::Recording& record, const Piece& piece) {
  return std::span<const double>(SignalColumn(record, piece.excited.axis, piece.excited.point))
      .subspan(piece.begin, piece.end - piece.begin);
}

/// Whether the signal's period holds nothing but zeros from where the piece ends to `whole` rows.
bool EndsInSilence(std::span<const double> signal, std::size_t period, std::size_t whole) {
  for (std::size_t n = signal.size(); n < whole; ++n) {
    if (signal[n - period] != 0.0) return false;
  }
  return true;
}

Experiment Periodic(const session::Recording& record, const Piece& piece,
                    const ExperimentOptions& options) {
  const auto signal = SignalOf(record, piece);
  const auto period = RepeatsAfter(signal);
  if (!period) {
    throw BadInput(fmt::format(
        "{} ({:.4f} s long): the signal does not repeat itself, nor is it made of sines held one "
        "after the other; at least {} whole periods are needed, the first of which is the "
        "transient. A signal that the scenario's orbit limit cut back does not repeat either: "
        "raise orbit_limit_um or lower the amplitude",
        Where(record, piece.excited.axis, piece.begin),
        static_cast<double>(signal.size()) * record.period_s(),
        options.dropped_periods + options.needed_periods));
  }
  // An impulse train ends with its last stroke: its last period goes on as long as nothing else
  // begins.
  const std::size_t started = (signal.size() + *period - 1) / *period;
  const bool complete = piece.begin + started * *period <= piece.available &&
                        EndsInSilence(signal, *period, started * *period);
  const std::size_t periods = complete ? started : signal.size() / *period;
  if (periods < options.dropped_periods + options.needed_periods) {
    throw BadInput(fmt::format(
        "{}: {} whole periods of {} samples, needed are {}: {} for the transient and {} to average",
        Where(record, piece.excited.axis, piece.begin), periods, *period,
        options.dropped_periods + options.needed_periods, options.dropped_periods,
        options.needed_periods));
  }
  return {piece.excited.axis,
          piece.excited.point,
          piece.begin + options.dropped_periods * *period,
          *period,
          periods - options.dropped_periods,
          0.0,
          {}};
}

/// Whole periods of the settled part, in rows of the record.
HeldSine Settled(const SineStep& step, const Piece& piece, const ExperimentOptions& options) {
  const auto length = static_cast<double>(step.end - step.begin);
  const double usable = length * (1.0 - options.settle_share);
  // The last sample of a step may already be the next one's.
  const double periods = std::floor((usable - 1.0) * step.cycles_per_sample);
  const auto rows = static_cast<std::size_t>(std::lround(periods / step.cycles_per_sample));
  const std::size_t end = piece.begin + step.end - 1;
  return {end - rows, end, step.cycles_per_sample};
}

std::size_t BlocksOf(const HeldSine& sine) {
  const double periods = static_cast<double>(sine.end - sine.begin) * sine.cycles_per_sample;
  return std::min(kMostBlocks, static_cast<std::size_t>(std::lround(periods)));
}

void RefuseShort(const session::Recording& record, const Piece& piece, const HeldSine& sine,
                 const ExperimentOptions& options) {
  if (BlocksOf(sine) >= options.needed_periods) return;
  throw BadInput(fmt::format(
      "{}: {:.2f} Hz is held for {} whole periods after settling, needed are {}: hold it longer "
      "(dwell_s), or begin higher",
      Where(record, piece.excited.axis, piece.begin), sine.cycles_per_sample / record.period_s(),
      BlocksOf(sine), options.needed_periods));
}

/// One experiment per whole sweep.
std::vector<Experiment> Stepped(const session::Recording& record, const Piece& piece,
                                const std::vector<SineStep>& steps,
                                const ExperimentOptions& options) {
  std::vector<std::vector<HeldSine>> sweeps(1);
  for (const SineStep& step : steps) {
    const auto& first = sweeps.front();
    const bool again =
        !first.empty() &&
        std::abs(step.cycles_per_sample / first.front().cycles_per_sample - 1.0) < kSameFrequency;
    if (again) sweeps.emplace_back();
    sweeps.back().push_back(Settled(step, piece, options));
  }
  const std::size_t lines = sweeps.front().size();
  std::vector<Experiment> experiments;
  for (std::vector<HeldSine>& sweep : sweeps) {
    if (sweep.size() != lines) continue;
    const bool last_breaks_off = experiments.size() > 0 && BlocksOf(sweep.back()) < 2;
    if (last_breaks_off) continue;
    std::size_t blocks = kMostBlocks;
    for (const HeldSine& sine : sweep) {
      RefuseShort(record, piece, sine, options);
      blocks = std::min(blocks, BlocksOf(sine));
    }
    const std::size_t begin = sweep.front().begin;
    experiments.push_back(
        {piece.excited.axis, piece.excited.point, begin, 0, blocks, 0.0, std::move(sweep)});
  }
  return experiments;
}

std::vector<Experiment> ExperimentsOf(const session::Recording& record, const Piece& piece,
                                      const ExperimentOptions& options) {
  const auto steps = FindSineSteps(SignalOf(record, piece));
  auto experiments = steps.empty() ? std::vector<Experiment>{Periodic(record, piece, options)}
                                   : Stepped(record, piece, steps, options);
  for (Experiment& experiment : experiments) {
    CheckRows(record, piece, experiment.end());
    experiment.speed_rad_per_s = SteadySpeed(record, experiment);
  }
  return experiments;
}

bool SameSpeed(double a, double b) {
  return std::abs(a - b) <= std::max(kStandsRadPerS, kSameSpeed * std::abs(a));
}

bool SameSines(const Experiment& a, const Experiment& b) {
  return std::ranges::equal(a.sines, b.sines, [](const HeldSine& one, const HeldSine& other) {
    return std::abs(one.cycles_per_sample / other.cycles_per_sample - 1.0) < kSameFrequency;
  });
}

void RefuseUnlike(const session::Recording& record, const Campaign& campaign) {
  const Experiment& first = campaign.experiments.front();
  for (const Experiment& e : campaign.experiments) {
    if (e.point != first.point) {
      throw BadInput(fmt::format(
          "{}: some of the excitations of {} and {} at {:.0f} rpm are added to the current and "
          "some to the reading; use one point for all axes",
          record.name, record.channels[first.axis], record.channels[e.axis],
          RadPerSToRpm(campaign.speed_rad_per_s)));
    }
    if (e.period_samples != first.period_samples) {
      throw BadInput(fmt::format(
          "{}: the excitation of {} repeats after {} samples, that of {} after {}; use one signal "
          "for all axes (0: sines held one after the other)",
          record.name, record.channels[first.axis], first.period_samples, record.channels[e.axis],
          e.period_samples));
    }
    if (!SameSines(e, first)) {
      throw BadInput(fmt::format(
          "{}: the sines of {} ({} frequencies) are not those of {} ({}); use one signal for all "
          "axes",
          record.name, record.channels[first.axis], first.sines.size(), record.channels[e.axis],
          e.sines.size()));
    }
  }
}

void RefuseIncomplete(const session::Recording& record, const Campaign& campaign) {
  std::string missing;
  for (std::size_t axis = 0; axis < record.axes(); ++axis) {
    const bool there = std::ranges::any_of(campaign.experiments,
                                           [axis](const Experiment& e) { return e.axis == axis; });
    if (!there) missing += (missing.empty() ? "" : ", ") + record.channels[axis];
  }
  if (!missing.empty()) {
    throw BadInput(fmt::format(
        "{}: {} not excited at {:.0f} rpm; a rig with {} axes needs an experiment on each",
        record.name, missing, RadPerSToRpm(campaign.speed_rad_per_s), record.axes()));
  }
  RefuseUnlike(record, campaign);
}

}  // namespace

const session::Column& SignalColumn(const session::Recording& record, std::size_t axis,
                                    SummingPoint point) {
  return point == SummingPoint::kReading ? record.excitation_m[axis] : record.excitation_a[axis];
}

std::vector<Experiment> FindExperiments(const session::Recording& record,
                                        const ExperimentOptions& options) {
  const std::vector<Piece> pieces = JoinTrains(record, FindPieces(record));
  if (pieces.empty()) {
    throw BadInput(
        record.name +
        ": no excitation in the record; run a scenario with one (amb run --scenario "
        "identify), or name its columns excitation_<channel>_a (added to the current) or "
        "excitation_<channel>_m (added to the reading)");
  }
  std::vector<Experiment> experiments;
  experiments.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    std::ranges::move(ExperimentsOf(record, piece, options), std::back_inserter(experiments));
  }
  return experiments;
}

std::vector<Campaign> GroupBySpeed(const session::Recording& record,
                                   const std::vector<Experiment>& experiments) {
  std::vector<Campaign> campaigns;
  for (const Experiment& experiment : experiments) {
    auto at = std::ranges::find_if(campaigns, [&](const Campaign& c) {
      return SameSpeed(c.speed_rad_per_s, experiment.speed_rad_per_s);
    });
    if (at == campaigns.end()) {
      campaigns.push_back({experiment.speed_rad_per_s, {}});
      at = campaigns.end() - 1;
    }
    at->experiments.push_back(experiment);
  }
  std::ranges::sort(campaigns, {}, &Campaign::speed_rad_per_s);
  for (const Campaign& campaign : campaigns) RefuseIncomplete(record, campaign);
  return campaigns;
}

}  // namespace levitas::identification
