#include <libwebsockets.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "pipeline/clocks.h"
#include "stream/web_server/received_bytes.h"
#include "stream/web_server/service.h"
#include "stream/web_server/wsi.h"

namespace grove::stream {
namespace {

constexpr int kCloseSeconds = 2;
/// Bytes of one socket, including pings and requests: twenty times what a visitor at 60 frames a second sends.
constexpr double kMaxReceivedPerSecond = 65'536.0;

}  // namespace

Waiting WebsocketServer::Service::preparation() const {
  const std::lock_guard lock(preparationMutex_);
  return {.place = 1, .percent = preparation_.percent(), .step = preparation_.step()};
}

void WebsocketServer::Service::open(Host& host) {
  ready_ = &host;
  waker_->wake();
}

void WebsocketServer::Service::admit() {
  host_ = ready_;
  entrance_.open(*host_);
  reports_.emplace(*host_, [waker = waker_] { waker->wake(); });
  for (HttpService& each : http_) each.open(*reports_);
  for (auto& [wsi, socket] : sockets_) {
    if (socket.closing) continue;
    socket.connection = connect(wsi);
    if (auto why = socket.early->replayTo(*socket.connection, pipeline::wallSeconds())) {
      closeLater(wsi, socket, std::move(*why));
    }
    socket.early.reset();
  }
}

void WebsocketServer::Service::open(lws* wsi) {
  Socket& socket = sockets_[wsi];
  if (host_ != nullptr) {
    socket.connection = connect(wsi);
  } else {
    socket.early.emplace(subProtocolOf(wsi));
  }
}

std::unique_ptr<Connection> WebsocketServer::Service::connect(lws* wsi) {
  const auto wake = [waker = waker_] { waker->wake(); };
  const RequestSource& source = guests_[wsi].source;
  const auto takePlace = [this, address = source.address] { return entrance_.visitor(address); };
  return std::make_unique<Connection>(*host_, source.name, pipeline::wallSeconds(), wake,
                                      Connection::Door{takePlace, visitorLog_}, subProtocolOf(wsi));
}

int WebsocketServer::Service::receive(lws* wsi, std::span<const std::uint8_t> bytes) {
  const auto found = sockets_.find(wsi);
  if (found == sockets_.end()) return -1;
  auto& [connection, early, closing] = found->second;
  if (closing) return 0;
  const MessagePiece piece{bytes, lws_is_first_fragment(wsi) != 0, lws_is_final_fragment(wsi) != 0,
                           lws_frame_is_binary(wsi) != 0};
  closing = early ? early->receive(piece) : connection->receive(piece, pipeline::wallSeconds());
  if (closing) {
    giveCloseReason(wsi, *closing);
    return -1;
  }
  if (connection && connection->hasSomethingToSend()) lws_callback_on_writable(wsi);
  return 0;
}

int WebsocketServer::Service::write(lws* wsi) {
  const auto found = sockets_.find(wsi);
  if (found == sockets_.end()) return -1;
  auto& [connection, early, closing] = found->second;
  if (closing) {
    giveCloseReason(wsi, *closing);
    return -1;
  }
  if (connection && connection->takePing()) {
    std::array<std::uint8_t, LWS_PRE> nothing{};
    if (lws_write(wsi, nothing.data() + LWS_PRE, 0, LWS_WRITE_PING) < 0) return -1;
    lws_callback_on_writable(wsi);
    return 0;
  }
  std::vector<std::uint8_t> buffer;
  if (connection) {
    buffer = connection->takeMessage();
  } else if (const Waiting waiting = preparation(); early->wants(waiting, pipeline::wallSeconds())) {
    buffer = early->take(waiting, pipeline::wallSeconds());
  }
  if (!buffer.empty()) {
    buffer.insert(buffer.begin(), LWS_PRE, 0);
    if (lws_write(wsi, buffer.data() + LWS_PRE, buffer.size() - LWS_PRE, LWS_WRITE_BINARY) < 0) return -1;
    lws_callback_on_writable(wsi);
    return 0;
  }
  if (!connection) return 0;
  const std::shared_ptr<const EncodedFrame> frame = connection->takeFrame();
  if (!frame) return 0;
  const auto message = frame->message();
  // The library writes only into the headroom before the message.
  auto* bytes = const_cast<std::uint8_t*>(message.data());
  if (lws_write(wsi, bytes, message.size(), LWS_WRITE_BINARY) < 0) return -1;
  connection->written(*frame, pipeline::wallSeconds());
  if (connection->hasSomethingToSend()) lws_callback_on_writable(wsi);
  return 0;
}

void WebsocketServer::Service::ponged(lws* wsi) {
  const auto found = sockets_.find(wsi);
  if (found != sockets_.end() && found->second.connection) found->second.connection->ponged();
}

void WebsocketServer::Service::close(lws* wsi) {
  const auto found = sockets_.find(wsi);
  if (found == sockets_.end()) return;
  if (found->second.connection) found->second.connection->leave("the connection has ended");
  sockets_.erase(found);
}

void WebsocketServer::Service::closeLater(lws* wsi, Socket& socket, Refusal why) {
  if (socket.closing) return;
  if (socket.connection) socket.connection->end(why);
  socket.closing = std::move(why);
  lws_callback_on_writable(wsi);
  // A socket whose browser does not read never becomes writable.
  lws_set_timeout(wsi, PENDING_TIMEOUT_CLOSE_SEND, kCloseSeconds);
}

void WebsocketServer::Service::wakeWriters() {
  if (host_ == nullptr && ready_ != nullptr) admit();
  const Waiting waiting = preparation();
  const double now = pipeline::wallSeconds();
  for (const auto& [wsi, socket] : sockets_) {
    const bool wants =
        socket.connection ? socket.connection->hasSomethingToSend() : socket.early && socket.early->wants(waiting, now);
    if (wants) lws_callback_on_writable(wsi);
    if (socket.connection) socket.connection->reach(now);
  }
  for (HttpService& each : http_) each.wakeWaiting();
}

void WebsocketServer::Service::sweep() {
  const double now = pipeline::wallSeconds();
  std::vector<lws*> floods;
  for (auto& [wsi, guest] : guests_) {
    if (isFlood(wsi, guest, now)) floods.push_back(wsi);
  }
  for (lws* const wsi : floods) {
    const auto socket = sockets_.find(wsi);
    if (socket != sockets_.end()) {
      // Leaves unread what arrives before the close.
      lws_rx_flow_control(wsi, 0);
      closeLater(wsi, socket->second, {CloseCode::kFlood, "more than 64 KiB in a second"});
    } else {
      // At once, because its next request would extend any timeout.
      lws_set_timeout(wsi, PENDING_TIMEOUT_CLOSE_SEND, LWS_TO_KILL_SYNC);
    }
  }
  for (auto& [wsi, socket] : sockets_) {
    if (!socket.connection) continue;
    if (auto why = socket.connection->overdue(now)) closeLater(wsi, socket, std::move(*why));
  }
  // Nothing wakes the thread for progress of the preparation and of refining.
  wakeWriters();
  entrance_.sweep(now);
}

bool WebsocketServer::Service::isFlood(lws* wsi, Guest& guest, double now) const {
  // A proxy's socket carries requests of many visitors; these are limited by number.
  if (guest.isProxy && !sockets_.contains(wsi)) return false;
  const double seconds = now - guest.since;
  const std::uint64_t received = receivedBytes(lws_get_socket_fd(wsi));
  const auto more = static_cast<double>(received - guest.received);
  if (seconds >= 1.0) {
    guest.since = now;
    guest.received = received;
  }
  return more > kMaxReceivedPerSecond * std::max(1.0, seconds);
}

}  // namespace grove::stream
