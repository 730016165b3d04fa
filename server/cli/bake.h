#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "objects/lightfield/bake/bake.h"

namespace grove::cli {

/// Options of `grove bake`.
struct BakeCommand {
  std::optional<std::string> model;  ///< glTF file; else
  std::optional<std::string> plant;  ///< name of a generated one
  std::uint32_t seed = 1;
  bool full = false;  ///< of the plant: several million triangles
  bake::BakeOptions options;
  std::string output;
  bool json = false;
};

/// Makes a light field, with progress on stderr. Returns the process's exit code: 0; 1 if SIGINT or SIGTERM interrupted
/// it; 2 with a line on stderr for bad options. Throws EnvironmentError and what importGltf() throws.
int runBake(const BakeCommand& command);

}  // namespace grove::cli
