#pragma once

#include <set>

#include "node/messages/hello.h"
#include "world/layout.h"

namespace grove::node {

/// The objects that a backend node serves.
struct ServedObjects {
  std::set<world::ObjectId> objects;
  bool visitors = false;  ///< the objects that show visitors

  [[nodiscard]] bool contains(world::ObjectId id) const {
    return id >= world::kFirstPlayerObject ? visitors : objects.contains(id);
  }
  [[nodiscard]] bool empty() const noexcept { return objects.empty() && !visitors; }
};

[[nodiscard]] inline ServedObjects servedBy(const NodeWelcome& welcome) {
  ServedObjects served{.objects = {}, .visitors = welcome.visitors.has_value()};
  for (const ServedObject& object : welcome.objects) served.objects.insert(object.id);
  return served;
}

/// The objects of a world that others do not serve.
[[nodiscard]] inline ServedObjects restOf(const world::Layout& layout, const ServedObjects& others) {
  ServedObjects rest{.objects = {}, .visitors = layout.visitor && !others.visitors};
  for (const world::Object& object : layout.objects) {
    if (!others.contains(object.id)) rest.objects.insert(object.id);
  }
  return rest;
}

}  // namespace grove::node
