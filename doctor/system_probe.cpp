#include "doctor/system_probe.hpp"

#include <linux/can.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

namespace levitas::doctor {
namespace {

/// Worked, or the reason that errno gives.
Trial FromStatus(bool worked) { return {worked, worked ? "" : std::strerror(errno)}; }

}  // namespace

std::optional<std::string> SystemProbe::ReadLine(const std::string& path) const {
  std::ifstream file(root_ + path);
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  return line;
}

std::vector<std::string> SystemProbe::ReadLines(const std::string& path) const {
  std::ifstream file(root_ + path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> SystemProbe::List(const std::string& folder,
                                           const std::string& prefix) const {
  std::vector<std::string> names;
  std::error_code error;
  std::filesystem::directory_iterator entries(root_ + folder, error);
  if (error) return names;
  for (const auto& entry : entries) {
    std::string name = entry.path().filename();
    if (name.starts_with(prefix)) names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool SystemProbe::Exists(const std::string& path) const {
  return access((root_ + path).c_str(), F_OK) == 0;
}

bool SystemProbe::ReadableAndWritable(const std::string& path) const {
  return access((root_ + path).c_str(), R_OK | W_OK) == 0;
}

unsigned SystemProbe::Cores() const { return std::thread::hardware_concurrency(); }

std::string SystemProbe::KernelRelease() const {
  utsname name{};
  return uname(&name) == 0 ? name.release : "unknown";
}

std::optional<std::uint64_t> SystemProbe::FreeBytes(const std::string& path) const {
  struct statvfs disk {};
  const std::string where = root_ + path;
  if (statvfs(where.c_str(), &disk) != 0 || access(where.c_str(), W_OK) != 0) return std::nullopt;
  return static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
}

Trial SystemProbe::TakeFifo(int priority) const {
  Trial trial;
  // A thread of its own: whatever happens, this one keeps its scheduler.
  std::thread([&trial, priority] {
    sched_param wanted{};
    wanted.sched_priority = priority;
    trial = FromStatus(sched_setscheduler(0, SCHED_FIFO, &wanted) == 0);
  }).join();
  return trial;
}

Trial SystemProbe::LockMemory(std::size_t bytes) const {
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return FromStatus(false);
  Trial trial = FromStatus(mlock(memory, bytes) == 0);
  munmap(memory, bytes);
  return trial;
}

Trial SystemProbe::SetTimerSlack() const {
  Trial trial;
  std::thread([&trial] {  // the slack is a property of the thread
    trial = FromStatus(prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL) == 0);
  })
      .join();
  return trial;
}

Trial SystemProbe::OpenCanSocket() const {
  const int handle = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  Trial trial = FromStatus(handle >= 0);
  if (handle >= 0) close(handle);
  return trial;
}

}  // namespace levitas::doctor
