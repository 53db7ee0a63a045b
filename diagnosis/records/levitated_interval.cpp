#include "diagnosis/records/levitated_interval.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/records/recorded_rows.hpp"

namespace levitas::diagnosis {
namespace {

using Rows = std::vector<analysis::RecordedRow>;

bool Beyond(const RigView& rig, const AxisArray& position_m, double share) {
  for (std::size_t a = 0; a + 1 < rig.axes; a += 2) {
    const double limit_m = share * rig.bearing(a).touchdown.clearance_m;
    if (limit_m > 0.0 && std::hypot(position_m[a], position_m[a + 1]) > limit_m) return true;
  }
  return false;
}

bool WithoutCurrent(const RigView& rig, const analysis::RecordedRow& row) {
  const auto& current_a = row.sample.command.control_current_a;
  return std::all_of(current_a.begin(), current_a.begin() + static_cast<std::ptrdiff_t>(rig.axes),
                     [](double value) { return value == 0.0; });
}

std::vector<bool> InContact(const RigView& rig, const Rows& rows) {
  std::vector<bool> contact(rows.size(), false);
  std::size_t off = 0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    off = WithoutCurrent(rig, rows[n]) ? off + 1 : 0;
    contact[n] = off >= kOff || Beyond(rig, rows[n].sample.position_m, kFree);
  }
  return contact;
}

/// Where the middle of the orbit, a mean over `window` rows, is not at home.
std::vector<bool> OnTheWay(const RigView& rig, const Rows& rows, std::size_t window) {
  std::vector<bool> away(rows.size(), false);
  AxisArray sum_m{};
  // One reading that is no number would stay in the sum for good.
  const auto reading = [&rows](std::size_t n, std::size_t a) {
    const double value_m = rows[n].sample.position_m[a];
    return std::isfinite(value_m) ? value_m : 0.0;
  };
  for (std::size_t n = 0; n < rows.size(); ++n) {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      sum_m[a] += reading(n, a);
      if (n >= window) sum_m[a] -= reading(n - window, a);
    }
    if (n + 1 < window) continue;
    AxisArray mean_m{};
    for (std::size_t a = 0; a < rig.axes; ++a) mean_m[a] = sum_m[a] / static_cast<double>(window);
    away[n - window / 2] = Beyond(rig, mean_m, kHome);
  }
  return away;
}

std::size_t RowsOf(double seconds, const RigView& rig) {
  return static_cast<std::size_t>(std::llround(seconds / rig.period_s));
}

struct Touched {
  std::vector<bool> contact, away;
};

/// From every contact on until the rotor has been at home for `after` rows; and back from it, for
/// `before` rows.
std::vector<bool> LeftOut(const Touched& touched, std::size_t before, std::size_t after) {
  std::vector<bool> out(touched.contact.size(), false);
  const auto pass = [&](std::size_t n, std::size_t margin, std::size_t& left) {
    if (touched.contact[n] || (left > 0 && touched.away[n])) left = margin + 1;
    if (left == 0) return;
    --left;
    out[n] = true;
  };
  // Forwards, then backwards: no row is looked at more than twice.
  std::size_t left = 0;
  for (std::size_t n = 0; n < out.size(); ++n) pass(n, after, left);
  left = 0;
  for (std::size_t n = out.size(); n-- > 0;) pass(n, before, left);
  return out;
}

void Remove(const std::vector<bool>& out, Record& record) {
  Rows& rows = record.rows;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    if (out[n]) rows[n].levitated = false;
  }
  std::erase_if(rows, [](const analysis::RecordedRow& row) { return !row.levitated; });
  record.mean_speed_rad_per_s = analysis::MeanSpeed(rows);
}

}  // namespace

void LeaveOutContact(const RigView& rig, Record& record) {
  const std::size_t margin = RowsOf(kMargin, rig);
  const Touched touched{InContact(rig, record.rows), std::vector<bool>(record.rows.size(), false)};
  Remove(LeftOut(touched, margin, margin), record);
}

void LeaveOutContactAndWays(const RigView& rig, Record& record) {
  const Rows& rows = record.rows;
  const std::size_t margin = RowsOf(kMargin, rig);
  const bool mode_known =
      std::ranges::any_of(rows, [](const analysis::RecordedRow& row) { return !row.levitated; });
  const auto after = mode_known ? margin : RowsOf(kLift, rig);
  Touched touched{InContact(rig, rows), OnTheWay(rig, rows, std::max<std::size_t>(margin, 1))};
  std::vector<bool> out = LeftOut(touched, margin, after);
  const auto kept = [](const std::vector<bool>& left_out) {
    return std::count(left_out.begin(), left_out.end(), false);
  };
  if (2 * kept(out) < std::count(touched.contact.begin(), touched.contact.end(), false)) {
    // Its place is beside the centre: there is no way home to wait for.
    touched.away.assign(rows.size(), false);
    out = LeftOut(touched, margin, after);
  }
  Remove(out, record);
}

}  // namespace levitas::diagnosis
