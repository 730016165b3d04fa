#pragma once

#include <set>

#include "node/messages/hello.h"

namespace grove::node {

/// Which objects a backend node serves.
struct ServedObjects {
  std::set<world::ObjectId> objects;
  bool visitors = false;  ///< the objects that show visitors

  [[nodiscard]] bool contains(world::ObjectId id) const {
    return id >= world::kFirstPlayerObject ? visitors : objects.contains(id);
  }
  [[nodiscard]] bool empty() const noexcept { return objects.empty() && !visitors; }
};

[[nodiscard]] inline ServedObjects servedBy(const NodeWelcome& welcome) {
  ServedObjects served{.objects = {}, .visitors = welcome.visitors};
  for (const ServedObject& object : welcome.objects) served.objects.insert(object.id);
  return served;
}

}  // namespace grove::node
