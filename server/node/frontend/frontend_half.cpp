#include "node/frontend/frontend_half.h"

#include <string>

#include "node/frontend/shared/shared_store.h"

namespace grove::node {

std::shared_ptr<const SharedData> SharedOf::find(const Key& key) const { return store_.find({object_, key}); }

Plan FrontendHalf::plan(const VisibleObject& object, const View&, const SharedOf&, const Reply* reply) {
  if (reply != nullptr) return reply->payload;
  return Ask{.shared = false, .key = {}, .rect = object.rect};
}

std::shared_ptr<SharedData> FrontendType::unpack(const Key&, Version, std::span<const std::byte>,
                                                 const SharedData*) const {
  throw PackingError(std::string(name()) + " has no shared data");
}

}  // namespace grove::node
