#pragma once
// By how much the numbers of a rig may differ from its file: real parameters, each within bounds.
//
// Parameters  frequency [Hz] and damping ratio [1] of the first flexible modes, both planes alike;
//             ki and ks of each axis as a share of the file's [1]; of geared shafts these alone.
// Stated      +-2 Hz, +-50 % of the damping, +-5 % ki, +-5 % ks: A. Sahinkaya & J. T. Sawicki.
// Tolerances  of a rig file, three standard deviations each.
// Identified  three standard deviations of `amb identify modal`, about the rig file that it wrote.
//             BadInput when it is of another number of axes.
// Drawn       a rig with every parameter at its place between the bounds, as entries of `effects`:
//             it can be simulated, and written as a file.
// Thread      any; pure.

#include <string>
#include <vector>

#include "common/random.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::uncertainty {

enum class Kind { kModeFrequency, kModeDamping, kCurrentGain, kStiffness };

struct Parameter {
  Kind kind{};
  std::size_t index{};  ///< flexible mode (0: the first), or axis
  double nominal{};     ///< [Hz], [1]; 1 for shares
  double low{}, high{};
  /// Half of the interval.
  [[nodiscard]] double size() const noexcept { return 0.5 * (high - low); }
};

struct StatedUncertainty {
  double mode_hz{2.0};
  double damping_share{0.5};
  double current_gain{0.05};
  double stiffness{0.05};
  std::size_t modes{4};
};

[[nodiscard]] std::vector<Parameter> Stated(const configuration::RigFile& rig,
                                            const StatedUncertainty& stated);
[[nodiscard]] std::vector<Parameter> FromTolerances(const configuration::RigFile& rig,
                                                    std::size_t modes);

/// Standard deviations, of flexible modes from the first on and of axes.
struct IdentifiedDeviations {
  std::vector<double> frequency_hz;
  std::vector<double> damping_share;  ///< of the damping ratio [1]
  std::vector<double> current_gain;   ///< of ki [1]
  std::vector<double> stiffness;      ///< of ks [1]
};
[[nodiscard]] std::vector<Parameter> FromIdentification(const configuration::RigFile& rig,
                                                        const IdentifiedDeviations& found);

/// "mode 2 frequency [Hz]", "ki de_x [1]"
[[nodiscard]] std::string NameOf(const Parameter& parameter,
                                 const std::vector<std::string>& channels);

/// Uniform in -1..1 for each parameter.
[[nodiscard]] std::vector<double> DrawPlace(Random& draw, std::size_t parameters);
/// `place` has one number in -1..1 per parameter.
[[nodiscard]] configuration::RigFile At(const configuration::RigFile& rig,
                                        const std::vector<Parameter>& parameters,
                                        const std::vector<double>& place);

/// So many rigs, every parameter of each drawn by DrawPlace.
[[nodiscard]] std::vector<configuration::RigFile> DrawRigs(const configuration::RigFile& rig,
                                                           const std::vector<Parameter>& parameters,
                                                           std::size_t count, std::uint64_t seed);

}  // namespace levitas::uncertainty
