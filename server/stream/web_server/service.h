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

/// The library's context and its thread. All but start(), stop() and port() runs on that thread.
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
  /// Any socket that was let in.
  struct Guest {
    AddressLimits::Ticket ticket;  ///< of a proxy's: for whom it works at the moment
    bool isProxy = false;
    std::string owner;           ///< as of guestOf(); empty: a proxy's that is no websocket, or this machine's
    bool hasAsked = false;       ///< it has sent a whole request
    double accepted = 0.0;       ///< when
    RequestSource source;        ///< of the request that became a websocket
    double since = 0.0;          ///< when it had received
    std::uint64_t received = 0;  ///< so many bytes
  };
  /// One that has become a websocket.
  struct Socket {
    std::unique_ptr<Connection> connection;  ///< null until the world is ready; then
    std::optional<EarlyVisitor> early;       ///< this is nothing
    std::optional<Refusal> closing;
  };
  /// Standard layout, so that the library's timer leads back to the service.
  struct Timer {
    lws_sorted_usec_list_t entry{};
    Service* service = nullptr;
  };

  static int callback(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) noexcept;
  static void onTimer(lws_sorted_usec_list_t* entry) noexcept;
  int handle(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length);
  int handleHttp(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length);

  [[nodiscard]] bool letIn(lws* listener, const lws_filter_network_conn_args* peer);
  /// Closes a socket that asks for nothing, so that a newcomer has a place; false if there is none.
  [[nodiscard]] bool evictOne();
  void instantiate(lws* wsi);
  int answer(lws* wsi);
  int resume(lws* wsi);
  /// A socket of a proxy works for nobody between two requests.
  void giveBackAnswered(lws* wsi);
  int confirmUpgrade(lws* wsi, std::string_view protocol);
  [[nodiscard]] HttpService& http(lws* wsi) { return http_[static_cast<std::size_t>(context_.audienceOf(wsi))]; }

  void open(lws* wsi);
  [[nodiscard]] std::unique_ptr<Connection> connect(lws* wsi);
  /// Once the world is ready.
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
  Host* host_ = nullptr;  ///< null until who waits is let in
  mutable std::mutex preparationMutex_;
  StepProgress preparation_;  ///< of the world
  Entrance entrance_;
  const std::size_t maxSockets_;
  std::map<lws*, Guest> guests_;
  log::Limited visitorLog_;  ///< before the connections that use it
  std::map<lws*, Socket> sockets_;
  ServerContext context_;
  const std::shared_ptr<Waker> waker_;
  std::optional<LiveReports> reports_;  ///< once the world is ready
  std::array<HttpService, 2> http_;     ///< by audience
  int port_ = 0;
  int operatorPort_ = 0;
  Timer timer_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace grove::stream
