#include "stream/web_server/service.h"

#include <libwebsockets.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <string>
#include <utility>

#include "pipeline/clocks.h"
#include "stream/web_server/descriptor_limit.h"

namespace grove::stream {
namespace {

constexpr double kStopSeconds = 1.0;
/// The library answers pings itself, so a flood of them lasts until the next sweep.
constexpr lws_usec_t kSweepMicroseconds = 100'000;

}  // namespace

WebsocketServer::Service::Service(const ServerOptions& options)
    : entrance_(options.rules),
      maxSockets_(std::min(options.maxSockets, socketsThatFit())),
      context_(&Service::callback, this, maxSockets_, options.tls),
      waker_(std::make_shared<Waker>(context_.get())),
      http_{HttpService(Audience::kVisitors, options.hsts), HttpService(Audience::kOperator, std::nullopt)} {
  const HostPort operatorAddress = options.operators.value_or(HostPort{"127.0.0.1", 0});
  try {
    port_ = context_.listen(Audience::kVisitors, options.visitors.host, options.visitors.port, "--listen");
    operatorPort_ = context_.listen(Audience::kOperator, operatorAddress.host, operatorAddress.port, "--operator");
  } catch (...) {
    // Its destructor calls back into members that would be destroyed before it.
    context_.close();
    throw;
  }
  entrance_.addName(options.visitors.host);
  entrance_.addName(operatorAddress.host);
  timer_.service = this;
}

void WebsocketServer::Service::start() {
  assert(!thread_.joinable());
  if (ready_ != nullptr) admit();
  lws_sul_schedule(context_.get(), 0, &timer_.entry, &Service::onTimer, kSweepMicroseconds);
  thread_ = std::thread([this] { run(); });
}

void WebsocketServer::Service::stop() {
  if (stopping_.exchange(true)) return;
  waker_->wake();
  if (thread_.joinable()) thread_.join();
  waker_->retire();
  context_.close();
  sockets_.clear();
  guests_.clear();
  reports_.reset();
}

void WebsocketServer::Service::report(std::string_view step, float share) {
  const std::lock_guard lock(preparationMutex_);
  preparation_.update(step, share, pipeline::wallSeconds());
}

void WebsocketServer::Service::run() {
  std::optional<double> deadline;
  while (true) {
    if (stopping_) {
      if (!deadline) {
        deadline = pipeline::wallSeconds() + kStopSeconds;
        for (auto& [wsi, socket] : sockets_) closeLater(wsi, socket, {CloseCode::kGoingAway, "the server stops"});
      }
      if (sockets_.empty() || pipeline::wallSeconds() > *deadline) return;
    }
    if (lws_service(context_.get(), 0) < 0) return;
  }
}

int WebsocketServer::Service::callback(lws* wsi, lws_callback_reasons reason, void* user, void* in,
                                       std::size_t length) noexcept {
  auto* self = static_cast<Service*>(lws_context_user(lws_get_context(wsi)));
  if (self == nullptr) return 0;
  try {
    return self->handle(wsi, reason, user, in, length);
  } catch (const std::exception& e) {
    log::error(std::string("websocket: ") + e.what());
  } catch (...) {
    log::error("websocket: unknown exception");
  }
  return -1;
}

void WebsocketServer::Service::onTimer(lws_sorted_usec_list_t* entry) noexcept {
  Service* self = reinterpret_cast<Timer*>(entry)->service;
  try {
    self->sweep();
  } catch (const std::exception& e) {
    log::error(std::string("websocket: ") + e.what());
  }
  lws_sul_schedule(self->context_.get(), 0, entry, &Service::onTimer, kSweepMicroseconds);
}

int WebsocketServer::Service::handle(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
  switch (reason) {
    case LWS_CALLBACK_FILTER_NETWORK_CONNECTION:
      return letIn(wsi, static_cast<const lws_filter_network_conn_args*>(user)) ? 0 : 1;
    case LWS_CALLBACK_SERVER_NEW_CLIENT_INSTANTIATED:
      instantiate(wsi);
      return 0;
    case LWS_CALLBACK_OPENSSL_LOAD_EXTRA_SERVER_VERIFY_CERTS:
      context_.prepare(static_cast<SSL_CTX*>(user));
      return 0;
    case LWS_CALLBACK_WSI_DESTROY:
      guests_.erase(wsi);
      for (HttpService& each : http_) each.forget(wsi);
      close(wsi);
      return 0;
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      wakeWriters();
      return 0;
    case LWS_CALLBACK_ESTABLISHED:
      open(wsi);
      return 0;
    case LWS_CALLBACK_RECEIVE:
      return receive(wsi, {static_cast<const std::uint8_t*>(in), length});
    case LWS_CALLBACK_RECEIVE_PONG:
      ponged(wsi);
      return 0;
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return write(wsi);
    case LWS_CALLBACK_CLOSED:
      close(wsi);
      return 0;
    default:
      return handleHttp(wsi, reason, user, in, length);
  }
}

}  // namespace grove::stream
