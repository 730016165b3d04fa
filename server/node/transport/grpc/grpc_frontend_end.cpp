#include "node/transport/grpc/grpc_frontend_end.h"

#include <utility>

#include "node/transport/grpc/reconnecting/reconnecting_link.h"

namespace grove::node {

GrpcFrontendEnd::GrpcFrontendEnd(std::string address, pipeline::Executor& executor, pipeline::Timeline& timeline,
                                 LinkTls tls, const std::string& role)
    : link_(std::make_shared<ReconnectingLink>(std::move(address), executor, timeline, std::move(tls), role)) {
  link_->start();
}

GrpcFrontendEnd::~GrpcFrontendEnd() { link_->stop(); }

void GrpcFrontendEnd::connect(FrontendPort& frontend) { link_->frontend().connect(frontend); }

void GrpcFrontendEnd::leaveFrontend() { link_->frontend().leave(); }

pipeline::PushResult GrpcFrontendEnd::send(ToBackend message) { return link_->send(message); }

LinkTraffic GrpcFrontendEnd::traffic() const { return link_->traffic(); }

GrpcFrontendEnd::Status GrpcFrontendEnd::status() const { return link_->status(); }

LinkPace GrpcFrontendEnd::pace() const { return link_->pace(); }

GrpcFrontendEnd::Status GrpcFrontendEnd::waitForAnswer(std::chrono::milliseconds max) const {
  return link_->waitForAnswer(max);
}

bool GrpcFrontendEnd::waitUntilOpen(std::chrono::milliseconds max) const { return link_->waitUntilOpen(max); }

}  // namespace grove::node
