#include "dashboard/web_server.hpp"

#include <fmt/core.h>
#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include "common/problem.hpp"
#include "dashboard/access.hpp"
#include "dashboard/answer_stream.hpp"
#include "dashboard/front_door.hpp"
#include "dashboard/lane.hpp"
#include "dashboard/page_files.hpp"
#include "dashboard/stop_desk.hpp"

namespace levitas::dashboard {
namespace {

using httplib::Request;
using httplib::Response;

constexpr std::size_t kCommandThreads = 4;
constexpr std::size_t kPageThreads = 4;
// Two more than viewers: who is one too many is told so.
constexpr std::size_t kViewerThreads = WebServer::kMaxViewers + 2;
constexpr std::size_t kMostWaiting = 32;  // in each lane
constexpr const char* kEvents = "/events";
constexpr const char* kCommand = "/api/command";
constexpr std::chrono::milliseconds kHeartbeat{2000};
constexpr int kForbidden = 403;
constexpr int kUnavailable = 503;

void SetSocketOptions(int socket) {
  const int yes = 1;
  const int buffer = WebServer::kSendBufferBytes;
  // Not SO_REUSEPORT, which the library would set: two dashboards would share a port unnoticed.
  (void)::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  (void)::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &buffer, sizeof buffer);
}

void Refuse(Response& response, int status, const char* why) {
  response.status = status;
  response.set_content(fmt::format("{{\"outcome\":\"not allowed\",\"text\":\"{}\"}}", why),
                       "application/json");
}

/// The library's routes and answers over connections and requests of ours.
class Library : public httplib::Server {
 public:
  ~Library() override { (void)FileDescriptor(svr_sock_.exchange(INVALID_SOCKET)); }

  [[nodiscard]] int listening() const { return svr_sock_; }

  void Answer(const Asked& asked) {
    const bool endless = asked.request.path() == kEvents;
    AnswerStream stream(asked.connection.handle(), asked.request.text(),
                        endless ? std::nullopt : std::optional(WebServer::kAnswerWithin));
    bool closed = false;
    (void)process_request(stream, true, closed, nullptr);
  }

  /// What the routes and the checks before them say to this request, without a client.
  [[nodiscard]] std::string Ask(const RequestReader& request) {
    KeptAnswer answer(request.text());
    bool closed = false;
    (void)process_request(answer, true, closed, nullptr);
    return answer.text();
  }
};

}  // namespace

struct WebServer::Impl {
  Impl(const WebOptions& given, Hub& the_hub, std::vector<Route> the_routes, StopRoute the_stop)
      : options(given), hub(the_hub), routes(std::move(the_routes)), stop(std::move(the_stop)) {
    server.set_socket_options(SetSocketOptions);
    server.set_pre_routing_handler([this](const Request& request, Response& response) {
      if (FromAnotherPage(request.get_header_value("Host"), request.get_header_value("Origin"),
                          request.get_header_value("Sec-Fetch-Site"))) {
        Refuse(response, kForbidden, "another page asked for this");
        return Library::HandlerResponse::Handled;
      }
      if (Allowed(request)) return Library::HandlerResponse::Unhandled;
      Refuse(response, kForbidden, "open the address with the token that amb dash printed");
      return Library::HandlerResponse::Handled;
    });
    server.Get(kEvents, [this](const Request&, Response& response) { Stream(response); });
    for (const Route& route : routes) Serve(route);
    ServePage();  // last: it takes every other path
    Bind();
    door.emplace(server.listening(), [this](Asked& asked) {
      if (IsStop(asked.request)) return Stop(std::move(asked));
      return LaneOf(asked.request).Put(asked);
    });
  }

  ~Impl() {
    hub.Close();
    stop_desk.Close();
    door->Close();  // the lanes end before it goes: they hand their connections back to it
  }

  Lane& LaneOf(const RequestReader& request) {
    if (request.path() == kEvents) return viewer_lane;
    return request.post() ? command_lane : page_lane;
  }

  [[nodiscard]] bool IsStop(const RequestReader& request) const {
    return stop.asks && request.post() && request.path() == kCommand &&
           stop.asks(std::string(request.body()));
  }

  /// In the front door's thread, which is the only one that passes here.
  bool Stop(Asked asked) {
    stop_passed = false;
    const std::string refusal = server.Ask(asked.request);
    if (!stop_passed) {
      (void)::send(asked.connection.handle(), refusal.data(), refusal.size(),
                   MSG_DONTWAIT | MSG_NOSIGNAL);
      door->SeeOut(std::move(asked.connection));
      return true;
    }
    stop.stop(stop_desk.Wait(std::move(asked.connection)));
    return true;
  }

  void Answer(Asked asked) {
    server.Answer(asked);
    door->SeeOut(std::move(asked.connection));
  }

  [[nodiscard]] bool Allowed(const Request& request) const {
    if (options.token.empty()) return HostIsLoopback(request.get_header_value("Host"));
    const std::string given = request.has_header("X-Levitas-Token")
                                  ? request.get_header_value("X-Levitas-Token")
                                  : request.get_param_value("token");
    // The page's parts hold nothing worth hiding and are loaded without the token.
    return TokenMatches(given, options.token) || FindPageFile(request.path) != nullptr;
  }

  void Serve(const Route& route) {
    const auto handler = [this, &route](const Request& request, Response& response) {
      if (route.post && !request.has_header("X-Levitas")) {
        Refuse(response, kForbidden, "the header X-Levitas is missing");
        return;
      }
      if (route.post && stop.asks && route.path == std::string_view(kCommand) &&
          stop.asks(request.body)) {
        stop_passed = true;  // this answer is not sent
        return;
      }
      const HttpAnswer answer = route.answer(request.body);
      response.status = answer.status;
      response.set_header("Cache-Control", "no-store");
      response.set_content(answer.body, answer.type);
    };
    if (route.post) {
      server.Post(route.path, handler);
    } else {
      server.Get(route.path, handler);
    }
  }

  void ServePage() {
    server.Get(".*", [](const Request& request, Response& response) {
      const PageFile* file = FindPageFile(request.path);
      if (file == nullptr) {
        response.status = 404;
        return;
      }
      response.set_header("Cache-Control", "no-store");
      response.set_header("Content-Security-Policy",
                          "default-src 'self'; style-src 'self' 'unsafe-inline'; "
                          "img-src 'self' data:; frame-ancestors 'none'");
      response.set_content(std::string(file->content), file->type);
    });
  }

  void Stream(Response& response) {
    if (viewers.fetch_add(1) >= kMaxViewers) {
      viewers.fetch_sub(1);
      Refuse(response, kUnavailable, "too many viewers: close one of them");
      return;
    }
    auto seen = std::make_shared<Seen>();
    response.set_header("Cache-Control", "no-store");
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, seen](std::size_t, httplib::DataSink& sink) {
          const std::string part = hub.Wait(*seen, kHeartbeat);
          if (hub.closed()) return false;
          // A comment now and then: without it a browser that has gone would never be noticed.
          const std::string& sent = part.empty() ? kComment : part;
          return sink.write(sent.data(), sent.size());
        },
        [this](bool) { viewers.fetch_sub(1); });
  }

  void Bind() {
    const int tries = options.any_port ? kPortsTried : 1;
    for (int i = 0; i < tries; ++i) {
      if (options.port == 0) {
        port = server.bind_to_any_port(options.address);
        if (port > 0) return;
      } else if (server.bind_to_port(options.address, options.port + i)) {
        port = options.port + i;
        return;
      }
    }
    throw Problem(ExitStatus::kOther,
                  fmt::format("the page cannot be served at {} port {}: the address is not this "
                              "machine's, or the port is taken; choose with --listen and "
                              "--http-port",
                              options.address, options.port));
  }

  inline static const std::string kComment{": still here\n\n"};

  WebOptions options;
  Hub& hub;
  const std::vector<Route> routes;
  const StopRoute stop;
  bool stop_passed{false};
  std::atomic<int> viewers{0};
  int port{0};
  Library server;
  std::optional<FrontDoor> door;
  const Lane::Serve serve{[this](Asked asked) { Answer(std::move(asked)); }};
  StopDesk stop_desk{kMostStops, [this](FileDescriptor one) { door->SeeOut(std::move(one)); }};
  Lane command_lane{kCommandThreads, kMostWaiting, serve};
  Lane page_lane{kPageThreads, kMostWaiting, serve};
  Lane viewer_lane{kViewerThreads, kMostWaiting, serve};
};

WebServer::WebServer(const WebOptions& options, Hub& hub, std::vector<Route> routes, StopRoute stop)
    : impl_(std::make_unique<Impl>(options, hub, std::move(routes), std::move(stop))) {}

WebServer::~WebServer() = default;

std::string WebServer::Url() const {
  const std::string& address = impl_->options.address;
  const bool six = address.find(':') != std::string::npos;
  const std::string token =
      impl_->options.token.empty() ? "" : fmt::format("?token={}", impl_->options.token);
  return fmt::format("http://{}{}{}:{}/{}", six ? "[" : "", address, six ? "]" : "", impl_->port,
                     token);
}

int WebServer::viewers() const noexcept { return impl_->viewers.load(); }

}  // namespace levitas::dashboard
