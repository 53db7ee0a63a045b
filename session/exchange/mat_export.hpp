#pragma once
// A session as a MAT file of version 5 (MATLAB, Octave, SciPy): a vector per column of
// export_rows.hpp, named as it; MatRows reads them back.
//
// Memory    8 bytes per number: 70 MB a minute of four axes at 10 kHz.
// Failure   BadInput when the file cannot be written, or a column would pass the format's 2 GB.

#include <string>

#include "session/exchange/csv_export.hpp"

namespace levitas::session {

/// Reads the rest of `reader`. The file appears under its name when it is complete.
ExportReport ExportMat(SessionReader& reader, const std::string& mat_path,
                       const ExportSelection& selection = {});

}  // namespace levitas::session
