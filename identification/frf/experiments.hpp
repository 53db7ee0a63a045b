#pragma once
// Cuts a record into experiments: one axis excited by a signal that repeats (PRBS, multisine,
// impulses), or by sines held one after the other, at one speed.
//
// Point     where the signal is added: to the control current [A], or to the reading of the sensor
//           as the law gets it [m].
// Piece     rows in which one and the same axis is excited at one point; pauses up to 0.2 s belong
//           to it, and longer ones between strokes that are alike and evenly spaced.
// Periods   whole periods of the signal; what follows the last whole one is left out.
// Sines     of each the second half (`settle_share`), whole periods in two to eight blocks. A sweep
//           that begins again is an experiment of its own; one that breaks off is left out.
// Failure   BadInput, one sentence each: no excitation at all, several axes or
//           both points at once, a signal that neither repeats nor is made of sines, fewer periods
//           than needed, missing rows, rotor not levitated, a speed that changes.
// Thread    any.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "session/exchange/recording.hpp"

namespace levitas::identification {

/// Used part of a held sine: whole periods after the transient.
struct HeldSine {
  std::size_t begin{}, end{};  ///< rows of the record
  double cycles_per_sample{};
};

/// Where a test signal is added to the loop.
enum class SummingPoint : std::uint8_t { kCurrent, kReading };

struct Experiment {
  std::size_t axis{};
  SummingPoint point{};
  std::size_t begin{};           ///< first row of the first period that is used
  std::size_t period_samples{};  ///< N; 0 with held sines
  std::size_t periods{};         ///< used: dropped ones not counted; of held sines the blocks
  double speed_rad_per_s{};
  std::vector<HeldSine> sines;  ///< empty with a signal that repeats

  [[nodiscard]] std::size_t end() const noexcept {
    return sines.empty() ? begin + periods * period_samples : sines.back().end;
  }
};

struct ExperimentOptions {
  std::size_t dropped_periods{1};  ///< the transient
  std::size_t needed_periods{2};   ///< after dropping: two make a variance
  double settle_share{0.5};        ///< of a held sine: the transient
};

/// The test signal of an axis in every row [A] or [m]; empty when it was never excited there.
[[nodiscard]] const session::Column& SignalColumn(const session::Recording& record,
                                                  std::size_t axis, SummingPoint point);

/// In the order of the record.
[[nodiscard]] std::vector<Experiment> FindExperiments(const session::Recording& record,
                                                      const ExperimentOptions& options = {});

/// Experiments of one speed, all axes covered.
struct Campaign {
  double speed_rad_per_s{};
  std::vector<Experiment> experiments;
};

/// By ascending speed. BadInput when an axis is missing at a speed, or the signals differ in length
/// or in the point where they are added.
[[nodiscard]] std::vector<Campaign> GroupBySpeed(const session::Recording& record,
                                                 const std::vector<Experiment>& experiments);

}  // namespace levitas::identification
