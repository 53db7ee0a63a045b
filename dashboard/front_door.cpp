#include "dashboard/front_door.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <utility>

#include "dashboard/http_answer.hpp"

namespace levitas::dashboard {
namespace {

constexpr int kLookMs = 100;  // how finely the deadlines are kept
constexpr int kMostAcceptedAtOnce = 64;
constexpr std::size_t kPieceBytes = std::size_t{16} * 1024;
constexpr int kTooSlow = 408;
constexpr int kNoRoom = 503;

/// Without waiting: an answer this short fits a fresh connection's buffer, or is lost.
void Tell(int socket, int status, const char* why) {
  const HttpAnswer answer = Answer(status, "not allowed", why);
  const std::string text = fmt::format(
      "HTTP/1.1 {} Refused\r\nConnection: close\r\nContent-Type: application/json\r\n"
      "Content-Length: {}\r\n\r\n{}",
      status, answer.body.size(), answer.body);
  (void)::send(socket, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

bool NothingYet(ssize_t count) {
  return count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
}

}  // namespace

FrontDoor::FrontDoor(int listening, Enter enter)
    : listening_(listening),
      enter_(std::move(enter)),
      wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  (void)::fcntl(listening_, F_SETFL, ::fcntl(listening_, F_GETFL) | O_NONBLOCK);
  (void)::listen(listening_, SOMAXCONN);  // the library asks for a queue of five
  thread_ = std::thread([this] { Run(); });
}

FrontDoor::~FrontDoor() { Close(); }

void FrontDoor::Close() {
  if (!thread_.joinable()) return;
  closing_.store(true);
  (void)::eventfd_write(wake_.handle(), 1);
  thread_.join();
  guests_.clear();
}

void FrontDoor::SeeOut(FileDescriptor connection) {
  (void)::shutdown(connection.handle(), SHUT_WR);
  {
    const std::lock_guard lock(served_mutex_);
    served_.push_back(std::move(connection));
  }
  (void)::eventfd_write(wake_.handle(), 1);
}

void FrontDoor::Run() {
  while (!closing_.load()) {
    WaitForNews();
    const Clock::time_point now = Clock::now();
    // In the order in which they were polled; Accept and TakeThoseServed add at the end.
    for (std::size_t i = 0; i < guests_.size(); ++i) {
      Guest& guest = guests_[i];
      if (polled_[i].revents != 0) guest.leaving ? ThrowAway(guest) : Read(guest, now);
      Expire(guest, now);
    }
    TakeThoseServed(now);
    Accept(now);
    guests_.erase(std::remove_if(guests_.begin(), guests_.end(),
                                 [](const Guest& guest) { return guest.gone; }),
                  guests_.end());
  }
}

void FrontDoor::WaitForNews() {
  polled_.clear();
  for (const Guest& guest : guests_) polled_.push_back({guest.connection.handle(), POLLIN, 0});
  polled_.push_back({listening_, POLLIN, 0});
  polled_.push_back({wake_.handle(), POLLIN, 0});
  (void)::poll(polled_.data(), polled_.size(), kLookMs);
  eventfd_t ignored{};
  (void)::eventfd_read(wake_.handle(), &ignored);
}

void FrontDoor::TakeThoseServed(Clock::time_point now) {
  std::vector<FileDescriptor> served;
  {
    const std::lock_guard lock(served_mutex_);
    served.swap(served_);
  }
  for (FileDescriptor& connection : served) {
    MakeRoom(kMostGuests);
    guests_.push_back({std::move(connection), now, {}, true, 0, false});
  }
}

void FrontDoor::Accept(Clock::time_point now) {
  for (int i = 0; i < kMostAcceptedAtOnce; ++i) {
    FileDescriptor connection(
        ::accept4(listening_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (connection.handle() < 0) {
      // No descriptors left: whoever has waited longest gives his.
      if (errno == EMFILE || errno == ENFILE) MakeRoom(1);
      return;
    }
    const int yes = 1;
    (void)::setsockopt(connection.handle(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    MakeRoom(kMostGuests);
    guests_.push_back({std::move(connection), now, {}, false, 0, false});
    Read(guests_.back(), now);  // mostly it is there already
  }
}

void FrontDoor::MakeRoom(std::size_t full) {
  const auto rank = [](const Guest& guest) {
    return std::pair(!guest.leaving && guest.request.begun(), guest.since);
  };
  guests_.erase(
      std::remove_if(guests_.begin(), guests_.end(), [](const Guest& guest) { return guest.gone; }),
      guests_.end());
  if (guests_.size() < full) return;
  guests_.erase(std::min_element(
      guests_.begin(), guests_.end(),
      [&](const Guest& one, const Guest& other) { return rank(one) < rank(other); }));
}

void FrontDoor::Read(Guest& guest, Clock::time_point now) {
  std::array<char, kPieceBytes> piece;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled
  while (guest.request.Wanted() > 0) {
    const std::size_t most = std::min(piece.size(), guest.request.Wanted());
    const ssize_t count = ::recv(guest.connection.handle(), piece.data(), most, 0);
    if (NothingYet(count)) return;
    if (count <= 0) {
      guest.gone = true;
      return;
    }
    if (!guest.request.begun()) guest.since = now;
    guest.request.Take({piece.data(), static_cast<std::size_t>(count)});
  }
  if (const RequestReader::Refusal& refusal = guest.request.refusal(); refusal.status != 0) {
    return Refuse(guest, refusal.status, refusal.why, now);
  }
  Asked asked{std::move(guest.connection), std::move(guest.request)};
  guest.gone = enter_(asked);
  if (guest.gone) return;
  guest.connection = std::move(asked.connection);
  Refuse(guest, kNoRoom, "too much is asked at once", now);
}

void FrontDoor::ThrowAway(Guest& guest) {
  std::array<char, kPieceBytes> piece;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled
  for (;;) {
    const ssize_t count = ::recv(guest.connection.handle(), piece.data(), piece.size(), 0);
    if (NothingYet(count)) return;
    if (count > 0) guest.thrown_away += static_cast<std::size_t>(count);
    guest.gone = count <= 0 || guest.thrown_away > kMostThrownAway;
    if (guest.gone) return;
  }
}

void FrontDoor::Refuse(Guest& guest, int status, const char* why, Clock::time_point now) {
  Tell(guest.connection.handle(), status, why);
  (void)::shutdown(guest.connection.handle(), SHUT_WR);
  guest.leaving = true;
  guest.since = now;
}

void FrontDoor::Expire(Guest& guest, Clock::time_point now) {
  if (guest.gone) return;
  const Clock::duration age = now - guest.since;
  if (guest.leaving) {
    guest.gone = age > kLeaveWithin;
  } else if (!guest.request.begun()) {
    guest.gone = age > kIdle;
  } else if (age > (guest.request.head_read() ? kWholeWithin : kHeadWithin)) {
    Refuse(guest, kTooSlow, "the request came too slowly", now);
  }
}

}  // namespace levitas::dashboard
