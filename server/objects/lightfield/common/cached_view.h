#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "node/messages/shared_data.h"
#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// A picture of an object that many eyes near its own share, without haze: the covered part of an image, made ready for
/// reproject(). Immutable, any thread.
class CachedView final : public node::SharedData {
 public:
  /// Copies what shows of `image`, whose rectangle is in pixels of `camera`.
  CachedView(const raster::Image& image, const ObjectCamera& camera);
  /// The inverse of pack(). Throws node::PackingError.
  [[nodiscard]] static std::shared_ptr<CachedView> unpack(std::span<const std::byte> bytes);

  [[nodiscard]] const ObjectCamera& camera() const noexcept { return camera_; }
  [[nodiscard]] bool empty() const noexcept { return width_ == 0; }
  /// All texels: those of the picture and kBorder more on each side that show nothing. Texel (0, 0) is the camera's
  /// pixel (left(), top()).
  static constexpr int kBorder = 2;
  [[nodiscard]] int left() const noexcept { return left_; }
  [[nodiscard]] int top() const noexcept { return top_; }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }

  /// As raster::Image's. As many as padding() more may be read, so that vectors of texels can be read from wherever one
  /// lies.
  [[nodiscard]] const std::uint32_t* colour() const noexcept { return colour_.get(); }
  /// Nearness of every texel: 1 / depth if it is covered by half; that less softness() if it is covered by less, or is
  /// empty beside a covered one, whose depth it then has; and -softness() where there is nothing. So the nearest of
  /// several texels is the largest, but all that hide what is behind come before those that do not.
  /// Padded as the colours are.
  [[nodiscard]] const float* nearness() const noexcept { return nearness_.get(); }
  [[nodiscard]] std::size_t padding() const noexcept { return static_cast<std::size_t>(width_) + 32; }
  [[nodiscard]] float softness() const noexcept { return softness_; }

  /// The least and the greatest 1 / depth in squares of kSquare x kSquare texels; greatest is 0 if all are empty.
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
  /// Of the whole view.
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
