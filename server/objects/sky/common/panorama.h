#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/vector_bytes.h"
#include "world/geometry.h"

namespace grove::objects::sky {

/// Texels of a panorama: all around, and from slightly below the horizon to the zenith.
struct PanoramaSize {
  int width = 4096;
  int height = 768;
};

/// The whole sky as a picture, display-encoded. Columns are headings, clockwise from -Z. Rows are spread by the tangent
/// t of the elevation as (t + kBelow) / (t + kBelow + kSpread), which is finest at the horizon, where the landscape is,
/// and needs no inverse trigonometry to look up. A last column repeats the first, so that neighbours are adjacent.
class Panorama {
 public:
  static constexpr float kBelow = 0.06F;  ///< tangent of the angle below the horizon at which the map begins
  static constexpr float kSpread = 0.8F;

  explicit Panorama(PanoramaSize size);

  /// How many texels there are, the repeated column included.
  [[nodiscard]] static std::size_t texelsOf(PanoramaSize size) noexcept {
    return (static_cast<std::size_t>(size.width) + 1) * static_cast<std::size_t>(size.height);
  }

  [[nodiscard]] int width() const noexcept { return size_.width; }
  [[nodiscard]] int height() const noexcept { return size_.height; }
  /// Texels from a row to the next.
  [[nodiscard]] int stride() const noexcept { return size_.width + 1; }
  [[nodiscard]] const std::uint32_t* texels() const noexcept { return texels_.data(); }
  [[nodiscard]] std::span<std::uint32_t> texels() noexcept { return texels_; }
  [[nodiscard]] std::uint32_t texel(int column, int row) const noexcept;

  /// Sets a texel; column 0 is also set at the seam.
  void set(int column, int row, std::uint32_t rgba) noexcept;

  /// Heading in radians of a column's texels, and tangent of elevation of a row's.
  [[nodiscard]] float heading(int column) const noexcept;
  [[nodiscard]] float tangent(int row) const noexcept;

  /// Unit vector at a heading and a tangent of elevation.
  [[nodiscard]] static world::Vec3 direction(float heading, float tangent) noexcept;

  /// Bilinear, 0..255 a channel; exact, one direction at a time. The reference for sampleRow().
  [[nodiscard]] world::Vec3 sample(world::Vec3 direction) const noexcept;
  /// The same at a place in texels, whose middles are at whole numbers. Columns go around, rows end.
  [[nodiscard]] world::Vec3 at(float x, float y) const noexcept;

  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(texels_); }

 private:
  const PanoramaSize size_;
  std::vector<std::uint32_t> texels_;
};

/// A panorama, and a small copy of it that stays in a core's cache.
struct SkyMaps {
  explicit SkyMaps(Panorama map);

  Panorama sharp;
  Panorama soft;  ///< each texel the mean of kSoftColumns x kSoftRows, for what has no detail and is sampled sparsely
};

inline constexpr int kSoftColumns = 4;
inline constexpr int kSoftRows = 2;

}  // namespace grove::objects::sky
