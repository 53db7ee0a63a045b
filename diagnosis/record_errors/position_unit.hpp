#pragma once
// Columns of positions in another unit than their names say, by the noise of their readings.
//
// Noise      rms of fourth differences over sqrt(70), which white noise of one reading makes alone:
//            what a rotor moves by within a few samples hardly counts. Over that of the rig's
//            sensor (noise and converter).
// Unit       a factor 1000 or 10^6 to either side, where it brings the noise nearer to the sensor's
//            and at least kFar off now: healthy and noisy sensors stay within a factor of thirty.
// Thread     any; pure.

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/rig_view.hpp"
#include "diagnosis/record_errors/record_error.hpp"

namespace levitas::diagnosis {

void FindPositionUnits(const RigView& rig, const Record& record, RecordErrors& out);

}  // namespace levitas::diagnosis
