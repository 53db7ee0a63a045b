#pragma once
// Whether measured positions and currents can be of this rig at all: a unit that is wrong by a
// thousand makes a session that looks whole and is of nothing.
//
// Bounds    a position lies within the range of its probe, for the converter covers no more, and
//           mostly within the clearance; a commanded current and a test signal within twice what an
//           amplifier gives (a command may ask for more than it gets).
// Doubted   a column with a number beyond the range or twice the amplifier's current, or mostly
//           beyond the clearance, or a position that hardly scatters: told with the largest
//           number, the bounds and the unit in which it would fit, or the offset that may be
//           missing.
// Refused   where nothing of it can be true: positions mostly beyond the bounds that also move by
//           more than the range, currents mostly beyond ten times the amplifier's.
// Thread    one per object. Failure: none, it only says.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/axes.hpp"
#include "common/rig_numbers.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/exchange/csv_columns.hpp"

namespace levitas::session {

struct ImplausibleColumn {
  std::string sentence;  ///< names column, largest number, bound and what is likely
  bool impossible{false};
};

class PlausibleValues {
 public:
  explicit PlausibleValues(const RigNumbers& rig);

  void Count(const cycle::CycleRecord& record) noexcept;
  /// The columns of `layout` with numbers beyond what the rig has, in its order.
  [[nodiscard]] std::vector<ImplausibleColumn> Found(const CsvLayout& layout) const;

 private:
  struct Spread {
    std::uint64_t count{};
    std::uint64_t beyond{};      ///< of the bound
    std::uint64_t far_beyond{};  ///< of ten times the bound
    double largest{};            ///< of the magnitudes
    double mean{};
    double square_sum{};  ///< of the distances from the mean

    void Count(double value, double bound) noexcept;
    [[nodiscard]] double deviation() const noexcept;
  };

  [[nodiscard]] ImplausibleColumn OfPosition(const CsvColumn& column, const Spread& spread) const;
  [[nodiscard]] ImplausibleColumn OfCurrent(const CsvColumn& column, const Spread& spread) const;

  const RigNumbers& rig_;
  std::array<Spread, kMaxAxes> position_{};
  std::array<Spread, kMaxAxes> current_{};
  std::array<Spread, kMaxAxes> excitation_{};
};

}  // namespace levitas::session
