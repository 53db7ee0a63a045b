#pragma once
// SIGINT and SIGTERM as a count that any thread may read: the first asks for an orderly end, the
// second for an immediate one.
//
// Thread   the handler only adds to an atomic number.

namespace levitas::rt {

/// Installs the handlers; SIGPIPE is ignored, so that a closed terminal does not end the control.
void CatchStopSignals() noexcept;
/// How often the end was asked for since.
[[nodiscard]] int StopSignals() noexcept;

}  // namespace levitas::rt
