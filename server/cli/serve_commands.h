#pragma once

#include "cli/node.h"
#include "cli/serve.h"
#include "cli/world.h"

namespace CLI {
class App;
}

namespace grove::cli {

// Sub-commands of the processes that serve a world. The options outlive parsing.

void addServe(CLI::App& app, ServeOptions& options);
void addWorld(CLI::App& app, WorldOptions& options);
void addNode(CLI::App& app, NodeOptions& options);

}  // namespace grove::cli
