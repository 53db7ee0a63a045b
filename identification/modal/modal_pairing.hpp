#pragma once
// Which mode of the data is which of the model's, and where a mode is that no stable pole shows.
// Parts of modal_fit.hpp.
//
// Pairing   every candidate is led towards the data with its poles held (log-magnitude, few lines),
//           the best three with everything free; the lowest cost wins, a frequency far from the
//           rig file's counting against it as one that is known to 10 %.
// Placing   a mode without a stable pole, or with a doubtful one far from the rig file's, is moved
//           through 12 % to either side with the rig file's deflections: it is placed where the
//           cost is lower than anywhere else (2 % away or more) by 12, a chance of one in 1e5 with
//           noise alone. Otherwise it stays at the rig file's number and is not fitted.
// Thread    one. Nothing is thrown.

#include "identification/modal/fit_stages.hpp"

namespace levitas::identification {

/// The pairing that explains the data best; `fit` then is where its forgiving stages ended.
[[nodiscard]] Assigned BestPairing(const ModalStart& start, const Eigen::VectorXd& begin,
                                   const std::vector<Assigned>& candidates, const FitData& standing,
                                   const ModalFitOptions& options, ModalFit& fit);

/// `assigned` with what could be placed beside, and without what is doubtful.
[[nodiscard]] Assigned PlaceOthers(const ModalStart& start, const Assigned& assigned,
                                   const FitData& standing, const ModalFitOptions& options,
                                   ModalFit& fit);

}  // namespace levitas::identification
