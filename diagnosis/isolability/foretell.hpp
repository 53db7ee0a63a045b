#pragma once
// The whole table: every effect of the vocabulary at its stated size, against all others.
//
// Thread  blocks the caller, every processor inside. Failure: as HealthyModel.

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/isolability/healthy_model.hpp"
#include "diagnosis/isolability/separation.hpp"
#include "diagnosis/isolability/stated_fault.hpp"

namespace levitas::diagnosis {

struct Foretold {
  StatedFault fault;
  Prediction prediction;
};

using Progress = std::function<void(double share, const std::string& what)>;

/// In the order of the catalogue. `further`: records that are diagnosed together with those of
/// `model`, made with its orbit; may be null.
[[nodiscard]] std::vector<Foretold> ForetellAll(const HealthyModel& model,
                                                const HealthyModel* further,
                                                const std::vector<StatedFault>& faults,
                                                const Judging& judging, const Progress& progress);

/// One fault; none when a diagnosis does not look for it.
[[nodiscard]] std::optional<Prediction> Foretell(const HealthyModel& model,
                                                 const HealthyModel* further,
                                                 const std::vector<effect::EffectConfig>& fault,
                                                 const Judging& judging);

/// Effects that are tied with each other, directly or through a third, in the order of their names;
/// alone ones are left out.
[[nodiscard]] std::vector<std::vector<effect::Id>> TiedGroups(const std::vector<Foretold>& all);

}  // namespace levitas::diagnosis
