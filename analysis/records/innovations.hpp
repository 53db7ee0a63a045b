#pragma once
// Where a model departs from a recorded session: its one-step-ahead innovations in time, in
// spectrum and in orders of rotation, as multiples of what the sensors' own noise explains.
//
// Multiple   rms of the innovation / rms of one reading's noise (noise and quantisation).
// Expected   what a right model would give: the Kalman filter's own innovation covariance, white.
// Band       rms within the band / expected rms within it.
// Order      k x rotation: e^{-j k angle} averaged over windows of the record (Hann), so that a
//            line is followed through a run-up; amplitude / what white noise leaves in such a
//            window.
// Excitation coherence with the recorded test signals / what chance gives. A right model has used
//            all that the excitation does, so whatever follows it is the model's own error, far
//            below the noise too.
// Window     rms over a piece of time / expected rms.
// Share      part of the channel's unexplained power (measured minus expected) found there.
// Gaps       the observer restarts after each; its transient is left out. Samples while the rotor
//            is not levitated (amplifiers off, in the touchdown bearings) are left out too.
// Thread     any.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "analysis/records/observer.hpp"

namespace levitas::analysis {

struct RecordedRow {
  std::uint64_t cycle{};
  bool levitated{};  ///< only such rows are compared
  RecordedSample sample;
  AxisArray excitation_a{};  ///< the part of the command that is a test signal
  /// As measured, towards + and away, axis by axis; `coils` of them, none where there is no probe.
  std::array<double, 2 * kMaxAxes> coil_current_a{};
  std::uint32_t coils{};
};

struct InnovationRow {
  std::uint64_t cycle{};
  double speed_rad_per_s{};
  double angle_rad{};
  AxisArray innovation_m{};
  AxisArray excitation_a{};
};

struct InnovationRun {
  double period_s{};
  std::uint64_t first_cycle{};                     ///< of the record: times are counted from here
  std::vector<std::vector<InnovationRow>> pieces;  ///< uninterrupted, transients left out
  std::uint64_t settling_rows{};                   ///< left out: the observer was settling
  std::uint64_t idle_rows{};                       ///< left out: not levitated
  std::uint64_t gaps{};                            ///< in the cycle count
  AxisArray unknown_force_n{};                     ///< mean over the compared rows, per axis
  [[nodiscard]] std::uint64_t rows() const noexcept;
};

/// Drives `plant` through the rows. `settling_s` after every (re)start is left out.
[[nodiscard]] InnovationRun RunObserver(const plant::PlantConfig& plant,
                                        std::shared_ptr<const ObserverGain> gain,
                                        const std::vector<RecordedRow>& rows, double settling_s);

struct BandReport {
  double low_hz{}, high_hz{};
  double ratio{};
  double share{};
};

struct ExcitationReport {
  double low_hz{}, high_hz{};
  double ratio{};   ///< mean squared coherence over all test signals / chance
  double sigmas{};  ///< how far beyond chance, in standard deviations of chance
  double share{};   ///< of the channel's whole power, that follows the excitation
};

struct OrderReport {
  int order{};
  double amplitude_m{};  ///< rms over the windows of the line's amplitude
  double ratio{};
  double share{};
};

struct WindowReport {
  double start_s{}, end_s{};  ///< from the start of the record
  double speed_rad_per_s{};   ///< mean
  double ratio{};
};

struct ChannelReport {
  double rms_m{}, peak_m{};
  double multiple{};           ///< rms / sensor noise
  double expected_multiple{};  ///< the same for a right model
  double lag_one{};            ///< correlation of neighbouring innovations, 0 when white
  double dominant_hz{};        ///< strongest line of the spectrum
  double dominant_ratio{};     ///< its density / expected density
  std::vector<BandReport> bands;
  std::vector<ExcitationReport> excitation;  ///< empty when nothing was excited
  std::vector<OrderReport> orders;           ///< empty without rotation
  std::vector<WindowReport> windows;
  std::vector<double> density_m2_per_hz;
};

/// One place where more is left than noise explains, for ranking. A band through which a departing
/// order of rotation runs is not named a second time.
struct Departure {
  std::size_t channel{};
  std::string place;  ///< "1x of rotation", "200-400 Hz", "0.80-1.00 s"
  double ratio{};
  double share{};
};

struct InnovationReport {
  double duration_s{};
  double line_spacing_hz{};
  std::vector<ChannelReport> channels;
  /// The most unexplained power first, in units of each channel's noise; see kDepartureRatio.
  std::vector<Departure> departures;
};

/// A place counts as a departure from this multiple of what is expected there.
inline constexpr double kDepartureRatio = 1.5;
/// Coherence with the excitation counts from this many standard deviations of chance.
inline constexpr double kDepartureSigmas = 6.0;

/// Throws BadInput when the run holds too few rows for a spectrum.
[[nodiscard]] InnovationReport Examine(const InnovationRun& run, const ObserverGain& gain,
                                       std::size_t axes);

}  // namespace levitas::analysis
