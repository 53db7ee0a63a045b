#pragma once
// Speed and angle in another unit than their names say.
//
// Angle      turned by from row to row, over speed times period: 1 where both are right. 2 pi, 60,
//            60/2 pi (rpm, Hz, rad/s) or 180/pi (degrees, radians) to either side: a unit.
//            An angle of degrees taken for radians turns by several turns from row to row: there
//            the unit is the one with which angles, wrapped at 2 pi, go on as the speed says.
// Order      where both agree (one is made from the other, or both are wrong): readings follow the
//            rotation by unbalance and runout. Their power in step with the angle as it would be in
//            each unit, in stretches of 0.2 s; another unit is named where it has kOverOwn times
//            the power that the own one has: kStrong of all, or kLine and kOverBeside
//            times what speeds about it have.
// Thread     any; pure.

#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/columns.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

/// Angle turned by over the speed's integral: median of blocks of 50 rows, so that rows which are
/// left out now and then do not count. 0: nothing turns.
[[nodiscard]] double AngleOverSpeed(const Columns& columns, double period_s);

void FindRotationUnit(const RigView& rig, const Columns& columns, RecordErrors& out);

}  // namespace levitas::diagnosis
