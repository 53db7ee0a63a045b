#pragma once
// Which turn the shafts of a geared rig are in.
//
// A record holds the angle of the first shaft within its turn. The others come back to the same
// place only after PlantModel::train().turns_per_repeat turns of it, so that a record may begin in
// any of them; which one is found by the model that fits best.
//
// Thread  any; pure but for the record given. Failure: none.

#include "analysis/records/observer.hpp"
#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

/// Angles that go on growing, from the sample after a gap on as the speed says.
void Unwrap(Record& record, double period_s);

/// The whole turns of the start under which the nominal model follows the record best, added to all
/// angles. `gains` are those of a fast observer.
void ChooseTurn(const RigView& rig, const ObserverGains& gains, Record& record);

/// Turns a plant from the total angle it stands at to another one.
void TurnTo(plant::Plant& plant, double from_rad, double to_rad);

}  // namespace levitas::diagnosis
