#pragma once
// What is asked of a PID design, each with a name and a limit, and how far a law is from it.
//
// Ratio     found/limit; where more is better limit/found above the limit, 2 - found/limit below:
//           1 at the limit, larger when it is not met.
// Peaks     |S|, |T|, |C S| of an axis, singular value of S: largest over the nominal plants, one a
//           speed; |S| of the corners of the uncertainty has a limit of its own.
// Damping   least of all plants' oscillating poles, corners included.
// Standing  three standard deviations of the motion that noise makes, any axis.
// Spinning  the same and the orbit of UnbalanceResponse.
// Current   static, harmonics' amplitude and three standard deviations of noise, of the worst axis
//           each; noise alone has a limit of its own: what it fills of the range is lost to others.
// Stiffness ki Kp - ks of the softest axis, of channels the least eigenvalue of ki R Kp M - ks:
//           against a step of force, before the integrator has it.
// Compliance  what a force at a magnet moves there, largest over frequency. A rig that stands
//           without control is asked for a fifth of what it has then, and its search weighs a
//           fiftieth like |S| at its limit: else no law at all would have the largest margin.
// Any mode  damping ratio that a flexible mode of the rotor's mass would need of its own, wherever
//           its frequency: -ki Im(C A)/(2 m w^2), A amplifier, sensor, delay and hold. Sensor and
//           magnet are taken to lie on the same side of its nodes.
// Units     SI, in the names. Thread: any; pure after construction.

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "design/pid/unbalance_response.hpp"

namespace levitas::design {

enum class Limit : std::size_t {
  kSensitivity,
  kCornerSensitivity,
  kComplementary,
  kControl,
  kSingular,
  kDamping,
  kStanding,
  kSpinning,
  kCurrent,
  kNoise,
  kStiffness,
  kCompliance,
  kAnyMode
};
inline constexpr std::size_t kLimits = 13;

struct PidLimits {
  /// In the order of Limit; empty: not asked.
  std::array<std::optional<double>, kLimits> at{};
  /// Compliance that weighs as much as |S| at its limit; 0: none.
  double stiffen_to_m_per_n{};
  [[nodiscard]] std::optional<double>& operator[](Limit limit) {
    return at[static_cast<std::size_t>(limit)];
  }
  [[nodiscard]] const std::optional<double>& operator[](Limit limit) const {
    return at[static_cast<std::size_t>(limit)];
  }
};

/// |S| 3 (zone A), 4 at corners, |T| 3, singular value 4, damping 0.15 % (or 0.4 of the rig's
/// own, where that is less), the rig's objectives, the law's current and a
/// quarter of it for noise.
[[nodiscard]] PidLimits UsualLimits(const configuration::RigFile& rig, double current_limit_a);

struct Met {
  double found{}, ratio{}, hz{}, speed_rad_per_s{};
};

struct PidFigures {
  int growing{};    ///< poles, of all plants
  double margin{};  ///< what a search makes small: the largest ratio of |S|, |T|, singular value of
                    ///< S and, with `stiffen_to_m_per_n`, compliance
  std::array<Met, kLimits> met{};
  [[nodiscard]] const Met& operator[](Limit limit) const {
    return met[static_cast<std::size_t>(limit)];
  }
  [[nodiscard]] Met& operator[](Limit limit) { return met[static_cast<std::size_t>(limit)]; }
};

/// A plant to be held, and whether it is one of the rig file or of a corner.
struct PlantToHold {
  std::shared_ptr<const SampledPlant> plant;
  bool nominal{true};
};

class PidJudge {
 public:
  /// With coordinates a law has one entry per channel, and plants have the same coordinates.
  PidJudge(const configuration::RigFile& rig, const PidLimits& limits, double third_n,
           const Coordinates& coordinates = {});

  [[nodiscard]] PidFigures Of(const law::LawConfig& law,
                              const std::vector<PlantToHold>& plants) const;
  [[nodiscard]] const PidLimits& limits() const noexcept { return limits_; }

 private:
  [[nodiscard]] Met AnyMode(const std::vector<law::DiscreteLaw>& laws) const;

  [[nodiscard]] double SoftestAxis(const law::LawConfig& law, const SampledPlant& plant) const;

  PidLimits limits_;
  Coordinates coordinates_;
  std::vector<double> noise_m_;
  /// ki A/(2 m w^2) of each axis on a grid, for AnyMode.
  struct Unknown {
    double hz{};
    std::complex<double> q;
    std::vector<std::complex<double>> chain;
  };
  std::vector<Unknown> unknown_;
  UnbalanceResponse unbalance_;
};

/// The largest ratio, and whose it is.
[[nodiscard]] Limit Limiting(const PidFigures& figures);
/// "|S| of an axis"
[[nodiscard]] std::string NameOf(Limit limit);
/// "2.41", "0.32 %", "31.2 um"
[[nodiscard]] std::string ValueText(Limit limit, double value);
/// "|S| of an axis 2.41 (limit 2.40) at 212.1 Hz, 6000 rpm"
[[nodiscard]] std::string MetText(Limit limit, const Met& met, double allowed);

}  // namespace levitas::design
