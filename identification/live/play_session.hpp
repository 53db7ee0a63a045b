#pragma once
// A session as the messages that a listener beside its run would have got.
//
// Samples   rounded and gathered by the controller's own SampleBatcher, states at the cycles at
//           which the controller sends them: a listener that lost nothing has the same rows.
// Thread    one. Failure: of the reader; BadInput of LiveIdentification.

#include <functional>

#include "identification/live/live_identification.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::identification {

/// Until the session ends, or `wanted`, asked at every batch, is false. `live` has the session's
/// header.
void PlaySession(session::SessionReader& reader, LiveIdentification& live,
                 const std::function<bool()>& wanted = {});

}  // namespace levitas::identification
