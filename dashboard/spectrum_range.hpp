#pragma once
// How far the spectra of the page reach: one range for all viewers, as any of them asked last.
//
//   POST /api/spectrum {"highest_hz": 1000}
//
// Thread    any. Failure: 400 with the one thing that is wrong. What lies beyond half the sampling
//           rate is left out by the spectrum itself.

#include <atomic>
#include <string>

#include "dashboard/http_answer.hpp"

namespace levitas::dashboard {

class SpectrumRange {
 public:
  static constexpr double kLeastHz = 50.0;
  static constexpr double kMostHz = 20'000.0;

  explicit SpectrumRange(double highest_hz) noexcept : highest_hz_(highest_hz) {}
  [[nodiscard]] double highest_hz() const noexcept { return highest_hz_.load(); }
  [[nodiscard]] HttpAnswer Ask(const std::string& body);

 private:
  std::atomic<double> highest_hz_;
};

}  // namespace levitas::dashboard
