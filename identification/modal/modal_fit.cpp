#include "identification/modal/modal_fit.hpp"

#include "identification/modal/modal_pairing.hpp"
#include "identification/modal/whirl_start.hpp"
#include "identification/modal/working_gains.hpp"

namespace levitas::identification {
namespace {

void FitSpinning(Search& search, const FitData& standing, const std::vector<FitData>& spinning,
                 StageSetup& last) {
  StageSetup gyroscopic{.name = "gyroscopic matrix, soft L1",
                        .robust = true,
                        .rig_free = false,
                        .gyroscopic_free = true,
                        .iterations = 20,
                        .stride = 2};
  for (const FitData& data : spinning) gyroscopic.data.push_back(&data);
  search.Run(gyroscopic);
  gyroscopic.name = "gyroscopic matrix";
  gyroscopic.robust = false;
  gyroscopic.iterations = 15;
  search.Run(gyroscopic);
  last = {.name = "all speeds together",
          .data = {&standing},
          .gyroscopic_free = true,
          .iterations = 30};
  last.data.insert(last.data.end(), gyroscopic.data.begin(), gyroscopic.data.end());
  search.Run(last);
}

}  // namespace

ModalFit FitModal(const ModalStart& start, const Eigen::VectorXd& begin,
                  const std::vector<Assigned>& candidates, const FrequencyResponse& standing,
                  const std::vector<FrequencyResponse>& spinning, const ModalFitOptions& options) {
  const FitData still{standing, WorkingGainsOf(start.frame, standing)};
  std::vector<FitData> turning;
  turning.reserve(spinning.size());
  for (const FrequencyResponse& response : spinning) {
    turning.push_back({response, WorkingGainsOf(start.frame, response)});
  }
  ModalFit fit;
  fit.assigned = BestPairing(start, begin, candidates, still, options, fit);
  fit.assigned = PlaceOthers(start, fit.assigned, still, options, fit);
  const Assigned assigned = fit.assigned;
  Search search(start, assigned, options, fit);
  StageSetup last{.name = "complex", .data = {&still}};
  search.Run(last);
  for (const FitData& data : turning) {
    const StabilisationOptions band{.highest_hz = options.highest_hz};
    MeetWhirls(start.frame, data.response.speed_rad_per_s, Stabilise(data.response, band).modes,
               fit.vector);
  }
  if (!turning.empty()) FitSpinning(search, still, turning, last);
  search.Inform(last);
  return fit;
}

}  // namespace levitas::identification
