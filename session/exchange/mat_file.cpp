#include "session/exchange/mat_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <utility>

#include "common/file_descriptor.hpp"
#include "common/problem.hpp"
#include "session/exchange/mat_variables.hpp"

namespace levitas::session {
namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;
// A sanitizer reserves terabytes: there the memory is not limited.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kSanitized = false;
#endif
enum class Answer : char { kTable = 'T', kRefused = 'R', kNoMemory = 'M' };

bool WriteAll(int fd, const void* from, std::size_t bytes) {
  const char* at = static_cast<const char*>(from);
  while (bytes > 0) {
    const ssize_t count = ::write(fd, at, bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    at += count;
    bytes -= static_cast<std::size_t>(count);
  }
  return true;
}

bool ReadAll(int fd, void* to, std::size_t bytes) {
  char* at = static_cast<char*>(to);
  while (bytes > 0) {
    const ssize_t count = ::read(fd, at, bytes);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    at += count;
    bytes -= static_cast<std::size_t>(count);
  }
  return true;
}

/// A count and so many elements.
template <class Sequence>
bool Put(int fd, const Sequence& what) {
  const std::uint64_t count = what.size();
  return WriteAll(fd, &count, sizeof count) &&
         WriteAll(fd, what.data(), what.size() * sizeof *what.data());
}
template <class Sequence>
bool Get(int fd, Sequence& what, std::uint64_t most) {
  std::uint64_t count = 0;
  if (!ReadAll(fd, &count, sizeof count) || count > most) return false;
  what.resize(count);
  return ReadAll(fd, what.data(), what.size() * sizeof *what.data());
}

/// Never raises a limit that is there, and leaves none to be raised again.
void Lower(decltype(RLIMIT_AS) which, std::uint64_t most) {
  rlimit limit{};
  if (::getrlimit(which, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, most);
  // A second more of processor time: at the soft limit it ends by a signal that says why.
  const rlim_t grace = which == RLIMIT_CPU ? 1 : 0;
  if (limit.rlim_cur < limit.rlim_max) limit.rlim_max = limit.rlim_cur + grace;
  (void)::setrlimit(which, &limit);
}

std::uint64_t AddressSpaceNow() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void Confine(std::uint64_t file_bytes, pid_t parent) {
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  for (const int signal : {SIGXCPU, SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGPIPE}) {
    (void)std::signal(signal, SIG_DFL);
  }
  // What the libraries say of a damaged file is said by the refusal.
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) (void)::dup2(nowhere, STDERR_FILENO);
  Lower(RLIMIT_CORE, 0);
  Lower(RLIMIT_FSIZE, 0);
  Lower(RLIMIT_CPU, MostSeconds(file_bytes));
  if (!kSanitized) Lower(RLIMIT_AS, AddressSpaceNow() + MostMemory(file_bytes));
}

bool Send(int to, Answer answer) { return WriteAll(to, &answer, sizeof answer); }

void ReadAndSend(int to, const std::string& path, const std::string& matrix,
                 const std::vector<std::string>& matrix_rows) {
  try {
    const MatTable table = ReadMatInThisProcess(path, matrix, matrix_rows);
    const std::uint64_t count = table.names.size();
    bool sent = Send(to, Answer::kTable) && WriteAll(to, &count, sizeof count);
    for (std::size_t i = 0; sent && i < count; ++i) {
      sent = Put(to, table.names[i]) && Put(to, table.columns[i]);
    }
  } catch (const BadInput& problem) {
    (void)(Send(to, Answer::kRefused) && Put(to, std::string(problem.what())));
  } catch (const std::exception&) {  // of memory, or of a length that cannot be
    (void)Send(to, Answer::kNoMemory);
  }
}

/// False when the other process ended before it had said everything.
bool Receive(int from, const std::string& path, MatTable& table) {
  constexpr std::uint64_t kMostText = kMiB;
  Answer answer{};
  if (!ReadAll(from, &answer, sizeof answer)) return false;
  if (answer == Answer::kRefused) {
    std::string why;
    if (!Get(from, why, kMostText)) return false;
    throw BadInput(why);
  }
  if (answer != Answer::kTable) return false;
  std::uint64_t columns = 0;
  if (!ReadAll(from, &columns, sizeof columns)) return false;
  std::uint64_t left = kMostNumbers;
  for (std::uint64_t i = 0; i < columns; ++i) {
    std::string name;
    std::vector<double> numbers;
    try {
      if (!Get(from, name, kMostText) || !Get(from, numbers, left)) return false;
    } catch (const std::bad_alloc&) {
      throw BadInput(path + ": its numbers do not fit this machine's memory; export it in parts");
    }
    left -= numbers.size();
    table.names.push_back(std::move(name));
    table.columns.push_back(std::move(numbers));
  }
  return true;
}

std::string HowItEnded(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFSIGNALED(status)) return "the memory allowed for it does not suffice";
  if (WTERMSIG(status) == SIGKILL) return "the reading process was killed, of memory or of time";
  if (WTERMSIG(status) == SIGXCPU) return "the time allowed for it does not suffice";
  return fmt::format("the reading process ended with signal {} ({})", WTERMSIG(status),
                     ::strsignal(WTERMSIG(status)));
}

/// Whatever happens to the one that waits, the other is stopped and fetched.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() {
    if (pid_ > 0) (void)::kill(pid_, SIGKILL);
    if (pid_ > 0) (void)HowItEnded(pid_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  [[nodiscard]] std::string End() { return HowItEnded(std::exchange(pid_, -1)); }

 private:
  pid_t pid_;
};

}  // namespace

std::uint64_t MostMemory(std::uint64_t file_bytes) noexcept {
  // Every number that can be held, as libmatio's double, a copy, and a column; and what it needs.
  constexpr std::uint64_t kPerByte = 3 * sizeof(double) * kMostPerByte;
  constexpr std::uint64_t kMost = 3 * sizeof(double) * kMostNumbers;
  return 256 * kMiB + std::min(file_bytes, kMost / kPerByte) * kPerByte;
}

std::uint64_t MostSeconds(std::uint64_t file_bytes) noexcept { return 20 + file_bytes / kMiB; }

MatTable ReadMat(const std::string& path, const std::string& matrix,
                 const std::vector<std::string>& matrix_rows) {
  std::error_code unknown;
  const std::uint64_t file_bytes = std::filesystem::file_size(path, unknown);
  if (unknown) throw BadInput(fmt::format("{}: cannot be read: {}", path, unknown.message()));
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::bad_alloc();
  const FileDescriptor from(ends[0]);
  FileDescriptor to(ends[1]);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) throw std::bad_alloc();
  if (pid == 0) {
    Confine(file_bytes, parent);
    ReadAndSend(to.handle(), path, matrix, matrix_rows);
    ::_exit(0);
  }
  to.Close();
  Child child(pid);
  MatTable table;
  if (Receive(from.handle(), path, table)) return table;
  throw BadInput(fmt::format(
      "{}: cannot be read as a MAT file: {}; a file of {} bytes may take {} MiB and {} s. It may "
      "be "
      "damaged: export it again",
      path, child.End(), file_bytes, MostMemory(file_bytes) / kMiB, MostSeconds(file_bytes)));
}

}  // namespace levitas::session
