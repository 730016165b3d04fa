#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "pipeline/memory_ledger.h"
#include "pipeline/vector_bytes.h"
#include "raster/image.h"
#include "raster/surface.h"
#include "world/camera.h"
#include "world/light.h"
#include "world/sky.h"

namespace grove::raster {

inline constexpr std::size_t kMaxBones = 20;
inline constexpr std::size_t kMaxLamps = 8;

/// A surface with the light at each vertex: across-user, made once.
struct LitSurface {
  Surface surface;
  /// Per vertex: x is the visible share of the sun; yzw is the indirect light that a white surface would reflect there
  /// (`baked`), or the visible share of Sky::ambient() (not `baked`, for moving surfaces).
  std::vector<world::Vec4> light;
  bool baked = true;

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return surface.bytes() + pipeline::vectorBytes(light); }
};

/// The point lights with the largest effect on an object.
struct Lamps {
  int count = 0;
  std::array<world::Vec3, kMaxLamps> position{};
  std::array<world::Vec3, kMaxLamps> colour{};
};

[[nodiscard]] Lamps chooseLamps(std::span<const world::PointLight> lights, const world::Bounds& bounds);

/// One object in one frame, for a MeshRenderer.
struct Drawing {
  const LitSurface* object = nullptr;  ///< outlives the renderer, which keeps data derived from it
  const world::Camera* camera = nullptr;
  const world::Sky* sky = nullptr;
  world::Rect rect;                            ///< requested pixels of the camera's image
  float distance = 0.0F;                       ///< from the eye in the object's own metres, for the level of detail
  std::array<world::Mat4, kMaxBones> bones{};  ///< object to world; rigid apart from a uniform scale
  world::Vec3 tint{1.0F};
  float sunShare = 1.0F;  ///< scales the sun's share of all vertices
  Lamps lamps;
};

/// The ledger for a renderer's memory, and the object type that it is reported for.
struct MeshMemory {
  pipeline::MemoryLedger& ledger;  ///< outlives the renderer
  std::string_view type;           ///< outlives the ledger

  [[nodiscard]] pipeline::HeldMemory held(const char* holder) const {
    return {ledger, holder, type, pipeline::Work::kAcrossUser};
  }
};

/// Draws triangles to colour and depth. All implementations draw the same picture.
class MeshRenderer {
 public:
  virtual ~MeshRenderer() = default;

  /// Makes one image per drawing with its rectangle; null if the rectangle is empty. The drawings may belong to
  /// different frames and sessions.
  virtual void render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) = 0;
};

}  // namespace grove::raster
