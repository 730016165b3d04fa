#include "node/transport/bytes_transport.h"

#include <utility>

#include "node/transport/packets/pack_result.h"
#include "node/transport/packets/packets_to_backend.h"
#include "node/transport/packets/packets_to_frontend.h"
#include "node/transport/traffic_counters.h"

namespace grove::node {

BytesTransport::BytesTransport(pipeline::Executor& executor, pipeline::Timeline& timeline)
    : timeline_(timeline),
      traffic_(std::make_shared<TrafficCounters>()),
      toFrontend_(std::make_shared<PacketsToFrontend>(executor, timeline)),
      toBackend_(std::make_shared<PacketsToBackend>(executor, timeline, *this)) {}

BytesTransport::~BytesTransport() {
  toBackend_->close();
  toFrontend_->close();
}

void BytesTransport::connect(BackendPort& backend) { toBackend_->connect(backend); }

void BytesTransport::connect(FrontendPort& frontend) { toFrontend_->connect(frontend); }

void BytesTransport::leaveBackend() { toBackend_->leave(); }

void BytesTransport::leaveFrontend() { toFrontend_->leave(); }

pipeline::PushResult BytesTransport::send(ToBackend message) {
  Packet packet = encode(message);
  traffic_->countToBackend(packet);
  if (const auto control = controlNameOf(message)) return toBackend_->sendControl(*control, std::move(packet));
  return toBackend_->send(std::move(packet));
}

pipeline::PushResult BytesTransport::send(ToFrontend message) {
  Packet packet = encode(message);
  traffic_->countHeader(packet);
  traffic_->countBulk(message);
  if (const auto control = controlNameOf(message)) return toFrontend_->sendControl(*control, std::move(packet));
  // The copy that a socket would make.
  if (packet.bulk) packet.bulk = std::make_shared<const PackedBytes>(*packet.bulk);
  const pipeline::PushResult result = toFrontend_->send(std::move(packet));
  if (result != pipeline::PushResult::kAccepted) timeline_.count("messages rejected by a full link");
  return result;
}

void BytesTransport::compress(Result& result, std::string_view subject) const {
  packResult(result, timeline_, subject);
}

LinkTraffic BytesTransport::traffic() const { return traffic_->read(); }

}  // namespace grove::node
