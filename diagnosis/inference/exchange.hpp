#pragma once
// Every one of several causes exchanged for what comes nearest to it.
//
// Why        causes are found one after the other, and the second is chosen while the first is
//            still bent by what it does not explain: a slew limit that is found beside a delay
//            nobody knows of is a little off, and a slow sensor then fits better than the delay.
// Method     shapes of all causes are sought again together; then, cause by cause, the nearest
//            others take its place, with all shapes sought again; the best set stays.
// Thread     blocks the caller, two threads inside.

#include "diagnosis/inference/inquiry.hpp"

namespace levitas::diagnosis {

void ExchangeCauses(Inquiry& q);

}  // namespace levitas::diagnosis
