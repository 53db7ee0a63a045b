#pragma once
// What finding causes asks of the records beside evidence: whether the model follows under an
// observer, what it leaves, and what the rig file's own numbers say.
//
// Why       going to a faster observer and back, and what a loud fault or a bent calibration calls
//           for, are decisions about numbers, too: a test makes the numbers
//           (tests/unit/diagnosis/toy_observed.hpp).
// Point     everything but the view is of the point that is given, under the present observers.
// Units     misfits in nats. Thread: blocks the caller, every processor inside.

#include <memory>
#include <vector>

#include "diagnosis/inference/evidence_landscape.hpp"
#include "diagnosis/inference/file_fits.hpp"

namespace levitas::diagnosis {

class ObservedLandscape : public EvidenceLandscape {
 public:
  [[nodiscard]] virtual const std::vector<Term>& terms() const = 0;

  /// Of the observers, in kSpeeds.
  [[nodiscard]] virtual std::size_t speed() const = 0;
  /// Selects the observers of one speed; invalidates the linearisation.
  virtual void Observe(std::size_t speed) = 0;

  /// The linearisation.
  [[nodiscard]] virtual const View& view() const = 0;
  /// LineariseAt with every innovation weighed alike: no filter takes a fault for coloured noise.
  virtual void LineariseUnfiltered(const Point& point) = 0;

  [[nodiscard]] virtual Runs RunsAt(const Point& point) const = 0;
  /// Whether the model loses the rotor (divergence.hpp).
  [[nodiscard]] virtual bool ModelDivergesAt(const Point& point) const = 0;
  /// Whether what it leaves is far more than noise (loud_fault.hpp).
  [[nodiscard]] virtual bool IsLoudAt(const Point& point) const = 0;
  /// The filter of order 0: one over the rms of what the runs leave.
  [[nodiscard]] virtual Whitener PlainFilterOf(const std::vector<Trajectory>& runs) const = 0;
  /// [nat] of these causes at the point, with a filter of its own; smaller is better.
  [[nodiscard]] virtual double MisfitOf(const Causes& causes, const Point& point) const = 0;

  /// Where the rig file, or its healthy records, have the numbers.
  [[nodiscard]] virtual Point FileNumbers() const = 0;
  /// Fits that begin there.
  [[nodiscard]] virtual std::unique_ptr<FileFits> FitsFromFile() const = 0;
};

}  // namespace levitas::diagnosis
