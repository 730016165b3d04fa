#pragma once

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "node/transport/in_process.h"

namespace grove::node::testing {

/// A wire that keeps results back, or throws, when it is told to.
class FaultyTransport final : public Transport {
 public:
  enum class Fault { kNone, kSendRequest, kSendResult, kCompress, kDecompress };

  std::atomic<bool> keepBack{false};              ///< results wait for release()
  mutable std::atomic<Fault> next{Fault::kNone};  ///< throws there, once

  void release() {
    keepBack = false;
    std::vector<Result> kept;
    {
      const std::lock_guard lock(mutex_);
      kept.swap(kept_);
    }
    for (Result& result : kept) wire_.send(std::move(result));
  }

  /// How many results wait.
  [[nodiscard]] std::size_t kept() {
    const std::lock_guard lock(mutex_);
    return kept_.size();
  }

  void connectBackend(world::TypeIndex type, std::shared_ptr<pipeline::Inlet<Request>> receiver) override {
    wire_.connectBackend(type, std::move(receiver));
  }
  void connectFrontend(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver) override {
    wire_.connectFrontend(session, std::move(receiver));
  }
  void disconnectFrontend(SessionId session) override { wire_.disconnectFrontend(session); }
  pipeline::PushResult send(Request request) override {
    fail(Fault::kSendRequest);
    return wire_.send(std::move(request));
  }
  void send(Result result) override {
    fail(Fault::kSendResult);
    if (keepBack) {
      const std::lock_guard lock(mutex_);
      kept_.push_back(std::move(result));
    } else {
      wire_.send(std::move(result));
    }
  }
  [[nodiscard]] Payload compress(Payload payload) const override {
    fail(Fault::kCompress);
    return payload;
  }
  [[nodiscard]] Payload decompress(Payload payload) const override {
    fail(Fault::kDecompress);
    return payload;
  }

 private:
  void fail(Fault here) const {
    Fault expected = here;
    if (next.compare_exchange_strong(expected, Fault::kNone)) throw std::runtime_error("the wire is broken");
  }

  InProcessTransport wire_;
  std::mutex mutex_;
  std::vector<Result> kept_;
};

}  // namespace grove::node::testing
