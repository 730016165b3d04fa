#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string_view>

#include "models/model.h"
#include "world/sky.h"

namespace grove::bake {

struct BakeOptions {
  int subdivision = 16;  ///< of the sphere of views, 1 to ViewSphere::kMaxSubdivision
  int size = 256;        ///< texels per edge of a view, a power of two, kMinSize to kMaxSize
  int lightings = 6;     ///< 1 to kMaxLightings
  int samples = 2;       ///< per edge of a pixel, 1 to 16
  /// Samples of the held-out views, the reference for the others: with few samples, their noise would count as error of
  /// the light field. 1 to 16.
  int truthSamples = 6;
  world::Sky sky = {};  ///< of the target world
  int threads = 0;      ///< 0: one per core
  bool tile = false;    ///< the model stands amid copies of itself, see models::isTile()
  bool group = false;   ///< the model is only seen from a distance, see models::isGroup()
  /// Bakes light with a quarter of the rays, which neighbouring leaves share, and only two held-out views: a preview
  /// until the final bake.
  bool rough = false;
};

struct BakeProgress {
  std::string_view step;
  float share = 0.0F;        ///< of the step
  double secondsLeft = 0.0;  ///< of the step; 0 if unknown
};

struct BakeReport {
  int views = 0;
  int viewsTakenUp = 0;  ///< of these, from an interrupted bake
  std::size_t triangles = 0;
  std::size_t lightPoints = 0;
  std::uint64_t bytes = 0;  ///< of the file
  double lightSeconds = 0.0;
  double viewSeconds = 0.0;
  double seconds = 0.0;  ///< in total
};

/// Makes the light field of a model (section 5.1.1): light, views with colour and depth, voxels, and held-out views.
/// Blocks; uses `threads` threads. Any of them calls `progress`, one at a time.
///
/// Finished views are stored in the folder FILE.partial, so memory does not grow with their number. A bake that was
/// stopped (then it returns nothing), killed or out of disk space continues from there when it is repeated with the
/// same model and options; the resulting file is the same, byte for byte. The file appears complete or not at all.
///
/// Throws EnvironmentError: no such folder, no permission, not enough disk space (checked before views are made),
/// another process bakes the same file, or the model has no triangles.
[[nodiscard]] std::optional<BakeReport> bakeLightField(const models::Model& model, const BakeOptions& options,
                                                       const std::filesystem::path& file,
                                                       const std::function<void(const BakeProgress&)>& progress,
                                                       const std::stop_token& stop);

}  // namespace grove::bake
