#include "design/file/design_file.hpp"

#include <algorithm>

#include "configuration/text/read_file.hpp"
#include "configuration/text/writer.hpp"

namespace levitas::design {
namespace {

using namespace configuration;
using namespace configuration::unit;

constexpr std::size_t kMostBearings = 8;
constexpr std::size_t kMostModes = 98;

struct BearingShares {
  double disturbance{1.0};
  double position{1.0};
};

void DescribeShares(Visitor& v, hinf::HinfWeights& w) {
  std::vector<BearingShares> bearings(
      std::max(w.bearing_disturbance.size(), w.bearing_position.size()));
  for (std::size_t b = 0; b < bearings.size(); ++b)
    bearings[b] = {hinf::ShareOf(w.bearing_disturbance, b), hinf::ShareOf(w.bearing_position, b)};
  v.List({"bearings", 0, kMostBearings,
          "shares of each bearing, from the drive end; left out: the default ones"},
         bearings, [&v](BearingShares& shares, std::size_t) {
           v.Number({"disturbance", kOne, 1e-6, 1e6, 1, "of the disturbance"}, shares.disturbance);
           v.Number({"position", kOne, 1e-6, 1e6, 1, "of the allowed position"}, shares.position);
         });
  const hinf::HinfWeights usual;
  if (bearings.empty()) {
    w.bearing_disturbance = usual.bearing_disturbance;
    w.bearing_position = usual.bearing_position;
  } else {
    w.bearing_disturbance.clear();
    w.bearing_position.clear();
  }
  for (const BearingShares& shares : bearings) {
    w.bearing_disturbance.push_back(shares.disturbance);
    w.bearing_position.push_back(shares.position);
  }
  v.List(
      {"modes", 0, kMostModes, "each flexible mode, from the lowest; left out: the default ones"},
      w.mode_share, [&v](double& share, std::size_t) {
        v.Number({"share", kOne, 1e-6, 1e6, 1, "of what the modes may move by"}, share);
      });
  if (w.mode_share.empty()) w.mode_share = usual.mode_share;
}

/// What a law is made with and what it is judged by have these in common.
template <class Weights>
void DescribeLimits(Visitor& v, Weights& w, const Weights& usual) {
  v.Number({"noise", kMicrometre, 1e-9, 1e6, 1e6 * usual.noise_m, "of the sensors"}, w.noise_m);
  v.Number({"control", kAmpere, 1e-9, 1e6, usual.control_a, "allowed control current"},
           w.control_a);
  v.Number({"control", kHertz, 1e-6, 1e6, usual.control_hz, "up to here, falling above"},
           w.control_hz);
  v.Number({"position_rest", kMicrometre, 1e-9, 1e6, 1e6 * usual.position_rest_m,
            "allowed position at rest"},
           w.position_rest_m);
  v.Number({"position", kMicrometre, 1e-9, 1e6, 1e6 * usual.position_m, "allowed position above"},
           w.position_m);
  v.Number({"position", kHertz, 1e-6, 1e6, usual.position_hz, "from here on"}, w.position_hz);
  v.RefuseIf(w.position_rest_m > w.position_m, "position_rest_um", "must not be above position_um");
}

void Describe(Visitor& v, hinf::HinfWeights& w) {
  const hinf::HinfWeights usual;
  v.Number({"disturbance", kAmpere, 1e-9, 1e6, usual.disturbance_a, "at the control currents"},
           w.disturbance_a);
  v.Number({"disturbance", kHertz, 1e-6, 1e6, usual.disturbance_hz, "up to here, falling above"},
           w.disturbance_hz);
  v.Number({"disturbance_floor", kOne, 1e-9, 1, usual.disturbance_floor,
            "share of the disturbance that is left far above"},
           w.disturbance_floor);
  v.Number({"disc_ratio", kOne, 1e-9, 1e6, usual.disc_ratio,
            "force at the disc, as a ratio to the unbalance force at top speed"},
           w.disc_ratio);
  v.Number({"disc", kHertz, 1e-6, 1e6, usual.disc_hz, "up to here, falling above"}, w.disc_hz);
  DescribeLimits(v, w, usual);
  v.Number({"mode", kHertz, 1e-6, 1e6, usual.mode_hz, "by which a flexible mode may move"},
           w.mode_hz);
  v.Number({"speed_ratio", kOne, 0, 10, usual.speed_ratio,
            "of the top speed, covered by perturbations of the gyroscopic moments; 0: none"},
           w.speed_ratio);
  v.Number({"speed_unit", kOne, 1e-6, 1e6, usual.speed_unit, "scale of those perturbations"},
           w.speed_unit);
  v.Number({"model", kHertz, 1e-3, 1e6, usual.model_hz, "modes above are left out of the model"},
           w.model_hz);
  DescribeShares(v, w);
}

void Describe(Visitor& v, uncertainty::AnalysisWeights& w) {
  const uncertainty::AnalysisWeights usual;
  v.List({"bearings", 0, kMostBearings, "from the drive end; beyond the list: as the last"},
         w.disturbance_a, [&v](double& disturbance_a, std::size_t) {
           v.Number({"disturbance", kAmpere, 1e-9, 1e6, kRequired, "at the control current"},
                    disturbance_a);
         });
  if (w.disturbance_a.empty()) w.disturbance_a = usual.disturbance_a;
  v.Integer({"disturbance_order", 1, 20, usual.disturbance_order, "of its Chebyshev II low-pass"},
            w.disturbance_order);
  v.Number({"disturbance_attenuation_db", kOne, 1, 200, usual.disturbance_attenuation_db,
            "of the low-pass, in dB"},
           w.disturbance_attenuation_db);
  v.Number({"disturbance_edge", kHertz, 1e-3, 1e6, usual.disturbance_edge_hz, "of the low-pass"},
           w.disturbance_edge_hz);
  DescribeLimits(v, w, usual);
  v.Number({"first", kHertz, 1e-6, 1e6, usual.first_hz, "lowest frequency judged"}, w.first_hz);
  v.Number({"last", kHertz, 1e-3, 1e6, usual.last_hz, "highest frequency judged"}, w.last_hz);
  v.RefuseIf(w.first_hz >= w.last_hz, "first_hz", "must be below last_hz");
}

void Describe(Visitor& v, DesignFile& file) {
  bool synthesis = true;
  v.OptionalGroup("synthesis", "weights that the law is made with", synthesis,
                  [&] { Describe(v, file.synthesis); });
  bool analysis = true;
  v.OptionalGroup("analysis", "weights that it is judged by", analysis,
                  [&] { Describe(v, file.analysis); });
}

}  // namespace

DesignFile ParseDesign(const std::string& text, const std::string& file_name) {
  return ReadAs<DesignFile>(text, file_name, "design",
                            [](Visitor& v, DesignFile& file) { Describe(v, file); });
}

DesignFile LoadDesign(const std::string& path) { return ParseDesign(ReadText(path), path); }

std::string WriteDesign(const DesignFile& file) {
  Writer writer("design");
  DesignFile copy = file;
  Describe(writer, copy);
  return writer.text();
}

}  // namespace levitas::design
