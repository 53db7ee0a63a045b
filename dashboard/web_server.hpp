#pragma once
// The page, its event stream and its requests over HTTP.
//
//   GET  /            the page and its parts, from inside the program
//   GET  /events      server-sent events: what the hub has, one stream per viewer
//   routes            as given: command_api.hpp, scope_controller.hpp; POST needs the page's header
//
// Bounds    front_door.hpp, request_reader.hpp: connections, their times and sizes. kMaxViewers
//           streams at once, the next is told 503. A viewer that takes nothing for three seconds is
//           dropped (its browser comes back by itself); what the kernel holds for it is
//           kSendBufferBytes. Any other answer must be taken within kAnswerWithin of its first
//           byte.
// Stop      an emergency stop is handed to `stop` in the thread that read it, as soon as its
//           request is whole and its access checked; no thread, place or answer of anybody is
//           waited for, and it is never told 503. kMostStops clients at a time wait for the word
//           of the controller; who is one too many is told at once that the stop was sent.
// Lanes     other commands, the page and the viewers have threads of their own (lane.hpp): none can
//           hold back another's.
// Access    access.hpp.
// Thread    its own; the hub and the routes are called from there.
// Failure   Problem (exit status 1) when the address cannot be bound, naming it.

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "dashboard/http_answer.hpp"
#include "dashboard/hub.hpp"

namespace levitas::dashboard {

struct WebOptions {
  std::string address{"127.0.0.1"};
  int port{8970};
  bool any_port{true};  ///< the next free one when `port` is taken
  std::string token;    ///< needed beyond loopback
};

class WebServer {
 public:
  static constexpr int kMaxViewers = 16;
  static constexpr int kPortsTried = 64;
  static constexpr int kSendBufferBytes = 256 * 1024;
  static constexpr std::chrono::seconds kAnswerWithin{30};

  static constexpr std::size_t kMostStops = 256;

  WebServer(const WebOptions& options, Hub& hub, std::vector<Route> routes, StopRoute stop = {});
  /// Closes the hub, so that the streams end, and joins.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  /// With the token, when there is one.
  [[nodiscard]] std::string Url() const;
  [[nodiscard]] int viewers() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::dashboard
