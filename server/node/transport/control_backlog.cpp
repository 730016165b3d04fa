#include "node/transport/control_backlog.h"

#include <variant>

namespace grove::node {
namespace {

/// Sent in the order of their names: a session's frames end before the session does.
class ControlName {
 public:
  using Name = std::optional<std::string>;
  Name operator()(const Cancel& cancel) const { return "cancel " + std::to_string(cancel.session); }
  Name operator()(const Forget& forget) const { return "forget " + std::to_string(forget.session); }
  Name operator()(const Quality& /*quality*/) const { return "quality"; }
  Name operator()(const Acknowledgement& acknowledgement) const { return "acknowledge " + of(acknowledgement.what); }
  Name operator()(const Unsubscribe& unsubscribe) const { return "unsubscribe " + of(unsubscribe.what); }
  Name operator()(const Announcement& announcement) const { return of(announcement.what); }
  Name operator()(const auto& /*other*/) const { return std::nullopt; }

 private:
  static std::string of(const SharedKey& what) { return std::to_string(what.object) + " " + what.key; }
};

}  // namespace

std::optional<std::string> controlNameOf(const ToBackend& message) { return std::visit(ControlName(), message); }

std::optional<std::string> controlNameOf(const ToFrontend& message) { return std::visit(ControlName(), message); }

}  // namespace grove::node
