#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "node/messages/envelope.h"

namespace grove::node {

/// Names a control message, which is never refused: of two with one name, only the newer one matters. Nothing for other
/// messages: if they are refused, their senders retry or skip them.
[[nodiscard]] std::optional<std::string> controlNameOf(const ToBackend& message);
[[nodiscard]] std::optional<std::string> controlNameOf(const ToFrontend& message);

/// Control messages that wait beside a full link: one per name, so at most a few per session and key. One thread
/// at a time.
template <class Message>
class ControlBacklog {
 public:
  [[nodiscard]] bool empty() const noexcept { return waiting_.empty(); }
  /// Replaces an older message with this name.
  void put(const std::string& name, Message message) { waiting_.insert_or_assign(name, std::move(message)); }
  /// Offers all to the link until `isTaken` returns false.
  template <class IsTaken>
  void offer(const IsTaken& isTaken) {
    while (!waiting_.empty() && isTaken(waiting_.begin()->second)) waiting_.erase(waiting_.begin());
  }

 private:
  std::map<std::string, Message> waiting_;
};

}  // namespace grove::node
