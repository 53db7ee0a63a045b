#include "rt/say.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <condition_variable>
#include <csignal>
#include <exception>
#include <mutex>

namespace levitas::rt {
namespace {

using SteadyClock = std::chrono::steady_clock;
constexpr std::size_t kPieceBytes = PIPE_BUF;
constexpr std::size_t kStackBytes = std::size_t{256} << 10;
constexpr std::size_t kNoticeBytes = 80;  // of "[... lines lost so far ...]", and to spare
constexpr auto kRetry = std::chrono::milliseconds(100);

std::uint64_t Lines(std::string_view text) {
  return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Whole lines, none longer than is allowed.
std::string AsLines(std::string_view text) {
  constexpr std::string_view kCut = " [cut]";
  std::string lines;
  const std::string shown = Printable(text);
  for (std::string_view rest = shown; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    lines += rest.substr(0, std::min(end, Speaker::kLongestLine));
    if (end > Speaker::kLongestLine) lines += kCut;
    lines += '\n';
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return lines;
}

bool Writable(int file) noexcept {
  pollfd wait{.fd = file, .events = POLLOUT, .revents = 0};
  return ::poll(&wait, 1, 0) > 0;
}

bool IsRegular(int file) noexcept {
  struct stat facts {};
  return ::fstat(file, &facts) == 0 && S_ISREG(facts.st_mode);
}

}  // namespace

struct Speaker::State {
  explicit State(int given, std::uint64_t log_bytes)
      : file(given), budget(IsRegular(given) ? log_bytes : UINT64_MAX) {}

  [[nodiscard]] std::size_t Room() const { return room.size() - filled; }

  void Append(std::string_view text) {
    for (const char byte : text) room[(first + filled++) % room.size()] = byte;
  }

  /// Whole lines where there are some. Removes what it returns from the queue.
  std::string_view TakePiece(std::array<char, kPieceBytes>& piece) {
    std::size_t size = std::min(filled, piece.size());
    for (std::size_t i = 0; i < size; ++i) piece[i] = room[(first + i) % room.size()];
    const std::size_t line = std::string_view(piece.data(), size).rfind('\n');
    if (filled > size && line != std::string_view::npos) size = line + 1;
    first = (first + size) % room.size();
    filled -= size;
    return {piece.data(), size};
  }

  void Lose(std::uint64_t lines) {
    lost += lines;
    untold = true;
  }

  /// Says in its place in the text that some was lost.
  void TellLost() {
    const std::string told = fmt::format("[{} lines lost so far: not taken here]\n", lost);
    if (Room() < told.size()) return;
    Append(told);
    untold = false;
  }

  void Post(std::string_view text, Kind kind) {
    const bool within = posted + text.size() <= budget || kind == Kind::kReport;
    // The next line that is taken follows the word on those before it that were not.
    const std::size_t needed = text.size() + (untold ? kNoticeBytes : 0);
    if (!within || needed > Room()) return Lose(std::max<std::uint64_t>(1, Lines(text)));
    if (untold) TellLost();
    Append(text);
    posted += text.size();
  }

  /// Starts the writer. It runs beside the loop, not above it, and is deaf to signals: those of a
  /// write (SIGPIPE, SIGXFSZ) then only make it fail.
  void Start(const std::shared_ptr<State>& self) {
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
    pthread_attr_setstacksize(&attributes, kStackBytes);
    pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
    pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    auto handed = std::make_unique<std::shared_ptr<State>>(self);
    pthread_t thread{};
    started = pthread_create(&thread, &attributes, &State::Main, handed.get()) == 0;
    if (started) static_cast<void>(handed.release());
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    pthread_attr_destroy(&attributes);
  }

  static void* Main(void* handed) {
    const std::unique_ptr<std::shared_ptr<State>> state(
        static_cast<std::shared_ptr<State>*>(handed));
    try {
      (*state)->Write();
    } catch (const std::exception&) {  // nothing in it throws; what is said is lost, no more
    }
    return nullptr;
  }

  void Write() {
    std::array<char, kPieceBytes> piece{};
    std::unique_lock lock(mutex);
    for (;;) {
      changed.wait(lock, [this] { return filled > 0 || closing; });
      if (filled == 0) return;
      const std::string_view text = TakePiece(piece);
      writing = true;
      lock.unlock();
      const std::size_t left = WriteOut(text);
      lock.lock();
      writing = false;
      ++pieces;
      if (left > 0) Lose(std::max<std::uint64_t>(1, Lines(text.substr(text.size() - left))));
      // Nobody has to say something new for it to be known.
      if (left == 0 && filled == 0 && untold) TellLost();
      changed.notify_all();
    }
  }

  /// Waits for room as long as that takes; returns how many bytes were refused.
  [[nodiscard]] std::size_t WriteOut(std::string_view text) const {
    while (!text.empty()) {
      pollfd wait{.fd = file, .events = POLLOUT, .revents = 0};
      ::poll(&wait, 1, -1);
      const ssize_t wrote = ::write(file, text.data(), text.size());
      if (wrote >= 0) {
        text.remove_prefix(static_cast<std::size_t>(wrote));
      } else if (errno == EAGAIN) {
        ::poll(nullptr, 0, static_cast<int>(kRetry.count()));
      } else if (errno != EINTR) {
        break;
      }
    }
    return text.size();
  }

  const int file;
  std::uint64_t budget;  ///< bytes that the file takes from us
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::array<char, kRoomBytes> room{};
  std::size_t first{0};
  std::size_t filled{0};
  std::uint64_t posted{0};
  std::uint64_t lost{0};
  std::uint64_t pieces{0};
  bool untold{false};  ///< lost lines of which nothing has been said yet
  bool writing{false};
  bool started{false};
  bool closing{false};
};

Speaker::Speaker(int file, std::uint64_t log_bytes)
    : state_(std::make_shared<State>(file, log_bytes)) {}

Speaker::~Speaker() {
  static_cast<void>(Flush());
  const std::lock_guard lock(state_->mutex);
  state_->closing = true;
  state_->changed.notify_all();
}

void Speaker::Post(std::string_view text, Kind kind) noexcept {
  try {
    const std::string shown = kind == Kind::kPart ? std::string(text) : AsLines(text);
    const std::lock_guard lock(state_->mutex);
    state_->Post(shown, kind);
    if (!state_->started) state_->Start(state_);
    state_->changed.notify_all();
  } catch (const std::exception&) {  // no memory: this text is not said
  }
}

bool Speaker::Flush() noexcept {
  try {
    std::unique_lock lock(state_->mutex);
    const auto done = [this] { return state_->filled == 0 && !state_->writing; };
    const auto end = SteadyClock::now() + kEndWait;
    while (!done() && state_->started && SteadyClock::now() < end) {
      const std::uint64_t before = state_->pieces;
      state_->changed.wait_for(lock, kStallWait,
                               [&] { return done() || state_->pieces != before; });
      // Slow is not stalled: a writer that gets no processor still has a file that takes text.
      if (!done() && state_->pieces == before && !Writable(state_->file)) break;
    }
    return done();
  } catch (const std::exception&) {
    return false;
  }
}

std::uint64_t Speaker::lost() const noexcept {
  const std::lock_guard lock(state_->mutex);
  return state_->lost;
}

namespace {
/// Never destroyed: threads may speak until the process ends.
Speaker& StandardError() {
  static auto* const speaker = new Speaker(STDERR_FILENO);  // NOLINT: see above
  return *speaker;
}
}  // namespace

void Say(std::string_view text, Speaker::Kind kind) noexcept {
  try {
    StandardError().Post(text, kind);
  } catch (const std::exception&) {  // no memory
  }
}

bool FlushSaid() noexcept {
  try {
    return StandardError().Flush();
  } catch (const std::exception&) {
    return false;
  }
}

void OpenStandardFiles() noexcept {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free number is the one that is closed.
    if (::open("/dev/null", O_RDWR) < 0) return;
  }
}

}  // namespace levitas::rt
