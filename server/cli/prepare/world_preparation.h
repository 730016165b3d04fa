#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "cli/prepare/prepare_world.h"
#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/frontend/world_nodes.h"
#include "node/object_types.h"
#include "node/transport/grpc/tls/link_tls.h"
#include "world/scenes/scene_file.h"

namespace grove::cli {

/// Makes the nodes of a server's world: links to nodes in other processes, and prepares the objects that these do not
/// serve. If they serve all, nothing is prepared: no GL, no models, no light fields. Outlives the nodes. Not
/// thread-safe.
class WorldPreparation {
 public:
  struct Options {
    std::vector<std::string> nodes;  ///< addresses (HOST:PORT) of nodes in other processes
    node::LinkTls tls;               ///< for the links to them
    node::ProcessId process = 1;     ///< identifies this process to them
    gl::ContextKind gl = gl::ContextKind::kAuto;
    std::optional<std::string> shaderDirectory;
    std::size_t spaceForServing = 0;  ///< bytes reserved for serving
  };
  /// Thrown by make() after a stop request.
  struct Stopped {};

  /// Calls `report` with the name of a step and its progress, 0 to 1. Any thread.
  WorldPreparation(world::Scene scene, Options options, std::function<void(std::string_view, float)> report,
                   std::stop_token stop);

  /// See node::WorldNodesFactory; call once. Throws Stopped, EnvironmentError or world::SceneError.
  [[nodiscard]] std::unique_ptr<node::WorldNodes> make(const node::Machine& machine,
                                                       const node::WorldNodes::Progress& progress);

  [[nodiscard]] const node::FrontendTypes& frontends() const noexcept { return types_.frontends; }
  /// The parts that are still coarse.
  [[nodiscard]] Preparations& coarse() noexcept { return coarse_; }

 private:
  [[nodiscard]] std::unique_ptr<node::WorldNodes> prepareLocally(const node::Machine& machine,
                                                                 const node::WorldNodes::Progress& progress,
                                                                 std::unique_ptr<node::NodeRouter> others);

  const world::Scene scene_;
  const Options options_;
  const std::function<void(std::string_view, float)> report_;
  const std::stop_token stop_;
  const node::ObjectTypes types_;
  const gl::ShaderLibrary shaders_;
  std::optional<gl::Workers> gl_;
  Preparations coarse_;
};

}  // namespace grove::cli
