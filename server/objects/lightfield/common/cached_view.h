#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "node/messages/shared_data.h"
#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// A picture of an object that many nearby eyes share, without haze: the covered part of an image, prepared for
/// reproject(). Immutable, any thread.
class CachedView final : public node::SharedData {
 public:
  /// Copies the covered part of `image`, whose rectangle is in pixels of `camera`.
  CachedView(const raster::Image& image, const ObjectCamera& camera);
  /// The inverse of pack(). Throws node::PackingError.
  [[nodiscard]] static std::shared_ptr<CachedView> unpack(std::span<const std::byte> bytes);

  [[nodiscard]] const ObjectCamera& camera() const noexcept { return camera_; }
  [[nodiscard]] bool empty() const noexcept { return width_ == 0; }
  /// All texels: the picture's plus kBorder empty ones on each side. Texel (0, 0) is the camera's pixel (left(),
  /// top()).
  static constexpr int kBorder = 2;
  [[nodiscard]] int left() const noexcept { return left_; }
  [[nodiscard]] int top() const noexcept { return top_; }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }

  /// Colour as in raster::Image. padding() more values are readable, so that a vector of texels can be read from any
  /// texel.
  [[nodiscard]] const std::uint32_t* colour() const noexcept { return colour_.get(); }
  /// Nearness of every texel. Covered by at least half: 1 / depth. Covered by less, or empty beside a covered texel,
  /// whose depth it then takes: 1 / depth - softness(). Else: -softness(). So the largest value is the nearest texel,
  /// but all texels that hide the background come before those that do not. Padded like the colours.
  [[nodiscard]] const float* nearness() const noexcept { return nearness_.get(); }
  [[nodiscard]] std::size_t padding() const noexcept { return static_cast<std::size_t>(width_) + 32; }
  [[nodiscard]] float softness() const noexcept { return softness_; }

  /// Min and max of 1 / depth in squares of kSquare x kSquare texels; max is 0 if all are empty.
  struct Range {
    float min = 0.0F;
    float max = 0.0F;
  };
  static constexpr int kSquare = 8;
  [[nodiscard]] int squaresAcross() const noexcept { return (width_ + kSquare - 1) / kSquare; }
  [[nodiscard]] int squaresDown() const noexcept { return (height_ + kSquare - 1) / kSquare; }
  [[nodiscard]] const Range& range(int column, int row) const noexcept {
    return ranges_[static_cast<std::size_t>(row) * static_cast<std::size_t>(squaresAcross()) +
                   static_cast<std::size_t>(column)];
  }
  /// Range of the whole view.
  [[nodiscard]] const Range& range() const noexcept { return whole_; }

 private:
  CachedView() = default;
  [[nodiscard]] std::size_t ownBytes() const noexcept override;
  [[nodiscard]] node::PackedBytes pack() const override;
  void allocate();
  [[nodiscard]] std::size_t texels() const noexcept {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }
  void copy(const raster::Image& image);
  void spread();
  void measure();

  ObjectCamera camera_;
  int left_ = 0;
  int top_ = 0;
  int width_ = 0;
  int height_ = 0;
  float softness_ = 1.0F;
  std::unique_ptr<std::uint32_t[]> colour_;
  std::unique_ptr<float[]> nearness_;
  Range whole_;
  std::vector<Range> ranges_;
};

}  // namespace grove::objects::lightfield
