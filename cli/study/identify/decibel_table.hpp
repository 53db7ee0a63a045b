#pragma once
// What amb identify modal --decibel-cost prints: decibel_fit.hpp beside the modal fit.

#include "identification/modal/decibel_fit.hpp"

namespace levitas::cli {

void PrintDecibelFit(const identification::ModalResult& modal,
                     const identification::DecibelFit& fit);

}  // namespace levitas::cli
