#pragma once
// The envelopes of the last ten minutes, for a page that is opened, or opened again, late: also
// after the run has ended.
//
// Bytes     a float64, the time of the first row [s], then rows of float32, little-endian: time
//           since then [s], speed [rpm], least and greatest position of each axis [um], least and
//           greatest current of each axis [A]; 2 + 4 axes numbers a row. NaN where there was none.
// Size      kRows rows at most, the oldest are dropped: 1.8 MB for four axes, all of it taken when
//           a run begins, so that a long one adds nothing.
// Thread    any; locks for as long as copying takes.
// Failure   none.

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "dashboard/sample_store.hpp"

namespace levitas::dashboard {

class History {
 public:
  static constexpr std::size_t kRows = 24'000;  ///< ten minutes of SampleStore::kBucketSeconds

  /// Forgets what was: another run begins.
  void Clear(std::size_t axes);
  void Add(const Envelope& bucket);
  [[nodiscard]] std::string Bytes() const;

 private:
  mutable std::mutex mutex_;
  std::size_t axes_{0};
  std::vector<double> time_s_;  ///< a ring of kRows
  std::vector<float> values_;   ///< the rest of each row, at the same place
  std::uint64_t taken_{0};      ///< rows since the run began
};

}  // namespace levitas::dashboard
