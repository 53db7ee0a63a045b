#pragma once
// Speed and angle in another unit than their names say.
//
// Angle      turned by from row to row, over speed times period: 1 where both are right. 2 pi, 60,
//            60/2 pi (rpm, Hz, rad/s) or 180/pi (degrees, radians) to either side: a unit.
// Order      where both agree (one is made from the other, or both are wrong): readings follow the
//            rotation by unbalance and runout. Their power in step with the angle as it would be in
//            each unit, in stretches of 0.2 s; another unit is named where it has kOverOwn times
//            the power that the own one has, which must be no more than kChance of noise.
// Thread     any; pure.

#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/columns.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

void FindRotationUnit(const RigView& rig, const Columns& columns, RecordErrors& out);

}  // namespace levitas::diagnosis
