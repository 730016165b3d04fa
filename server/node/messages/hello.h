#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "node/messages/ids.h"
#include "world/geometry.h"

namespace grove::node {

/// Versions of the messages that this program understands.
inline constexpr std::uint32_t kProtocol = 5;

/// What both ends of a link call one type of object.
struct TypeName {
  world::TypeIndex id = 0;
  std::string name;
};

/// What a frontend process says first.
struct NodeHello {
  std::uint32_t protocol = kProtocol;
  std::string build;            ///< version of the program
  std::uint64_t sceneHash = 0;  ///< of the scene file's text
  ProcessId process = 0;        ///< distinct among the frontend processes of a backend node
  std::vector<TypeName> types;  ///< ids that it will use
};

/// An object that a backend node serves, with what of its model every frontend process needs.
struct ServedObject {
  world::ObjectId id = 0;
  world::TypeIndex type = 0;
  std::string name;
  world::Bounds bounds;         ///< in the world
  float obstacleRadius = 0.0F;  ///< see world::Object
};

/// The same of the objects that show visitors, see world::VisitorTemplate.
struct ServedVisitors {
  world::Bounds bounds;
  bool hasOwnBody = false;
};

/// What a backend node answers.
struct NodeWelcome {
  std::uint32_t protocol = kProtocol;
  std::string build;
  std::uint64_t sceneHash = 0;
  /// Names the life of the node's process: versions of shared data count within it.
  std::uint64_t epoch = 0;
  std::vector<ServedObject> objects;
  std::optional<ServedVisitors> visitors = {};  ///< nothing: others show visitors
};

/// Why a backend node will not serve a frontend process.
struct NodeRefusal {
  std::string reason;
};

}  // namespace grove::node
