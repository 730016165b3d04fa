#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "objects/lightfield/format/near_model.h"
#include "objects/lightfield/format/view_camera.h"
#include "objects/lightfield/format/view_sphere.h"
#include "world/geometry.h"

namespace grove::objects::lightfield {

class MappedFile;

/// Texels are stored in square blocks, and only covered blocks are stored. A block has one extra row and column, a copy
/// of its neighbours' first ones, so that the four texels of a bilinear look-up are in one block.
inline constexpr int kBlock = 16;
inline constexpr int kBlockStride = kBlock + 1;
inline constexpr int kBlockTexels = kBlockStride * kBlockStride;
inline constexpr std::uint32_t kNoBlock = 0xFFFFFFFFU;
/// Depth of an empty texel; its colour is 0.
inline constexpr std::uint16_t kNoDepth = 0xFFFFU;

inline constexpr int kMinSize = 32;
inline constexpr int kMaxSize = 1024;
inline constexpr int kMaxLightings = 16;

/// Wood blocks the fluid; both kinds cast shade.
enum class Voxel : std::uint8_t { kEmpty = 0, kWood = 1, kLeaves = 2 };

struct VoxelGrid {
  int width = 0;   ///< cells along x
  int height = 0;  ///< along y
  int depth = 0;   ///< along z
  float cell = 0.0F;
  world::Vec3 low{0.0F};
  std::span<const std::uint8_t> cells;  ///< Voxel, x fastest, then y, then z
};

/// A picture that is not among the views, the reference for measuring quality.
struct HeldOutView {
  ObjectCamera camera;
  int size = 0;                           ///< pixels per edge
  std::span<const std::uint32_t> colour;  ///< like the views'; lighting 0
  std::span<const float> depth;           ///< view depth in object metres; world::kInfiniteDepth where nothing is
  bool amid = false;                      ///< a tile amid copies of itself, for measuring the seams between them
};

/// Pictures of one object from all directions, with depth: the data of sections 5.1.1 and 5.1.3. Read-only and shared
/// by all visitors; the spans point into a mapped file or into memory that `storage` owns. FORMAT.md describes the
/// layout.
///
/// Colour is as in raster::Image: RGBA8, display-encoded, premultiplied by coverage. The sun of lighting k has the
/// world's elevation and the azimuth `sunAzimuth + k * 2 pi / lightings`, so that a rotated object can be shown in the
/// world's light.
///
/// Depth is linear between the view camera's nearDepth (0) and farDepth (65534); kNoDepth is nothing. A partly covered
/// texel has the depth of the surface that covers it.
///
/// Level l of the mip pyramid has views of (size >> l) squared texels.
struct LightField {
  ViewSphere sphere{1};
  ViewGeometry geometry;
  world::Bounds bounds;  ///< of the visible parts, object coordinates
  int size = 0;          ///< texels per edge of a view, a power of two, kMinSize to kMaxSize
  int levels = 1;
  float sunAzimuth = 0.0F;                             ///< radians, atan2(x, z) of the direction towards the sun
  std::vector<std::span<const std::uint32_t>> blocks;  ///< by level: [view][block row][block column], kNoBlock if empty
  std::span<const std::uint16_t> depth;                ///< [block][kBlockStride][kBlockStride]
  std::vector<std::span<const std::uint32_t>> colour;  ///< by lighting: [block][kBlockStride][kBlockStride]
  VoxelGrid voxels;
  std::vector<HeldOutView> heldOut;
  NearModel near;         ///< may be empty
  std::string source;     ///< description of its origin, for people
  std::size_t bytes = 0;  ///< of all of the above
  std::shared_ptr<const void> storage;
  const MappedFile* mapped = nullptr;  ///< the file in storage, if depth and colour point into one

  [[nodiscard]] int lightings() const noexcept { return static_cast<int>(colour.size()); }
  /// Blocks along an edge of a view.
  [[nodiscard]] int blocksAcross(int level) const noexcept { return (size >> level) / kBlock; }
  /// The lighting whose sun is nearest to the world's sun in the direction `sun`, for an object rotated by `yaw`.
  [[nodiscard]] int lightingFor(float yaw, world::Vec3 sun) const noexcept;
};

}  // namespace grove::objects::lightfield
