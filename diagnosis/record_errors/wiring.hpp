#pragma once
// Columns that stand for others: exchanged, reversed, in another unit, or late.
//
// Hypotheses  two columns of positions, of currents, or both exchanged; the same of whole bearings;
//             one column, both of an axis, or all currents reversed; one column of currents, or
//             all, in the unit a thousand times as large or small; one column early or late by up
//             to kMostShift rows. At most two of them, one after the other.
// Law         (law_fit.hpp) breaks: a current that follows another axis's positions or test signal,
//             pushes away from the centre, answers before it could or later than the others do.
//             A healthy record breaks nothing, whatever is wrong with the rig.
// Plant       (plant_fit.hpp) sum over the axes of the logarithm of its ratio.
// Units       of currents: only what the coils can carry, and only away from what they cannot.
// Accepted    breaks fewer and leaves less of the plant (kAgrees; a delay may leave as much); or,
//             breaking as many, leaves less by kAlone and at most kNearNoise per axis: near what a
//             rig within its tolerances leaves.
// Thread      any; pure.

#include <vector>

#include "diagnosis/record_errors/columns.hpp"
#include "diagnosis/record_errors/law_fit.hpp"
#include "diagnosis/record_errors/plant_fit.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

/// Adds what it finds to `out`, errors and uses. `elsewhere`: what the columns of other records of
/// the rig have to be taken for; taken here too where this record tells it hardly from others.
void FindWiring(const RigView& rig, const Columns& columns, const std::vector<LawOfColumn>& laws,
                const PlantFit& plant, const ColumnUses& elsewhere, RecordErrors& out);

/// What the law of a record breaks when its columns are taken so.
[[nodiscard]] int Breaks(const std::vector<LawOfColumn>& laws, const ColumnUses& uses,
                         std::size_t axes);

/// "position_de_x" and "control_current_de_x".
[[nodiscard]] std::string PositionColumn(const RigView& rig, std::size_t axis);
[[nodiscard]] std::string CurrentColumn(const RigView& rig, std::size_t axis);

}  // namespace levitas::diagnosis
