#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/vector_bytes.h"
#include "world/geometry.h"

namespace grove::objects::sky {

/// Texels of a panorama: 360 degrees wide, from slightly below the horizon to the zenith.
struct PanoramaSize {
  int width = 4096;
  int height = 768;
};

/// The whole sky as a display-encoded picture. Columns are headings, clockwise from -Z. Rows follow (t + kBelow) / (t +
/// kBelow + kSpread), with t the tangent of elevation: finest at the horizon, where the landscape is, and without
/// inverse trigonometry in the look-up. An extra last column repeats the first, so that neighbours are adjacent.
class Panorama {
 public:
  static constexpr float kBelow = 0.06F;  ///< tangent of the lowest row's angle below the horizon
  static constexpr float kSpread = 0.8F;

  explicit Panorama(PanoramaSize size);

  /// Number of texels, including the repeated column.
  [[nodiscard]] static std::size_t texelsOf(PanoramaSize size) noexcept {
    return (static_cast<std::size_t>(size.width) + 1) * static_cast<std::size_t>(size.height);
  }

  [[nodiscard]] int width() const noexcept { return size_.width; }
  [[nodiscard]] int height() const noexcept { return size_.height; }
  /// Texels per row in memory.
  [[nodiscard]] int stride() const noexcept { return size_.width + 1; }
  [[nodiscard]] const std::uint32_t* texels() const noexcept { return texels_.data(); }
  [[nodiscard]] std::span<std::uint32_t> texels() noexcept { return texels_; }
  [[nodiscard]] std::uint32_t texel(int column, int row) const noexcept;

  /// Sets a texel; for column 0 also its copy at the seam.
  void set(int column, int row, std::uint32_t rgba) noexcept;

  /// Heading in radians of a column, and tangent of elevation of a row.
  [[nodiscard]] float heading(int column) const noexcept;
  [[nodiscard]] float tangent(int row) const noexcept;

  /// Unit vector of a heading and a tangent of elevation.
  [[nodiscard]] static world::Vec3 direction(float heading, float tangent) noexcept;

  /// Bilinear, 0..255 per channel; exact, one direction at a time. The reference for sampleRow().
  [[nodiscard]] world::Vec3 sample(world::Vec3 direction) const noexcept;
  /// The same at a place in texels; texel centres are at whole numbers. Columns wrap around, rows are clamped.
  [[nodiscard]] world::Vec3 at(float x, float y) const noexcept;

  /// Memory use.
  [[nodiscard]] std::size_t bytes() const noexcept { return pipeline::vectorBytes(texels_); }

 private:
  const PanoramaSize size_;
  std::vector<std::uint32_t> texels_;
};

/// A panorama, and a small copy that fits a core's cache.
struct SkyMaps {
  explicit SkyMaps(Panorama map);

  Panorama sharp;
  Panorama soft;  ///< each texel is the mean of kSoftColumns x kSoftRows; for smooth parts that are sampled sparsely
};

inline constexpr int kSoftColumns = 4;
inline constexpr int kSoftRows = 2;

}  // namespace grove::objects::sky
