#pragma once
// Cuts a record into experiments: one axis excited by a signal that repeats, at one speed.
//
// Piece     rows in which one and the same axis is excited; pauses up to 0.2 s (between the strokes
//           of an impulse train) belong to it.
// Periods   whole periods of the signal; what follows the last whole one is left out.
// Failure   BadInput, one sentence each: no excitation at all, several axes at once, a signal that
//           does not repeat, fewer periods than needed, missing rows, rotor not levitated, a speed
//           that changes.
// Thread    any.

#include <cstddef>
#include <vector>

#include "identification/record/record.hpp"

namespace levitas::identification {

struct Experiment {
  std::size_t axis{};
  std::size_t begin{};           ///< first row of the first period that is used
  std::size_t period_samples{};  ///< N
  std::size_t periods{};         ///< used: dropped ones not counted
  double speed_rad_per_s{};

  [[nodiscard]] std::size_t end() const noexcept { return begin + periods * period_samples; }
};

struct ExperimentOptions {
  std::size_t dropped_periods{1};  ///< the transient
  std::size_t needed_periods{2};   ///< after dropping: two make a variance
};

/// In the order of the record.
[[nodiscard]] std::vector<Experiment> FindExperiments(const Record& record,
                                                      const ExperimentOptions& options = {});

/// Experiments of one speed, all axes covered.
struct Campaign {
  double speed_rad_per_s{};
  std::vector<Experiment> experiments;
};

/// By ascending speed. BadInput when an axis is missing at a speed or the signals differ in length.
[[nodiscard]] std::vector<Campaign> GroupBySpeed(const Record& record,
                                                 const std::vector<Experiment>& experiments);

}  // namespace levitas::identification
