#include "node/frontend/frames/reuse_counter.h"

#include <memory>
#include <variant>

namespace grove::node {

void ReuseCounter::used(world::TypeIndex type, const Payload& payload, SessionId session) {
  using Use = UseRecord::Use;
  const auto* const data = std::get_if<std::shared_ptr<const SharedData>>(&payload);
  if (data == nullptr || *data == nullptr) return;
  switch ((*data)->uses().by(session)) {
    case Use::kUncounted:
      return;
    case Use::kFirst:
      counted_[type] += {.used = 1};
      return;
    case Use::kAgain:
      counted_[type] += {.usesAgain = 1};
      return;
    case Use::kFirstByOther:
      counted_[type] += {.shared = 1, .sharedBytes = (*data)->bytes(), .usesByOthers = 1};
      return;
    case Use::kByOther:
      counted_[type] += {.usesByOthers = 1};
      return;
  }
}

void ReuseCounter::report(pipeline::Timeline& timeline, const VisitorHalves& halves) {
  for (const auto& [type, reuse] : counted_) timeline.countReuse(halves.name(type), reuse);
  counted_.clear();
}

}  // namespace grove::node
