#pragma once

#include <atomic>
#include <cstdint>
#include <variant>

#include "node/messages/wire/wire.h"
#include "node/transport/transport.h"

namespace grove::node {

/// Counts the bytes on a link. Any thread.
class TrafficCounters {
 public:
  /// A packet to the backend node.
  void countToBackend(const Packet& packet) { toBackend_ += packet.header.size(); }
  /// A packet's header to the frontend process.
  void countHeader(const Packet& packet) { headers_ += packet.header.size(); }
  /// The bulk bytes beside a header.
  void countBulk(const ToFrontend& message) {
    const auto* const result = std::get_if<Result>(&message);
    if (result == nullptr || !result->packed) return;
    (result->shared ? sharedData_ : pictures_) += result->packed->size();
  }
  [[nodiscard]] LinkTraffic read() const { return {toBackend_, pictures_, sharedData_, headers_}; }

 private:
  std::atomic<std::uint64_t> toBackend_{0};
  std::atomic<std::uint64_t> pictures_{0};
  std::atomic<std::uint64_t> sharedData_{0};
  std::atomic<std::uint64_t> headers_{0};
};

}  // namespace grove::node
