#pragma once

#include <optional>
#include <string>

#include "cli/options/link_options.h"

namespace grove::cli {

/// Options of `grove world`.
struct WorldOptions {
  std::optional<std::string> scene;
  std::string listen = "127.0.0.1:8070";
  LinkOptions links;
};

/// Owns a world that servers show (`grove serve --join`), until SIGINT or SIGTERM. Prints `listening on HOST:PORT` on
/// stdout when ready. Returns 0, or 2 for a bad option; throws EnvironmentError or world::SceneError.
int runWorld(const WorldOptions& options);

}  // namespace grove::cli
