#pragma once
// What the positions of a window should be, given the currents of that window: the equations that
// the unbalance is fitted by.
//
// Equation   The free rotor on its magnets is unstable, and y = P(jw) i + H(jw) U asks the model
//            for a response next to its own weakly damped poles. Instead the measured position is
//            fed back through an observer's gain L, which changes nothing where the model is right:
//              x = Z^-1 (B d(jw) i + L (y - R) + H (w^2 - j w') U),  Z = jw - A0 - w A1 + L C
//              r = (y - R) - C x + C Z^-1 x',    d(s) = e^{-s(delay + T/2)} sinh(sT/2)/(sT/2)
//            r is white sensor noise when everything is right. x' is how fast the amplitude changes
//            along the run-up; Z has fast poles alone, so one term of it is enough.
// Curved     the first harmonic of the magnets' true force at the fitted motion, less its slopes,
//            acts as one more known force.
// Added      what is known to have been added to the rotor before a run goes with its U.
// Linear     in U [kg m] and in the run-out R [m], one per probe: r = first column + the others
//            times (U, R).
// Weight     what the noise of a reading becomes, W = 1 - C Z^-1 L, and forces of the magnets that
//            the linear model misses, a share of ki i and ks y:
//            covariance 4 d^2/N W W^H + sum_a (share f_a)^2 g_a g_a^H, g_a = C Z^-1 b_a. The
//            equations come divided by its root: each real and imaginary part has unit variance.
// Feedback   the law answers the probes' noise, so currents and r share it, and a fit of the rig to
//            them leans towards P = -1/C. What is differentiated by the rig's unknowns is therefore
//            what the model answers with the law that the windows beside show, which share no
//            sample with it: an instrument (L. Ljung, System Identification, 2nd ed., 7.6). At the
//            place of Refer r is that of the data.
// Thread     any; pure after construction; allocates.

#include <Eigen/Core>
#include <vector>

#include "analysis/records/order_track.hpp"
#include "identification/balance/balance_rig.hpp"

namespace levitas::balancing {

/// How an amplitude commanded reaches the coils' amplifiers.
[[nodiscard]] std::complex<double> DelayAndHold(double speed_rad_per_s, double delay_s,
                                                double period_s);

/// A run-up, and what had been added to the rotor by then [kg m], one per plane of the rig.
struct TrackedRun {
  std::vector<analysis::TrackedWindow> windows;
  Eigen::VectorXcd added_kg_m;
};

/// One window: 2 axes equations (of complex numbers: axes) in the unknown amplitudes.
struct WindowEquations {
  Eigen::MatrixXcd linear;  ///< axes x (1 + planes + axes), weighted
  Eigen::MatrixXcd slopes;  ///< axes x unknowns of the rig, weighted; when asked for
};

class Predictor {
 public:
  Predictor(const BalanceRig& rig, const std::vector<TrackedRun>& runs);

  [[nodiscard]] const std::vector<analysis::TrackedWindow>& windows() const { return windows_; }
  [[nodiscard]] Eigen::Index amplitudes() const { return rig_.planes() + rig_.axes(); }
  [[nodiscard]] const BalanceRig& rig() const { return rig_; }

  /// Takes what noise adds to r, and the magnets' curved force, from the rig at `place`.
  void Refer(const Eigen::VectorXd& place, const Eigen::VectorXcd& amplitudes);
  [[nodiscard]] std::vector<WindowEquations> At(const Eigen::VectorXd& place) const;
  /// With the slopes of r by each unknown of the rig, at the amplitudes given.
  [[nodiscard]] std::vector<WindowEquations> At(const Eigen::VectorXd& place,
                                                const Eigen::VectorXcd& amplitudes) const;

 private:
  struct Response;
  struct Amplitudes {
    Eigen::VectorXcd position_m, current_a;
  };
  /// Windows beside, on both sides, that share no sample with this one.
  [[nodiscard]] std::vector<std::size_t> Near(std::size_t k) const;
  /// A parabola through them.
  [[nodiscard]] Amplitudes FromNeighbours(std::size_t k) const;
  /// The law that they show, axis by axis [A/m].
  [[nodiscard]] Eigen::VectorXcd LawNear(std::size_t k) const;
  /// What the model answers with that law.
  [[nodiscard]] Amplitudes FromModel(const RigMatrices& rig, const Response& response,
                                     std::size_t k, const Eigen::VectorXcd& amplitudes) const;
  [[nodiscard]] std::vector<Eigen::MatrixXcd> Rows(const RigMatrices& rig,
                                                   const std::vector<Response>& responses,
                                                   const std::vector<Amplitudes>& data) const;
  /// At the amplitudes given and what was added.
  [[nodiscard]] Eigen::VectorXcd StatesOf(const Response& response, std::size_t k,
                                          const Eigen::VectorXcd& amplitudes) const;
  [[nodiscard]] bool AreNeighbours(std::size_t before, std::size_t after) const;
  [[nodiscard]] std::vector<Response> Respond(const RigMatrices& rig,
                                              const std::vector<Amplitudes>& data) const;
  [[nodiscard]] std::vector<WindowEquations> Equations(
      const RigMatrices& rig, const std::vector<Response>& responses) const;
  void ChooseGain();
  void ChooseWeights();

  const BalanceRig& rig_;
  std::vector<analysis::TrackedWindow> windows_;
  std::vector<Eigen::VectorXcd> added_kg_m_;  ///< per window
  std::vector<std::size_t> run_;              ///< per window
  std::vector<Amplitudes> measured_, smooth_;
  std::vector<Eigen::VectorXcd> curved_n_;              ///< force of each magnet beyond its slopes
  std::vector<Eigen::VectorXcd> measured_less_smooth_;  ///< r of both, at the place referred to
  Eigen::MatrixXd gain_;                                ///< L
  std::vector<Eigen::MatrixXcd> weight_;                ///< per window, axes x axes
};

}  // namespace levitas::balancing
