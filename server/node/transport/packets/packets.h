#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <utility>

#include "base/log.h"
#include "node/limits.h"
#include "node/messages/wire/wire.h"
#include "node/transport/connection.h"
#include "node/transport/control_backlog.h"
#include "pipeline/stage.h"

namespace grove::node {

/// Limit of the bytes that wait in one direction of a link.
inline constexpr std::size_t kMaxWaitingBytes = std::size_t{64} << 20U;

/// One direction of a link that carries bytes: packets wait for a worker, which decodes them in order and passes them
/// to the port at the end. Without a port, they are dropped.
template <class Port>
class Packets : public pipeline::Stage<Packet> {
 public:
  Packets(const pipeline::StageOptions& options, pipeline::Executor& executor, pipeline::Timeline& timeline)
      : Stage(options, executor, timeline), timeline_(timeline) {}

  /// Sets a callback for flow control: a worker calls `onRoom` after each run. Call it before the first send().
  void whenRoom(std::function<void()> onRoom) { onRoom_ = std::move(onRoom); }
  /// Whether half of the permitted bytes or packets wait.
  [[nodiscard]] bool isHalfFull() const {
    return waiting_ > kMaxWaitingBytes / 2 || this->queued() > kBackendQueue / 2;
  }

  void connect(Port& port) { receiver_.connect(port); }
  /// Waits for receive calls in progress.
  void leave() { receiver_.leave(); }

  [[nodiscard]] pipeline::PushResult send(Packet packet) { return enqueue(std::move(packet)); }
  /// As send(), for a control message, which waits beside the link while it is full.
  [[nodiscard]] pipeline::PushResult sendControl(const std::string& name, Packet packet) {
    const std::lock_guard lock(backlogMutex_);
    if (backlog_.empty()) {
      const pipeline::PushResult result = enqueue(packet);
      if (result != pipeline::PushResult::kRejected) return result;
    }
    backlog_.put(name, std::move(packet));
    // The run that would have offered it may have ended in between.
    offerBacklog();
    return pipeline::PushResult::kAccepted;
  }

 protected:
  /// Decodes a packet and passes it on.
  virtual void deliver(const Packet& packet, Port& port) = 0;

  void process(std::span<Packet> packets, pipeline::Run&) final {
    receiver_.use([&](Port* port) {
      for (const Packet& packet : packets) {
        waiting_ -= packet.bytes();
        if (port != nullptr) attempt([&] { deliver(packet, *port); }, [](const std::string&) {});
      }
    });
    {
      const std::lock_guard lock(backlogMutex_);
      offerBacklog();
    }
    if (onRoom_) onRoom_();
  }

  /// Refuses only this message: others of the same peer may be valid.
  void refuse(const WireError& error) {
    timeline_.count("refused messages");
    refusals_.warning(error.reason);
  }

 private:
  pipeline::PushResult enqueue(Packet packet) {
    const std::size_t bytes = packet.bytes();
    if (waiting_.fetch_add(bytes) + bytes > kMaxWaitingBytes) {
      waiting_ -= bytes;
      return pipeline::PushResult::kRejected;
    }
    const pipeline::PushResult result = push(std::move(packet));
    if (result != pipeline::PushResult::kAccepted) waiting_ -= bytes;
    return result;
  }
  void offerBacklog() {
    backlog_.offer([this](const Packet& packet) { return enqueue(packet) == pipeline::PushResult::kAccepted; });
  }

  pipeline::Timeline& timeline_;
  Connection<Port> receiver_;
  std::function<void()> onRoom_;
  std::atomic<std::size_t> waiting_{0};  ///< bytes
  std::mutex backlogMutex_;
  ControlBacklog<Packet> backlog_;
  log::Limited refusals_;
};

}  // namespace grove::node
