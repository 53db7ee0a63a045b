#pragma once
// Frequency response of a rig that only lives in closed loop: P = G Q^-1.
//
// Equation   with axis j excited by e_j (periodic, or sines held one after the other), Y = G E and
//            U = Q E line by line; every column of G and Q from its own experiment; P = G Q^-1
//            (Sahinkaya & Sawicki; any stabilising controller, linear or not known, drops out).
// Sensitivity  of the sum behind the point where the signal is added, over the signal. With the
//            law u = -C y_law, all axes levitated:
//              added to the current, u = -C y + e:  S = U E^-1 = Q       = (I + C P)^-1   [A/A]
//              added to the reading, u = -C (y + e), y as recorded, without the signal:
//                                                   S = (Y + E) E^-1 = I + G = (I + P C)^-1  [m/m]
//            S_ii of both are the same where C has no cross terms: C S_reading = S_current C.
// Leakage    none: spectra over whole periods of the signal, after the transient; what turns with
//            the rotor is removed first (synchronous.hpp) and lines next to its orders are left
//            out. Sines that are held have a settling time instead (experiments.hpp); a transient
//            that is not over then scatters over the blocks, and is in the variance.
// Noise      r = dY - P dU per period, the part that does not repeat: its covariance over the
//            periods and over 21 neighbouring lines (it is smooth there; 5 held sines) gives
//            var P_ik = sum_j C_j,ii |Q^-1_jk|^2 / (M |E_j|^2), E|P - P_true|^2 of a complex entry.
//            What repeats (nonlinearity) is no noise and is not in it. The variance of S_ii from
//            the scatter of its own sum follows |S_ii|^2 within those lines: noise that the loop
//            reads is multiplied by S_ii before it is recorded.
// Coherence  |sum Y_m|^2 / (M sum |Y_m|^2) of position i with the excitation of axis j.
// Units      P [m/A], from the command of a sample to the position read at the sample: delay, hold,
//            amplifier and sensor are part of P.
// Thread     any. Failure: BadInput, see experiments.hpp and checks.hpp.
// Not done   axes excited together; whether a signal added to the reading is recorded with the
//            right sign (that of one added to the current is checked, checks.hpp).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/frf/experiments.hpp"

namespace levitas::identification {

/// How far each axis moved about its mean in each experiment: rows by axis, columns by the axis
/// that was excited; means of squares and of the product.
struct Moments {
  Eigen::MatrixXd current_square_a2;   ///< of what passes the amplifier
  Eigen::MatrixXd position_square_m2;  ///< as read
  Eigen::MatrixXd product_a_m;
};

struct FrequencyResponse {
  double speed_rad_per_s{};
  SummingPoint point{};
  double period_s{};  ///< of sampling
  std::vector<std::string> channels;
  std::vector<double> frequency_hz;
  std::vector<Eigen::MatrixXcd> plant;        ///< per line, outputs x inputs [m/A]
  std::vector<Eigen::MatrixXcd> currents;     ///< Q, per line [1] or [A/m]
  std::vector<Eigen::MatrixXcd> sensitivity;  ///< S, per line [1]
  std::vector<Eigen::MatrixXd> variance;      ///< of `plant` [m^2/A^2]
  std::vector<Eigen::MatrixXd> coherence;     ///< [1]
  std::vector<Eigen::MatrixXd> noise;         ///< variance of G - P Q, as measured [m^2/A^2] or [1]
  std::vector<Eigen::VectorXd> own_variance;  ///< of S_ii, complex, from its scatter [1]
  Moments moments;
  std::vector<double> left_out_hz;  ///< lines next to an order of rotation
  std::size_t periods{};            ///< averaged, least of all experiments
  double largest_orbit_m{};         ///< radius about the mean at any bearing, in any experiment
  double largest_current_a{};       ///< |control current| of any axis

  [[nodiscard]] Eigen::Index axes() const noexcept {
    return static_cast<Eigen::Index>(channels.size());
  }
};

struct ResponseOptions {
  double highest_hz{5000.0};  ///< lines beyond it are left out
  int orders{5};              ///< of rotation that are removed
  double amplifier_hz{0.0};   ///< bandwidth, for the moments only; 0: without limit
};

[[nodiscard]] FrequencyResponse EstimateResponse(const session::Recording& record,
                                                 const Campaign& campaign,
                                                 const ResponseOptions& options = {});

/// Everything from a record: cuts it, checks it, estimates one response per speed.
[[nodiscard]] std::vector<FrequencyResponse> EstimateResponses(
    const session::Recording& record, double delay_s,
    const ExperimentOptions& experiment_options = {}, const ResponseOptions& options = {});

}  // namespace levitas::identification
