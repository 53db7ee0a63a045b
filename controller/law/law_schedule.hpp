#pragma once
// A law over the speed of rotation: gains, filters and blocks between those of a table of speeds.
//
// The law of the file holds at rest, those of its schedule at their speeds. Between two of them
// every number of the law is on the straight line between its two values; above the last it stays.
// A pole of a filter, and a block of a state-space law, between two stable ones is stable: the
// half-plane left of the imaginary axis and the unit disc are convex. That the closed loop is
// stable between them, too, is not a matter of course: `amb margins`, `amb poles` and the gate of
// `amb design` look at every speed. An entry that is an exchange may be of any structure: below its
// speed the law before stays as it is (running_law.hpp has how one takes over from the other).
//
// Ladder     the loop runs one of kRungs fixed laws, which are made before it starts. It takes the
//            next rung when the speed has come three quarters of the way towards it, so that noise
//            of the speed does not make it change to and fro, and one rung a period at most, so
//            that a speed that jumps changes the law in kRungs periods, not in one. The loop's
//            speed is the one that its supervisor believes. Analyses use the nearest rung. An
//            exchange is taken back 3 % below its speed.
// Stretch    rungs between two exchanges: their laws are alike and share one memory.
// Bumpless   within a stretch integrators are counted in amperes of output and keep their value,
//            the derivative's memory is counted anew (ChangeLaw); the memories of filters and
//            blocks belong to states that change as little as the law does.
// Speed      of either sign, its size counts. What is no number leaves the rung as it is.
// Thread     construction allocates; all else allocates nothing, throws nothing.
// Failure    std::invalid_argument for laws that do not fit one another (WhyNoSchedule says why).

#include <cstddef>
#include <string>
#include <vector>

#include "controller/law/axis_law.hpp"
#include "controller/law/law_config.hpp"

namespace levitas::law {

/// So many laws stand for a schedule: over 6000 rpm one every 23 rpm.
inline constexpr std::size_t kRungs = 257;

/// Why no straight line leads from one law to the other, speeds and exchange aside; else empty.
[[nodiscard]] std::string WhyUnlike(const LawAtSpeed& a, const LawAtSpeed& b);

/// Why an entry of a table cannot follow the one before; empty when it can. Rest has speed 0.
[[nodiscard]] std::string WhyNotAfter(const LawAtSpeed& before, const LawAtSpeed& at);

/// Why the laws of this table cannot be a schedule; empty when they can, or when there is none.
[[nodiscard]] std::string WhyNoSchedule(const LawConfig& config);

/// The law of one speed: that of the nearest rung, without a schedule the law itself.
[[nodiscard]] LawConfig LawAt(const LawConfig& config, double speed_rad_per_s);

/// Two laws of unlike structure that change places, and how far each may act: the lower one to the
/// rung of the exchange, the upper one 3 % below it, the time that the other law listens
/// (running_law.hpp) not counted.
struct Exchange {
  LawConfig lower, upper;         ///< each alone, as it stands at the exchange
  double at_rad_per_s{};          ///< of its rung: so far the lower one acts
  double upper_from_rad_per_s{};  ///< < at_rad_per_s
};

/// Those of a table, rising; none where it has no exchange. Two exchanges less than a rung apart
/// are one, from the law below both to the law above both.
[[nodiscard]] std::vector<Exchange> Exchanges(const LawConfig& config);

/// The laws that a loop runs, in the order of speed; one without a schedule.
class LawLadder {
 public:
  explicit LawLadder(const LawConfig& config);

  [[nodiscard]] const LawCoefficients& operator[](std::size_t rung) const noexcept {
    return rungs_[rung];
  }
  [[nodiscard]] std::size_t size() const noexcept { return rungs_.size(); }
  /// For a law that starts.
  [[nodiscard]] std::size_t Nearest(double speed_rad_per_s) const noexcept;
  /// For a law that runs: `rung` or a neighbour.
  [[nodiscard]] std::size_t Next(std::size_t rung, double speed_rad_per_s) const noexcept;
  /// Whether a speed still wants the exchange of one rung for the other of another stretch that it
  /// asked for: not when it is back beyond half of what takes an exchange back. What is no number
  /// wants what was wanted.
  [[nodiscard]] bool StillAsksFor(std::size_t acting, std::size_t other,
                                  double speed_rad_per_s) const noexcept;
  /// Which stretch of alike laws a rung belongs to, counted from rest.
  [[nodiscard]] std::size_t Stretch(std::size_t rung) const noexcept { return stretches_[rung]; }

 private:
  std::vector<LawCoefficients> rungs_;
  std::vector<std::size_t> stretches_;
  double width_rad_per_s_{};  ///< from rung to rung, from rest; 0 for one rung
};

}  // namespace levitas::law
