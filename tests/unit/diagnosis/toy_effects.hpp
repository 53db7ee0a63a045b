#pragma once
// What tests on the toy landscape call its effects, and what of it they look at.

#include <algorithm>
#include <string>

#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/toy_landscape.hpp"

namespace levitas::diagnosis {

/// Effects have no meaning in a toy; the catalogue lends the names.
inline std::string ToyEffect(effect::Id id) { return std::string(effect::At(id).name); }

/// True when the nonlinear model was asked for exactly these.
inline bool WasFitted(const ToyLandscape& toy, const ToyLandscape::Effects& set) {
  return std::find(toy.fits.begin(), toy.fits.end(), set) != toy.fits.end();
}

}  // namespace levitas::diagnosis
