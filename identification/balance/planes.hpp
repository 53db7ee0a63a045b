#pragma once
// The planes of a rotor at which a correction can be made, from a file or from the command line.
//
// File      kind: balance_planes, strict as every file of the program (configuration/), example:
//             kind: balance_planes
//             name: disc_and_sleeves
//             method: add                      # or drill: mass is taken away
//             planes:
//               - {name: disc, z_mm: 299.2, radius_mm: 30, holes: 12, first_hole_deg: 0,
//                  smallest_g: 0.05, largest_g: 2}
// Word      NAME=Z_MM,RADIUS_MM[,HOLES[,FIRST_HOLE_DEG[,SMALLEST_G,LARGEST_G]]], the same in short.
// Angles    in the direction of rotation, from where the rotor's own x axis stands at angle 0.
// Units     SI in the struct. Thread: any.
// Failure   BadInput with every problem of the file; a usage Problem for a word.

#include <cstddef>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::balancing {

struct CorrectionPlane {
  std::string name;
  double z_m{};
  double radius_m{};
  std::size_t holes{};  ///< evenly spaced; 0: any angle
  double first_hole_rad{};
  double smallest_kg{};  ///< per hole; 0: any
  double largest_kg{};   ///< per hole; 0: any
};

struct CorrectionPlanes {
  bool drill{};
  std::vector<CorrectionPlane> planes;
};

[[nodiscard]] CorrectionPlanes LoadPlanes(const std::string& path);
[[nodiscard]] CorrectionPlanes ParsePlanes(const std::string& text, const std::string& file_name);
[[nodiscard]] CorrectionPlane PlaneOfWord(const std::string& word);

/// The rig file's own: its unbalance masses, with a radius of 0 (moments only).
[[nodiscard]] CorrectionPlanes PlanesOfRig(const configuration::RigFile& rig);

/// Names that are one, places off the shaft, largest masses below smallest: BadInput.
void CheckPlanes(const CorrectionPlanes& planes, const configuration::RigFile& rig);

}  // namespace levitas::balancing
