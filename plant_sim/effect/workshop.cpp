#include "plant_sim/effect/workshop.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::effect {
namespace {

/// In the order of the catalogue. What has no row stays out, so that a test can name it.
std::vector<Words> Collect() {
  std::vector<Words> all;
  for (const Row& row : Catalogue()) {
    for (const auto rows : {WordsOfElectronics(), WordsOfMechanics(), WordsOfCoils()}) {
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(all),
                   [&row](const Words& words) { return words.effect == row.name; });
    }
  }
  return all;
}

}  // namespace

std::span<const Words> Workshop() {
  static const std::vector<Words> kRows = Collect();
  return kRows;
}

const Words* FindWords(std::string_view effect) {
  const auto rows = Workshop();
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const Words& words) { return words.effect == effect; });
  return found == rows.end() ? nullptr : &*found;
}

const Words& WordsOf(Id id) {
  const Words* words = FindWords(At(id).name);
  if (words == nullptr) throw std::logic_error(std::string(At(id).name) + " has no words");
  return *words;
}

}  // namespace levitas::effect
