#pragma once
// Whether a law may be used: checks that share no line with the synthesis or its search.
//
// 1 Poles   of the sampled loop with exact delay (analysis/sensitivity.hpp), at speeds from rest to
//           `over_speed` times the rated speed, of the file's rig and of drawn corners.
// 2 |S|     on bracketed peaks, the same loops; the limit is the zone's of ISO 14839-3 for the
//           file's rig; for the corners one that is given.
// 3 mu      an upper bound with real perturbations (design/uncertainty/mixed_mu.hpp) on a dense
//           grid; local maxima of the bound with complex ones are bracketed until neighbours differ
//           by less than 1 %; told, and a limit when `mu` is given.
// 4 Rigs    drawn from the uncertainty, simulated with contact, saturation, noise: none is lost.
//           With `tolerances` everything else that the file states is drawn too
//           (design/drawn_rigs/healthy_rig.hpp), and poles and |S| of each rig are judged.
// 5 Speed   of a law over speed: poles at every law that the loop may run (law_schedule.hpp), |S|
//           five times as dense, where laws change places both of them as far as either may act,
//           and a run-up and run-down of the file's rig at its drive's rate.
// Accepted  the first, the second, the fourth and the fifth pass, the third where asked.
// Worst     the drawn rig with the largest orbit, or the first that was lost, as a rig file.
// Thread    that of the caller; the same seed gives the same answer.

#include <functional>
#include <optional>
#include <string>

#include "design/gate/drawn_runs.hpp"
#include "design/uncertainty/uncertain_plant.hpp"

namespace levitas::design {

struct GateOptions {
  double step_rad_per_s{52.35987755982988};  ///< between speeds: 500 rpm
  double over_speed{1.1};
  std::size_t corners{8};
  std::size_t draws{20};
  std::uint64_t seed{1};
  double sensitivity{4.0};                   ///< upper edge of zone B
  std::optional<double> corner_sensitivity;  ///< of the corners; told only without it
  std::optional<double> mu;
  bool tolerances{};
  double third_n{};  ///< of WithThirdHarmonic, in the drawn runs
  std::vector<double> run_speeds_rad_per_s;
  uncertainty::AnalysisWeights weights;
};

struct Peak {
  double value{}, hz{}, speed_rad_per_s{};
};

struct DrawnSpeed {
  double speed_rad_per_s{};
  std::size_t lost{};
  std::vector<double> worst_orbit_m;   ///< per bearing, of the rigs that were not lost
  std::vector<double> median_orbit_m;  ///< per bearing
};

struct GateResult {
  bool accepted{};
  std::string reason;  ///< the limit that failed; empty when accepted
  double pole_modulus{};
  double pole_speed_rad_per_s{};
  std::size_t loops{};      ///< judged by poles
  Peak sensitivity;         ///< of the file's rig, any axis
  Peak corner_sensitivity;  ///< of the corners
  Peak singular;            ///< largest singular value of S, the file's rig
  Peak mu;                  ///< real perturbations
  Peak mu_complex;          ///< were they complex
  std::vector<DrawnSpeed> drawn;
  std::size_t rigs{};
  Peak drawn_sensitivity;  ///< of the drawn rigs, with `tolerances`
  std::optional<configuration::RigFile> worst;
  std::size_t rungs{};               ///< laws of a schedule whose poles were judged
  std::size_t exchanges{};           ///< of laws that change places, both judged beyond it
  std::optional<RunFigures> run_up;  ///< of a schedule
};

[[nodiscard]] GateResult Judge(const configuration::RigFile& rig, const law::LawConfig& law,
                               const std::vector<uncertainty::Parameter>& parameters,
                               const GateOptions& options,
                               const std::function<void(double, const std::string&)>& progress);

/// At rest, and from a tenth of the rated speed up in steps of a twentieth: close enough to meet
/// the resonances of a rotor with once and three times the speed.
[[nodiscard]] std::vector<double> RunSpeeds(double rated_rad_per_s);

/// The runs alone: `drawn`, `rigs`, `worst`, and `reason` when a rig is lost.
[[nodiscard]] GateResult RunDrawnRigs(const configuration::RigFile& rig, const law::LawConfig& law,
                                      const std::vector<uncertainty::Parameter>& parameters,
                                      const GateOptions& options);

struct MuPeaks {
  Peak of_real, of_complex;
};

/// The peaks of mu at one speed, neighbours of each maximum bracketed.
[[nodiscard]] MuPeaks MuPeakAt(const configuration::RigFile& rig, const law::LawConfig& law,
                               const std::vector<uncertainty::Parameter>& parameters,
                               const uncertainty::AnalysisWeights& weights, double speed_rad_per_s);

}  // namespace levitas::design
