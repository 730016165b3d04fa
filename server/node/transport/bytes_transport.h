#pragma once

#include <memory>
#include <string_view>

#include "node/transport/transport.h"

namespace grove::node {

class PacketsToBackend;
class PacketsToFrontend;
class TrafficCounters;

/// Both ends in one process, but every message is encoded, decoded and checked, as over a socket. Messages keep their
/// order in each direction. A direction holds at most 4096 packets and 64 MiB; further messages are refused, or, from a
/// backend node, dropped and counted.
class BytesTransport final : public Transport {
 public:
  /// Both outlive it.
  BytesTransport(pipeline::Executor& executor, pipeline::Timeline& timeline);
  ~BytesTransport() override;
  BytesTransport(const BytesTransport&) = delete;
  BytesTransport& operator=(const BytesTransport&) = delete;

  [[nodiscard]] bool sharesMemory() const override { return false; }
  void connect(BackendPort& backend) override;
  void connect(FrontendPort& frontend) override;
  void leaveBackend() override;
  void leaveFrontend() override;
  pipeline::PushResult send(ToBackend message) override;
  pipeline::PushResult send(ToFrontend message) override;
  void compress(Result& result, std::string_view subject) const override;
  [[nodiscard]] LinkTraffic traffic() const override;

 private:
  pipeline::Timeline& timeline_;
  const std::shared_ptr<TrafficCounters> traffic_;
  const std::shared_ptr<PacketsToFrontend> toFrontend_;
  const std::shared_ptr<PacketsToBackend> toBackend_;
};

}  // namespace grove::node
