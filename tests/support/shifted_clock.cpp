// Preloaded into a program: its clock of the day is ahead by the nanoseconds that the first eight
// bytes of the file $LEVITAS_CLOCK_FILE hold, at any time. Its monotonic clock is the machine's.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

const volatile std::int64_t* Shift() {
  static const volatile std::int64_t* const shift = []() -> const volatile std::int64_t* {
    const char* path = std::getenv("LEVITAS_CLOCK_FILE");
    const int file = path == nullptr ? -1 : ::open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) return nullptr;
    void* page = ::mmap(nullptr, sizeof(std::int64_t), PROT_READ, MAP_SHARED, file, 0);
    ::close(file);
    return page == MAP_FAILED ? nullptr : static_cast<const volatile std::int64_t*>(page);
  }
  ();
  return shift;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const auto result = static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  if (result != 0 || clock != CLOCK_REALTIME || Shift() == nullptr) return result;
  const std::int64_t now_ns = std::int64_t{time->tv_sec} * kSecond + time->tv_nsec + *Shift();
  time->tv_sec = now_ns / kSecond;
  time->tv_nsec = now_ns % kSecond;
  return result;
}
