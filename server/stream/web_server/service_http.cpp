#include <libwebsockets.h>

#include <string>
#include <utility>
#include <vector>

#include "pipeline/clocks.h"
#include "stream/web_server/access/eviction.h"
#include "stream/web_server/service.h"
#include "stream/web_server/wsi.h"

namespace grove::stream {
namespace {

/// Reserved for the operator.
constexpr std::size_t kOperatorSockets = 8;

}  // namespace

int WebsocketServer::Service::handleHttp(lws* wsi, lws_callback_reasons reason, void* user, void* in,
                                         std::size_t length) {
  switch (reason) {
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
      return confirmUpgrade(wsi, static_cast<const char*>(in));
    case LWS_CALLBACK_HTTP:
      return answer(wsi);
    case LWS_CALLBACK_HTTP_WRITEABLE:
      return resume(wsi);
    case LWS_CALLBACK_CLOSED_HTTP:
      http(wsi).forget(wsi);
      return 0;
    default:
      return lws_callback_http_dummy(wsi, reason, user, in, length);
  }
}

bool WebsocketServer::Service::letIn(lws* listener, const lws_filter_network_conn_args* peer) {
  const bool isOperators = context_.audienceOf(listener) == Audience::kOperator;
  const std::string address = numericAddress(peer->cli_addr);
  if (!entrance_.allowsSocket(address)) return false;
  if (guests_.size() < (isOperators ? maxSockets_ : maxSockets_ - kOperatorSockets) || evictOne()) return true;
  entrance_.refuseFull(address, guests_.size());
  return false;
}

bool WebsocketServer::Service::evictOne() {
  std::vector<lws*> sockets;
  std::vector<Evictable> evictable;
  for (const auto& [wsi, guest] : guests_) {
    bool isBusy = guest.hasAsked && http(wsi).isAnswering(wsi);
    if (const auto found = sockets_.find(wsi); found != sockets_.end()) {
      const auto& [connection, early, closing] = found->second;
      if (connection && connection->isInWorld()) continue;
      isBusy = early && early->hasSentMessages();
    }
    sockets.push_back(wsi);
    evictable.push_back({guest.owner, guest.accepted, isBusy});
  }
  const auto chosen = chooseEvicted(evictable);
  if (!chosen) return false;
  lws* const wsi = sockets[*chosen];
  entrance_.reportEvicted(nameOfPeer(wsi));
  lws_set_timeout(wsi, PENDING_TIMEOUT_CLOSE_SEND, LWS_TO_KILL_SYNC);
  return true;
}

void WebsocketServer::Service::instantiate(lws* wsi) {
  const std::string address = addressOfPeer(wsi);
  Guest& guest = guests_[wsi];
  guest.accepted = guest.since = pipeline::wallSeconds();
  guest.isProxy = entrance_.isProxy(address);
  if (guest.isProxy) return;
  guest.owner = guestOf(address);
  guest.ticket = entrance_.socket(address);
}

int WebsocketServer::Service::answer(lws* wsi) {
  const RequestSource source = entrance_.sourceOf(wsi);
  Guest& guest = guests_[wsi];
  guest.hasAsked = true;
  if (source.isForwarded) guest.ticket.reset();
  auto refusal = entrance_.refuseRequest(wsi, source, context_.isSecure(context_.audienceOf(wsi)));
  if (source.isForwarded) guest.ticket = entrance_.socket(source.address);
  const int result = http(wsi).answer(wsi, std::move(refusal));
  giveBackAnswered(wsi);
  return result;
}

int WebsocketServer::Service::resume(lws* wsi) {
  const int result = http(wsi).resume(wsi);
  giveBackAnswered(wsi);
  return result;
}

void WebsocketServer::Service::giveBackAnswered(lws* wsi) {
  Guest& guest = guests_[wsi];
  if (guest.isProxy && !http(wsi).isAnswering(wsi)) guest.ticket.reset();
}

int WebsocketServer::Service::confirmUpgrade(lws* wsi, std::string_view protocol) {
  // Also refuses an upgrade to HTTP/2, where large writes make browsers close the connection.
  if (protocol != "websocket") return -1;
  const auto refuse = [&](unsigned status) { return lws_return_http_status(wsi, status, nullptr) < 0 ? -1 : 1; };
  const Audience audience = context_.audienceOf(wsi);
  if (audience == Audience::kOperator || header(wsi, WSI_TOKEN_GET_URI) != "/") return refuse(HTTP_STATUS_NOT_FOUND);
  Guest& guest = guests_[wsi];
  guest.source = entrance_.sourceOf(wsi);
  if (guest.source.isForwarded) guest.ticket.reset();
  if (const auto status = entrance_.refuseUpgrade(wsi, guest.source, context_.isSecure(audience))) {
    return refuse(*status);
  }
  if (guest.source.isForwarded) {
    guest.ticket = entrance_.socket(guest.source.address);
    guest.owner = guestOf(guest.source.address);
  }
  return 0;
}

}  // namespace grove::stream
