#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options/link_options.h"
#include "gl/context.h"

namespace grove::cli {

/// Options of `grove node`.
struct NodeOptions {
  std::vector<std::string> objects;  ///< names or types of its objects
  std::optional<std::string> scene;
  std::string listen = "127.0.0.1:8100";
  LinkOptions links;
  /// Address of the node that provides voxels of all obstacles. Without it, this node loads all models.
  std::optional<std::string> obstacles;
  LinkOptions obstacleLinks{{"", "", "--link-tls"}, ""};
  std::optional<float> viewError;  ///< none: the scene's
  gl::ContextKind gl = gl::ContextKind::kAuto;
};

/// Serves objects of a world to `grove serve --nodes` until SIGINT or SIGTERM. Prints `listening on HOST:PORT` on
/// stdout when ready. Returns 0, or 2 for a bad option; throws EnvironmentError or world::SceneError.
int runNode(const NodeOptions& options);

}  // namespace grove::cli
