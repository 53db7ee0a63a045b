#pragma once
// The rotor of a rig as rectangles along the shaft, and the places on it that causes name.
//
// Rotor    sections, rings and discs of the rig file; a disc's width and diameter are not in the
//          file: it is drawn thin, as large as its polar inertia says of its mass (solid disc,
//          d^2 = 8 Ip/m). A rotor given by its modes is a shaft between the ends of its shapes.
// Not done geared shafts and a ball: their rotor stays empty, and so do the marks.
// Units    m. Thread: any; pure.

#include <vector>

#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::diagnosis {

struct DiagnosisResult;

[[nodiscard]] ReportScale ScaleOf(const DiagnosisResult& answer);
[[nodiscard]] ReportRotor RotorOf(const DiagnosisResult& answer);
/// Where the parameters of the causes are: a plane, a bearing's magnet or sensor.
[[nodiscard]] std::vector<ReportMark> MarksOf(const DiagnosisResult& answer,
                                              const std::vector<NamedParameter>& parameters);

}  // namespace levitas::diagnosis
