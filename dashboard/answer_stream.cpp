#include "dashboard/answer_stream.hpp"

#include <sys/poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <string>
#include <utility>

namespace levitas::dashboard {

namespace {

ssize_t TakeFrom(std::string_view& unread, char* to, std::size_t size) {
  const std::size_t count = std::min(size, unread.size());
  std::copy_n(unread.begin(), count, to);
  unread.remove_prefix(count);
  return static_cast<ssize_t>(count);
}

}  // namespace

AnswerStream::AnswerStream(int socket, std::string_view request,
                           std::optional<std::chrono::milliseconds> within, Now now)
    : socket_(socket), now_(std::move(now)), unread_(request), within_(within) {}

bool AnswerStream::is_writable() const {
  if (end_ && now_() > *end_) return false;
  pollfd polled{socket_, POLLOUT, 0};
  if (::poll(&polled, 1, static_cast<int>(kTakesNothing.count())) <= 0) return false;
  // Who asked once may have said that no more will come; a viewer that did has gone.
  if (within_) return true;
  char next{};
  return ::recv(socket_, &next, 1, MSG_PEEK | MSG_DONTWAIT) != 0;
}

ssize_t AnswerStream::read(char* to, std::size_t size) { return TakeFrom(unread_, to, size); }

ssize_t AnswerStream::write(const char* from, std::size_t size) {
  if (within_ && !end_) end_ = now_() + *within_;
  if (!is_writable()) return -1;
  return ::send(socket_, from, size, MSG_DONTWAIT | MSG_NOSIGNAL);
}

void AnswerStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();  // nothing of the page asks
  port = 0;
}

void AnswerStream::get_local_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

ssize_t KeptAnswer::read(char* to, std::size_t size) { return TakeFrom(unread_, to, size); }

ssize_t KeptAnswer::write(const char* from, std::size_t size) {
  text_.append(from, size);
  return static_cast<ssize_t>(size);
}

void KeptAnswer::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

void KeptAnswer::get_local_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

}  // namespace levitas::dashboard
