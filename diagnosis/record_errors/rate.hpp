#pragma once
// Rows that are further apart, or nearer, than the rig's period.
//
// Times      steps of the file's time column over the rig's period, at the start and at the end of
//            the record: kOff away from 1, a clock that is scaled; different at both, one that
//            drifts. Only where the file has times (`times_s` not empty).
// Rotation   angle from row to row over speed times period (rotation_unit.hpp) is not 1, and no
//            unit makes it so: rows are so many periods apart.
// Dynamics   the plant of the rig at whole multiples and parts of its rate (plant_fit.hpp): another
//            rate is named where the law of the controller is not in the rows (some are missing, or
//            made from others), and it leaves less of the plant by kRateGain. At rest a rotor may
//            look like one that is sampled twice as often, too: if another record's rotation
//            shows a rate, that one alone is tried.
// Thread     any; pure.

#include <vector>

#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/columns.hpp"
#include "diagnosis/record_errors/law_fit.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

void FindClock(const RigView& rig, const std::vector<double>& times_s, RecordErrors& out);

/// True where the factor is so far from 1 that rows are left out or made from others: neither law
/// nor plant fit such rows. `rows_apart` is set then.
bool FindRateOfRotation(const RigView& rig, const Columns& columns, RecordErrors& out);

/// `left`: the sum over the axes of the logarithm of PlantFit::MeanSquares with the columns as
/// `out` takes them. `rows_apart`: as another record of the recorder shows, 0 where none does.
void FindRate(const RigView& rig, const Columns& columns, const std::vector<LawOfColumn>& laws,
              double left, double rows_apart, RecordErrors& out);

}  // namespace levitas::diagnosis
