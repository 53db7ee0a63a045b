#include "common/each_in_parallel.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <charconv>
#include <cstdlib>
#include <cstring>

#include "common/problem.hpp"

namespace levitas {
namespace {

constexpr std::size_t kMostThreads = 1024;

std::size_t Told(const char* text) {
  std::size_t told = 0;
  const char* const end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, told);
  if (read.ec == std::errc{} && read.ptr == end && told >= 1 && told <= kMostThreads) return told;
  throw Problem(
      ExitStatus::kUsage,
      fmt::format(
          "LEVITAS_THREADS: found '{}', allowed 1 to {}; without it every processor is used", text,
          kMostThreads));
}

}  // namespace

std::size_t Processors() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets it
  if (const char* text = std::getenv("LEVITAS_THREADS"); text != nullptr && *text != '\0') {
    return Told(text);
  }
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
    return static_cast<std::size_t>(std::max(1, CPU_COUNT(&allowed)));
  }
  return std::max<std::size_t>(1, std::thread::hardware_concurrency());
}

}  // namespace levitas
