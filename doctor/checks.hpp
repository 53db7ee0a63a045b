#pragma once
// The checks behind `amb doctor`: is this machine fit for real time, LCM, CAN, GPIO, recording?
//
// Limits   for the 10 kHz loop: period 100 us. The figures beside each limit in checks.cpp say
//          where it comes from.
// Not done nothing is changed on the machine; every remedy is a text for the user to run.

#include <string>
#include <vector>

#include "doctor/finding.hpp"
#include "doctor/probe.hpp"

namespace levitas::doctor {

inline constexpr std::int64_t kWakeUpTrialNs = 500'000'000;

[[nodiscard]] std::vector<Finding> CheckRealTime(const Probe& probe);
[[nodiscard]] std::vector<Finding> CheckLcm(const Probe& probe);
/// Part of CheckLcm.
[[nodiscard]] Finding WhoMayCommand(const Probe& probe);
[[nodiscard]] std::vector<Finding> CheckCan(const Probe& probe);
[[nodiscard]] std::vector<Finding> CheckGpio(const Probe& probe);
/// `folder`: where sessions would be recorded.
[[nodiscard]] std::vector<Finding> CheckStorage(const Probe& probe, const std::string& folder);

/// All of the above, in this order.
[[nodiscard]] std::vector<Finding> CheckMachine(const Probe& probe, const std::string& folder);

}  // namespace levitas::doctor
