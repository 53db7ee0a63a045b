#pragma once
// Refuses records whose numbers cannot be in the units that their columns say: a fit would turn
// them into a rig that nobody has.
//
// Readings   of an axis scatter (standard deviation in flight) by less than kSilent of what noise
//            and converter of its sensor make alone.
// Currents   of all axes stay below kNoCurrent of the bias current (rms while amplifiers are on):
//            no magnet carries a rotor with that. Or those of one axis are kFarBeyond times what
//            its coils can take (rms).
// Not here   readings beyond the touchdown clearance all the time (levitated_interval.hpp finds
//            no levitated interval); what is odd but possible (input_warnings.hpp).
// Failure    BadInput: file, found, allowed, remedy. Thread: any; pure.

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

inline constexpr double kSilent = 0.1;      ///< of the sensor's noise
inline constexpr double kNoCurrent = 1e-3;  ///< of the bias current
inline constexpr double kFarBeyond = 5.0;   ///< of the largest coil current

void RefuseWrongUnits(const RigView& rig, const Record& record);

}  // namespace levitas::diagnosis
