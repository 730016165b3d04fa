#include "stream/web_server/websocket_server.h"

#include "stream/web_server/service.h"

namespace grove::stream {

WebsocketServer::WebsocketServer(const ServerOptions& options) : service_(std::make_unique<Service>(options)) {}

WebsocketServer::~WebsocketServer() = default;

int WebsocketServer::port() const noexcept { return service_->port(); }

int WebsocketServer::operatorPort() const noexcept { return service_->operatorPort(); }

bool WebsocketServer::isSecure(Audience audience) const { return service_->isSecure(audience); }

void WebsocketServer::start() { service_->start(); }

void WebsocketServer::stop() { service_->stop(); }

void WebsocketServer::report(std::string_view step, float share) { service_->report(step, share); }

void WebsocketServer::open(Host& host) { service_->open(host); }

}  // namespace grove::stream
