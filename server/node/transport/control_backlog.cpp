#include "node/transport/control_backlog.h"

#include <variant>

namespace grove::node {
namespace {

/// The names' order is that in which they are sent: a session's frames end before it is forgotten.
struct ControlName {
  using Name = std::optional<std::string>;
  Name operator()(const Cancel& cancel) const { return "cancel " + std::to_string(cancel.session); }
  Name operator()(const Forget& forget) const { return "forget " + std::to_string(forget.session); }
  Name operator()(const Quality& /*quality*/) const { return "quality"; }
  Name operator()(const Announcement& announcement) const {
    return std::to_string(announcement.what.object) + " " + announcement.what.key;
  }
  Name operator()(const auto& /*other*/) const { return std::nullopt; }
};

}  // namespace

std::optional<std::string> controlNameOf(const ToBackend& message) { return std::visit(ControlName(), message); }

std::optional<std::string> controlNameOf(const ToFrontend& message) { return std::visit(ControlName(), message); }

}  // namespace grove::node
