#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "node/limits.h"
#include "node/transport/control_backlog.h"
#include "node/transport/grpc/link_limits.h"
#include "node/transport/grpc/packet_frame.h"
#include "pipeline/queue.h"

namespace grove::node {

/// One stream of packets each way, on gRPC's reactor of a client or of a server. Outgoing packets wait in a queue of at
/// most kMaxWaitingBytes and kBackendQueue packets. While received packets wait, no more are read, so a sender that is
/// faster than this process fills its own queue. Reactions run on gRPC's threads.
template <class Reactor>
class PacketReactor : public Reactor {
 public:
  /// Refused if it does not fit, closed before the stream is open and after its end. A message with a control name
  /// waits beside a full queue. Any thread.
  [[nodiscard]] pipeline::PushResult write(const Packet& packet, const std::optional<std::string>& control = {}) {
    if (packet.bytes() > kMaxMessageBytes - kFramePrefixBytes) return pipeline::PushResult::kRejected;
    const grpc::ByteBuffer message = frameOf(packet);
    const std::lock_guard lock(mutex_);
    if (!control || backlog_.empty()) {
      const pipeline::PushResult result = enqueue(message);
      if (!control || result != pipeline::PushResult::kRejected) return result;
    }
    // The end of a write makes room for it.
    backlog_.put(*control, message);
    return pipeline::PushResult::kAccepted;
  }

  /// Continues to read if reading has stopped because too much waits. Any thread.
  void readOn() {
    const std::lock_guard lock(mutex_);
    if (!isOver_ && std::exchange(isPaused_, false)) this->StartRead(&read_);
  }

  /// Ends the stream, unless it has ended. Any thread.
  void end() {
    {
      const std::lock_guard lock(mutex_);
      if (std::exchange(isOver_, true)) return;
      isOpen_ = false;
    }
    hangUp();
  }

  void OnReadDone(bool ok) final {
    if (!ok || !takeSafely()) return end();
    const std::lock_guard lock(mutex_);
    if (isOver_) return;
    isPaused_ = !wantsMore();
    if (!isPaused_) this->StartRead(&read_);
  }

  void OnWriteDone(bool ok) final {
    {
      const std::lock_guard lock(mutex_);
      waitingBytes_ -= waiting_.front().Length();
      waiting_.pop_front();
      if (ok && !isOver_ && !waiting_.empty()) this->StartWrite(&waiting_.front());
      const auto enter = [this](const grpc::ByteBuffer& message) {
        return enqueue(message) == pipeline::PushResult::kAccepted;
      };
      if (ok) backlog_.offer(enter);
    }
    if (!ok) end();
  }

 protected:
  /// Accepts packets from now on, after these, and starts to read.
  void open(const std::vector<Packet>& first) {
    const std::lock_guard lock(mutex_);
    if (isOver_) return;
    isOpen_ = true;
    for (const Packet& packet : first) (void)enqueue(frameOf(packet));
    this->StartRead(&read_);
  }

 private:
  /// Handles a received message, valid or not.
  virtual void take(const grpc::ByteBuffer& message) = 0;
  /// Whether there is room for another message. Called with the reactor's lock held.
  [[nodiscard]] virtual bool wantsMore() const = 0;
  /// Ends the call: afterwards, no operation is started.
  virtual void hangUp() = 0;

  bool takeSafely() {
    try {
      take(read_);
      return true;
    } catch (...) {  // out of memory
      return false;
    }
  }

  pipeline::PushResult enqueue(grpc::ByteBuffer message) {
    if (!isOpen_) return pipeline::PushResult::kClosed;
    const std::size_t bytes = message.Length();
    if (waiting_.size() == kBackendQueue || waitingBytes_ + bytes > kMaxWaitingBytes) {
      return pipeline::PushResult::kRejected;
    }
    waitingBytes_ += bytes;
    waiting_.push_back(std::move(message));
    if (waiting_.size() == 1) this->StartWrite(&waiting_.front());
    return pipeline::PushResult::kAccepted;
  }

  std::mutex mutex_;
  bool isOpen_ = false;                   ///< packets may be written
  bool isOver_ = false;                   ///< no operation may be started
  bool isPaused_ = false;                 ///< reading has stopped
  std::deque<grpc::ByteBuffer> waiting_;  ///< the first is being written
  std::size_t waitingBytes_ = 0;
  ControlBacklog<grpc::ByteBuffer> backlog_;
  grpc::ByteBuffer read_;
};

}  // namespace grove::node
