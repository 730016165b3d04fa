#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "node/messages/wire/wire.h"

namespace grove::node {

/// The first messages of a new stream to a backend node: the last hello, then the newest world update and quality. One
/// thread at a time.
class Opening {
 public:
  void remember(const ToBackend& message) {
    if (std::holds_alternative<NodeHello>(message)) hello_ = message;
    if (std::holds_alternative<std::shared_ptr<const WorldUpdate>>(message)) world_ = message;
    if (std::holds_alternative<Quality>(message)) quality_ = message;
  }
  [[nodiscard]] bool hasHello() const noexcept { return hello_.has_value(); }
  /// Empty before the first hello.
  [[nodiscard]] std::vector<Packet> packets() const {
    std::vector<Packet> packets;
    for (const auto* message : {&hello_, &world_, &quality_}) {
      if (hello_ && *message) packets.push_back(encode(**message));
    }
    return packets;
  }

 private:
  std::optional<ToBackend> hello_;
  std::optional<ToBackend> world_;
  std::optional<ToBackend> quality_;
};

}  // namespace grove::node
