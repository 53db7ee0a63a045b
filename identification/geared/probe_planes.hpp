#pragma once
// Which lines the probes of an elastic shaft can use, and how well they see the gear.
//
// Amplification  |r_g/x| at constant current (elastic_shaft.hpp): how many times as far as probes
//                the gear moves, under a force of the teeth that the magnet's ks answers. So many
//                times larger than at the gear are there the shares of noise and of errors in the
//                shaft's model.
// Left out       lines with more than 30 on either shaft: 1 % of error in the model is a third of
//                the gear's displacement there. Nodes move along the shaft with frequency: a
//                plane between supports loses single lines, one on a stiff support all.
//                With torsion a line goes with its mirror, whose force turns the wheels too.
// Failure        BadInput where what is left has not two speeds and the 1x lines of both gears: the
//                probe plane is named, with line and amplification. Thread any, pure.

#include <string>
#include <vector>

#include "identification/geared/full_spectrum.hpp"

namespace levitas::identification {

inline constexpr double kMostAmplification = 30.0;

/// What an identification needs of lines and these do not have, in words; empty: they are enough.
[[nodiscard]] std::string WhatLacks(const std::vector<GearedLine>& lines);

/// All lines, in their order, where no shaft is elastic. With ks of the magnets' drawing.
[[nodiscard]] std::vector<GearedLine> LinesOffNodes(const std::vector<GearedLine>& lines,
                                                    const GearedKnown& known);

/// Sets `plane` of either elastic shaft, with the ks that was found.
void TellProbePlanes(const std::vector<GearedLine>& all, const std::vector<GearedLine>& used,
                     const GearedKnown& known, GearedParameters& found);

}  // namespace levitas::identification
