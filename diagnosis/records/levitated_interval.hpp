#pragma once
// Rows in which the rotor flies free: a model without contact can answer for no others.
//
// Contact    the reading of a bearing is beyond kFree of the touchdown clearance, or all control
//            currents are exactly zero (amplifiers off: a controller with noisy sensors does not
//            ask for that), kOff rows in a row.
// Margin     kMargin before and after belongs to it: the blow, and what the lift still swings.
// Way        from a contact on, and back from it, the rotor is lifted or lowered until the middle
//            of its orbit, a mean over kMargin, is within kHome of the clearance: there the magnets
//            are far from where they are linear, and 200 ms of it outweigh a minute of flight. A
//            rotor whose place is farther out has no such way: most rows would be left out.
// Lift       what a lift still swings, and an observer that starts in it, needs kLift to settle. A
//            session says by its mode where that ends; rows that are all called levitated do not.
// Why        imported records do not say when the rotor was lifted and landed.
// Thread     any; pure.

#include <vector>

#include "analysis/records/innovations.hpp"
#include "diagnosis/model/model_run.hpp"
#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

inline constexpr double kFree = 0.5;     ///< of the clearance
inline constexpr double kHome = 0.2;     ///< of the clearance
inline constexpr std::size_t kOff = 5;   ///< rows
inline constexpr double kMargin = 0.05;  ///< [s]
inline constexpr double kLift = 0.6;     ///< [s]

/// Removes the rows in contact and all that are not levitated; a model starts anew at a gap.
/// What is left moves most of all on its ways, which is what tells units and wires.
void LeaveOutContact(const RigView& rig, Record& record);

/// The same with ways and lifts: for what is said of the rig.
void LeaveOutContactAndWays(const RigView& rig, Record& record);

}  // namespace levitas::diagnosis
