#include "node/transport/bytes_transport.h"

#include <atomic>
#include <utility>

#include "node/messages/picture_packing.h"
#include "node/transport/packets_to_backend.h"
#include "node/transport/packets_to_frontend.h"

namespace grove::node {

class TrafficCounters {
 public:
  void count(const ToBackend& /*message*/, const Packet& packet) { toBackend_ += packet.header.size(); }
  void count(const ToFrontend& message, const Packet& packet) {
    headers_ += packet.header.size();
    if (!packet.bulk) return;
    (std::get<Result>(message).shared ? sharedData_ : pictures_) += packet.bulk->size();
  }
  [[nodiscard]] LinkTraffic read() const { return {toBackend_, pictures_, sharedData_, headers_}; }

 private:
  std::atomic<std::uint64_t> toBackend_{0};
  std::atomic<std::uint64_t> pictures_{0};
  std::atomic<std::uint64_t> sharedData_{0};
  std::atomic<std::uint64_t> headers_{0};
};

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
  traffic_->count(message, packet);
  return toBackend_->send(std::move(packet));
}

void BytesTransport::send(ToFrontend message) {
  Packet packet = encode(message);
  traffic_->count(message, packet);
  if (toFrontend_->send(std::move(packet)) != pipeline::PushResult::kAccepted) {
    timeline_.count("messages that found their link full");
  }
}

void BytesTransport::compress(Result& result, std::string_view subject) const {
  if (const auto* data = std::get_if<std::shared_ptr<const SharedData>>(&result.payload)) {
    if (*data) result.packed = (*data)->packed(timeline_, subject);
  } else if (const auto* picture = std::get_if<std::shared_ptr<const raster::Image>>(&result.payload)) {
    if (*picture) result.packed = std::make_shared<const PackedBytes>(packPicture(**picture));
  }
  if (result.packed) result.payload = std::shared_ptr<const raster::Image>();
}

LinkTraffic BytesTransport::traffic() const { return traffic_->read(); }

}  // namespace grove::node
