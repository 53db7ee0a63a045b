#include "dashboard/web_server.hpp"

#include <fmt/core.h>
#include <httplib.h>
#include <sys/socket.h>

#include <chrono>
#include <thread>
#include <utility>

#include "common/problem.hpp"
#include "dashboard/access.hpp"
#include "dashboard/page_files.hpp"

namespace levitas::dashboard {
namespace {

using httplib::Request;
using httplib::Response;

constexpr std::size_t kThreads = WebServer::kMaxViewers + 16;
constexpr std::size_t kMaxRequestBytes = 64 * 1024;
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

}  // namespace

struct WebServer::Impl {
  Impl(const WebOptions& given, Hub& the_hub, std::vector<Route> the_routes)
      : options(given), hub(the_hub), routes(std::move(the_routes)) {
    // Owned and deleted by the library, whose interface is this pointer.
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory)
    server.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    server.set_socket_options(SetSocketOptions);
    server.set_tcp_nodelay(true);
    server.set_keep_alive_timeout(1);
    server.set_read_timeout(5);
    server.set_write_timeout(3);
    server.set_payload_max_length(kMaxRequestBytes);
    server.set_pre_routing_handler([this](const Request& request, Response& response) {
      if (Allowed(request)) return Server::HandlerResponse::Unhandled;
      Refuse(response, kForbidden, "open the address with the token that amb dash printed");
      return Server::HandlerResponse::Handled;
    });
    server.Get("/events", [this](const Request&, Response& response) { Stream(response); });
    for (const Route& route : routes) Serve(route);
    ServePage();  // last: it takes every other path
    Bind();
    thread = std::thread([this] { server.listen_after_bind(); });
    // Before that, a stop would not be heard.
    while (!server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
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
    const auto handler = [&route](const Request& request, Response& response) {
      if (route.post && !request.has_header("X-Levitas")) {
        Refuse(response, kForbidden, "the header X-Levitas is missing");
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

  using Server = httplib::Server;
  inline static const std::string kComment{": still here\n\n"};

  WebOptions options;
  Hub& hub;
  const std::vector<Route> routes;
  std::atomic<int> viewers{0};
  int port{0};
  Server server;
  std::thread thread;
};

WebServer::WebServer(const WebOptions& options, Hub& hub, std::vector<Route> routes)
    : impl_(std::make_unique<Impl>(options, hub, std::move(routes))) {}

WebServer::~WebServer() {
  impl_->hub.Close();
  impl_->server.stop();
  impl_->thread.join();
}

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
