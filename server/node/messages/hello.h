#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "node/messages/ids.h"
#include "world/geometry.h"

namespace grove::node {

/// Version of the messages.
inline constexpr std::uint32_t kProtocol = 8;

/// The number of an object type, which both ends of a link share.
struct TypeName {
  world::TypeIndex id = 0;
  std::string name;
};

/// The first message of a frontend process.
struct NodeHello {
  std::uint32_t protocol = kProtocol;
  std::string build;            ///< version of the program
  std::uint64_t sceneHash = 0;  ///< of the scene file's text
  ProcessId process = 0;        ///< distinct among the frontend processes of a backend node
  std::vector<TypeName> types;  ///< types with the ids that it will use
};

/// An object that a backend node serves, with the facts of its model that every frontend process needs.
struct ServedObject {
  world::ObjectId id = 0;
  world::TypeIndex type = 0;
  std::string name;
  world::Bounds bounds;         ///< in the world
  float obstacleRadius = 0.0F;  ///< see world::Object
};

/// The same for the objects that show visitors, see world::VisitorTemplate.
struct ServedVisitors {
  world::Bounds bounds;
  bool hasOwnBody = false;
  bool castsShadow = false;
};

/// A backend node's response to a hello.
struct NodeWelcome {
  std::uint32_t protocol = kProtocol;
  std::string build;
  std::uint64_t sceneHash = 0;
  /// Identifies the run of the node's process: versions of shared data count within it.
  std::uint64_t epoch = 0;
  std::vector<ServedObject> objects;
  std::optional<ServedVisitors> visitors = {};  ///< empty: other nodes show visitors
};

/// The reason why a backend node does not serve a frontend process.
struct NodeRefusal {
  std::string reason;
};

}  // namespace grove::node
