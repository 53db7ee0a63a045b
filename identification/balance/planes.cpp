#include "identification/balance/planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "common/problem.hpp"
#include "configuration/text/read_file.hpp"

namespace levitas::balancing {
namespace {

using namespace configuration;
using namespace configuration::unit;

constexpr std::size_t kMostPlanes = 20;
constexpr std::size_t kMostHoles = 360;
constexpr std::array<std::string_view, 2> kMethods{"add", "drill"};

struct PlanesText {
  std::string name;
  std::size_t method{};
  std::vector<CorrectionPlane> planes;
};

void Describe(Visitor& v, CorrectionPlane& plane) {
  v.Name({"name", "of the plane"}, plane.name);
  v.Number({"z", kMillimetre, 0, 1e5, kRequired, "from the drive end of the shaft"}, plane.z_m);
  v.Number({"radius", kMillimetre, 0.01, 1e4, kRequired, "of the weights"}, plane.radius_m);
  v.Integer({"holes", 0, kMostHoles, 0, "evenly spaced; 0: any angle"}, plane.holes);
  v.Number({"first_hole", kDegree, -360, 360, 0, "angle of the first hole"}, plane.first_hole_rad);
  v.Number({"smallest", kGram, 0, 1e5, 0, "of a weight; 0: any"}, plane.smallest_kg);
  v.Number({"largest", kGram, 0, 1e5, 0, "of a weight; 0: any"}, plane.largest_kg);
  v.RefuseIf(plane.largest_kg > 0.0 && plane.largest_kg < plane.smallest_kg, "largest_g",
             "must not be below smallest_g");
}

void Describe(Visitor& v, PlanesText& file) {
  v.Name({"name", "of the set of planes"}, file.name);
  v.Choice({"method", kMethods, "add", "drill: mass is taken away"}, file.method);
  v.List({"planes", 1, kMostPlanes, "at which a correction can be made"}, file.planes,
         [&v](CorrectionPlane& plane, std::size_t) { Describe(v, plane); });
}

std::vector<std::string> PartsOf(const std::string& text) {
  std::vector<std::string> parts{{}};
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back().push_back(c);
    }
  }
  return parts;
}

/// Length of the shaft as far as it is known.
std::optional<double> EndOf(const RigFile& rig) {
  if (!rig.plant.rotor.given) {
    double end_m = 0.0;
    for (const auto& section : rig.plant.rotor.sections) end_m += section.length_m;
    return end_m;
  }
  double end_m = 0.0;
  for (const auto& mode : rig.plant.rotor.given->modes) {
    for (const auto& point : mode.shape) end_m = std::max(end_m, point.z_m);
  }
  if (end_m == 0.0) return std::nullopt;
  return end_m;
}

}  // namespace

CorrectionPlanes ParsePlanes(const std::string& text, const std::string& file_name) {
  const auto read = ReadAs<PlanesText>(text, file_name, "balance_planes",
                                       [](Visitor& v, PlanesText& file) { Describe(v, file); });
  return {read.method == 1, read.planes};
}

CorrectionPlanes LoadPlanes(const std::string& path) { return ParsePlanes(ReadText(path), path); }

CorrectionPlane PlaneOfWord(const std::string& word) {
  const auto refuse = [&word](const std::string& why) {
    return Problem(ExitStatus::kUsage,
                   fmt::format("--plane '{}': {}; allowed NAME=Z_MM,RADIUS_MM[,HOLES"
                               "[,FIRST_HOLE_DEG[,SMALLEST_G,LARGEST_G]]]",
                               word, why));
  };
  const std::size_t equal = word.find('=');
  if (equal == std::string::npos || equal == 0) throw refuse("no name");
  const std::vector<std::string> parts = PartsOf(word.substr(equal + 1));
  if (parts.size() < 2 || parts.size() > 6 || parts.size() == 5) {
    throw refuse(fmt::format("{} numbers", parts.size()));
  }
  const std::array<Unit, 6> units{kMillimetre, kMillimetre, kOne, kDegree, kGram, kGram};
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto value = ToSi(parts[i], units[i]);
    if (!value) throw refuse(fmt::format("'{}' is no number", parts[i]));
    values[i] = *value;
  }
  if (!(values[1] > 0.0)) throw refuse("the radius must be above 0");
  if (values[2] < 0.0 || values[2] != std::floor(values[2]) ||
      values[2] > static_cast<double>(kMostHoles)) {
    throw refuse(fmt::format("holes 0 to {}", kMostHoles));
  }
  if (values[4] < 0.0 || (values[5] > 0.0 && values[5] < values[4])) {
    throw refuse("the largest weight of a hole must not be below the smallest");
  }
  return {word.substr(0, equal),
          values[0],
          values[1],
          static_cast<std::size_t>(values[2]),
          values[3],
          values[4],
          values[5]};
}

CorrectionPlanes PlanesOfRig(const RigFile& rig) {
  CorrectionPlanes made;
  for (std::size_t i = 0; i < rig.plant.unbalance.size(); ++i) {
    made.planes.push_back(
        {fmt::format("plane_{}", i + 1), rig.plant.unbalance[i].z_m, 0.0, 0, 0.0, 0.0, 0.0});
  }
  return made;
}

void CheckPlanes(const CorrectionPlanes& planes, const RigFile& rig) {
  if (planes.planes.empty()) {
    throw BadInput(
        fmt::format("rig {} names no planes with unbalance: say where weights can go, with --plane "
                    "NAME=Z_MM,RADIUS_MM or --planes FILE",
                    rig.numbers.name));
  }
  const auto end_m = EndOf(rig);
  for (std::size_t i = 0; i < planes.planes.size(); ++i) {
    const CorrectionPlane& plane = planes.planes[i];
    if (plane.z_m < 0.0 || (end_m && plane.z_m > *end_m + 1e-9)) {
      throw BadInput(
          fmt::format("plane {}: z = {:.6g} mm is not on the shaft of rig {}, allowed 0 to "
                      "{:.6g} mm",
                      plane.name, 1e3 * plane.z_m, rig.numbers.name, 1e3 * end_m.value_or(0.0)));
    }
    for (std::size_t other = 0; other < i; ++other) {
      if (planes.planes[other].name == plane.name) {
        throw BadInput(fmt::format("two planes are named {}: give each its own name", plane.name));
      }
      if (std::abs(planes.planes[other].z_m - plane.z_m) < 1e-4) {
        throw BadInput(
            fmt::format("planes {} and {} are at one place, z = {:.6g} mm: leave one out",
                        planes.planes[other].name, plane.name, 1e3 * plane.z_m));
      }
    }
  }
}

}  // namespace levitas::balancing
