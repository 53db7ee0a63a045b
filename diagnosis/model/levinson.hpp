#pragma once
// Whitening by an autoregression of a signal's own past.
//
// Method     Levinson-Durbin recursion on sums of products (Durbin 1960, Rev. Int. Stat. Inst. 28).
// Result     1, -a1, -a2 ... over the rms of what no past explains: applied to the signal it gives
//            white noise of unit variance. All zeros before it never divide: a signal without power
//            is left as it is.
// Thread     any; pure.

#include <vector>

namespace levitas::diagnosis {

/// `correlation` k is the sum over `count` samples of value times the value k samples before.
[[nodiscard]] std::vector<double> WhiteningFilter(const std::vector<double>& correlation,
                                                  double count);

}  // namespace levitas::diagnosis
