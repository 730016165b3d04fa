#pragma once

#include <libwebsockets.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>

#include "base/log.h"
#include "stream/session/step_progress.h"
#include "stream/web_server/access/entrance.h"
#include "stream/web_server/connection.h"
#include "stream/web_server/early_visitor.h"
#include "stream/web_server/pages/http_service.h"
#include "stream/web_server/pages/live_reports.h"
#include "stream/web_server/server_context.h"
#include "stream/web_server/waker.h"
#include "stream/web_server/websocket_server.h"

namespace grove::stream {

/// libwebsockets' context and its thread. All but start(), stop(), report(), open(Host&) and port() runs on that
/// thread.
class WebsocketServer::Service {
 public:
  explicit Service(const ServerOptions& options);
  ~Service() { stop(); }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  [[nodiscard]] int port() const noexcept { return port_; }
  [[nodiscard]] int operatorPort() const noexcept { return operatorPort_; }
  [[nodiscard]] bool isSecure(Audience audience) const { return context_.isSecure(audience); }
  void start();
  void stop();
  void report(std::string_view step, float share);
  void open(Host& host);

 private:
  /// Any accepted socket.
  struct Guest {
    AddressLimits::Ticket ticket;  ///< of a proxy's socket: of the visitor whose request is in progress
    bool isProxy = false;
    std::string owner;           ///< see guestOf(); empty: a proxy's that is not a websocket, or this machine's
    bool hasAsked = false;       ///< has sent a whole request
    double accepted = 0.0;       ///< time, seconds
    RequestSource source;        ///< of the request that became a websocket
    double since = 0.0;          ///< start of the current second of flood detection
    std::uint64_t received = 0;  ///< bytes received before that
  };
  /// A socket that has become a websocket.
  struct Socket {
    std::unique_ptr<Connection> connection;  ///< null until the world is ready
    std::optional<EarlyVisitor> early;       ///< only until then
    std::optional<Refusal> closing;
  };
  /// Standard layout, so that onTimer() can cast the library's entry to it.
  struct Timer {
    lws_sorted_usec_list_t entry{};
    Service* service = nullptr;
  };

  static int callback(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) noexcept;
  static void onTimer(lws_sorted_usec_list_t* entry) noexcept;
  int handle(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length);
  int handleHttp(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length);

  [[nodiscard]] bool letIn(lws* listener, const lws_filter_network_conn_args* peer);
  /// Closes an idle socket, so that a new one has a place; false if there is none.
  [[nodiscard]] bool evictOne();
  void instantiate(lws* wsi);
  int answer(lws* wsi);
  int resume(lws* wsi);
  /// Between two requests, a proxy's socket counts for no visitor.
  void giveBackAnswered(lws* wsi);
  int confirmUpgrade(lws* wsi, std::string_view protocol);
  [[nodiscard]] HttpService& http(lws* wsi) { return http_[static_cast<std::size_t>(context_.audienceOf(wsi))]; }

  void open(lws* wsi);
  [[nodiscard]] std::unique_ptr<Connection> connect(lws* wsi);
  /// Connects the visitors who wait; called once, when the world is ready.
  void admit();
  [[nodiscard]] Waiting preparation() const;
  int receive(lws* wsi, std::span<const std::uint8_t> bytes);
  int write(lws* wsi);
  void ponged(lws* wsi);
  void close(lws* wsi);
  void closeLater(lws* wsi, Socket& socket, Refusal why);
  void wakeWriters();
  void sweep();
  [[nodiscard]] bool isFlood(lws* wsi, Guest& guest, double now) const;
  void run();

  std::atomic<Host*> ready_{nullptr};
  Host* host_ = nullptr;  ///< null until admit()
  mutable std::mutex preparationMutex_;
  StepProgress preparation_;  ///< of the world's preparation
  Entrance entrance_;
  const std::size_t maxSockets_;
  std::map<lws*, Guest> guests_;
  log::Limited visitorLog_;  ///< declared before the connections that use it
  std::map<lws*, Socket> sockets_;
  ServerContext context_;
  const std::shared_ptr<Waker> waker_;
  std::optional<LiveReports> reports_;  ///< none until the world is ready
  std::array<HttpService, 2> http_;     ///< by audience
  int port_ = 0;
  int operatorPort_ = 0;
  Timer timer_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace grove::stream
