#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "objects/lightfield/bake/bake.h"

namespace grove::cli {

/// Options of `grove bake`.
struct BakeCommand {
  std::optional<std::string> model;  ///< glTF file; either this
  std::optional<std::string> plant;  ///< or the name of a generated plant
  std::uint32_t seed = 1;
  bool full = false;  ///< a plant of several million triangles
  bake::BakeOptions options;
  std::string output;
  bool json = false;
};

/// Bakes a light field, with progress on stderr. Returns the process's exit code: 0; 1 if SIGINT or SIGTERM interrupted
/// it; 2 with a line on stderr for bad options. Throws EnvironmentError and what importGltf() throws.
int runBake(const BakeCommand& command);

}  // namespace grove::cli
