#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "node/transport/transport_kind.h"

namespace grove::node::testing {

/// A wire that keeps results back, throws, or spoils what it carries, when it is told to.
class FaultyTransport final : public Transport {
 public:
  using Transport::connect;
  using Transport::send;
  /// `wire` does the carrying.
  explicit FaultyTransport(std::unique_ptr<Transport> wire) : wire_(std::move(wire)) {}

  enum class Fault { kNone, kSendRequest, kSendResult, kCompress, kDecompress };

  std::atomic<bool> keepBack{false};              ///< results wait for release()
  mutable std::atomic<Fault> next{Fault::kNone};  ///< happens there, once
  std::atomic<int> requests{0};                   ///< that were sent

  /// In their order, and before any later one.
  void release() {
    for (std::vector<ToFrontend> kept = take(); !kept.empty(); kept = take()) {
      for (ToFrontend& message : kept) wire_->send(std::move(message));
    }
  }

  /// How many results wait.
  [[nodiscard]] std::size_t kept() {
    const std::lock_guard lock(mutex_);
    return kept_.size();
  }

  [[nodiscard]] bool sharesMemory() const override { return wire_->sharesMemory(); }
  void connect(BackendPort& backend) override { wire_->connect(backend); }
  void connect(FrontendPort& frontend) override { wire_->connect(frontend); }
  void leaveBackend() override { wire_->leaveBackend(); }
  void leaveFrontend() override { wire_->leaveFrontend(); }
  pipeline::PushResult send(ToBackend message) override {
    if (std::holds_alternative<Request>(message)) {
      ++requests;
      if (happens(Fault::kSendRequest)) throw std::runtime_error("the wire is broken");
    }
    return wire_->send(std::move(message));
  }
  pipeline::PushResult send(ToFrontend message) override {
    if (!std::holds_alternative<Result>(message)) return wire_->send(std::move(message));
    if (happens(Fault::kSendResult)) throw std::runtime_error("the wire is broken");
    if (const std::lock_guard lock(mutex_); keepBack) {
      kept_.push_back(std::move(message));
      return pipeline::PushResult::kAccepted;
    }
    return wire_->send(std::move(message));
  }
  void compress(Result& result, std::string_view subject) const override {
    if (happens(Fault::kCompress)) throw std::runtime_error("the wire is broken");
    wire_->compress(result, subject);
    if (!happens(Fault::kDecompress)) return;
    result.payload = std::shared_ptr<const raster::Image>();
    result.packed = std::make_shared<const PackedBytes>(1);
  }

 private:
  /// What is kept; if that is nothing, results are kept back no more.
  std::vector<ToFrontend> take() {
    const std::lock_guard lock(mutex_);
    if (kept_.empty()) keepBack = false;
    return std::exchange(kept_, {});
  }
  bool happens(Fault here) const {
    Fault expected = here;
    return next.compare_exchange_strong(expected, Fault::kNone);
  }

  const std::unique_ptr<Transport> wire_;
  std::mutex mutex_;
  std::vector<ToFrontend> kept_;
};

}  // namespace grove::node::testing
