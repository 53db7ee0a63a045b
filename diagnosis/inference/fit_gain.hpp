#pragma once
// Whether causes make the model fit the records better than chance would.
//
// Why       evidence is a sum over all samples and takes them as independent. A cause that fits
//           a peculiarity of a few stretches gains as many nats as one that helps everywhere; only
//           the scatter of its gain from stretch to stretch tells them apart.
// Gain      sum over blocks of 0.05 s of the squared whitened innovations of the calibrated model
//           minus those of the extended one, with its standard deviation from the paired
//           differences of the blocks, plus what the causes let calibrated numbers come back in
//           squared tolerances: a fault that calibration had absorbed fits no better when it is
//           named, but the rig is near its file again.
// Thread    GainedFit: any; pure. DropUngained blocks the caller, every processor inside.

#include <vector>

#include "diagnosis/inference/record_landscape.hpp"

namespace levitas::diagnosis {

/// Rows of a block of 0.05 s.
[[nodiscard]] std::size_t BlockRows(const RigView& rig);

/// In squared whitened innovations: twice as many as nats.
struct FitGain {
  double value{};
  double deviation{};
};

/// From the differences of paired blocks; the deviation is zero below two of them.
[[nodiscard]] FitGain GainOfBlocks(const std::vector<double>& blocks);

/// `rows` of a block; samples that count.
[[nodiscard]] FitGain GainedFit(const std::vector<Trajectory>& first,
                                const std::vector<Trajectory>& second, const Whitener& whitener,
                                std::size_t rows);

/// Squared tolerances by which calibrated numbers came back, those that a cause moves included.
[[nodiscard]] double CameBack(const std::vector<Term>& terms, const std::vector<double>& calibrated,
                              const std::vector<double>& extended,
                              const std::vector<Hypothesis>& causes);

/// Drops all causes when they gain less than `gain_deviations` of their gain's deviation.
void DropUngained(RecordLandscape& landscape, const Judging& judging, CauseSelection& found);

}  // namespace levitas::diagnosis
