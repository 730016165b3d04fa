#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "node/frontend/backdrops/backdrop_kernels.h"
#include "node/messages/view.h"
#include "raster/image.h"
#include "raster/yuv_image.h"

namespace grove::node {

struct WarpCamera;

/// Depths of a backdrop, measured band by band during compositing. Several threads may measure different bands at once.
class BackdropDepths {
 public:
  /// For a backdrop of this area, which consists of whole cells. Uses memory of the pool for pixels, which have no
  /// values until they are measured or copied.
  BackdropDepths(const world::Rect& area, raster::ImagePool& images);
  /// Measures a part of the area that consists of whole cells.
  void measure(const raster::Image& part);
  /// Copies a part of whole cells that both areas contain.
  void copy(const BackdropDepths& from, const world::Rect& part);

  [[nodiscard]] const std::vector<CellDepths>& cells() const noexcept { return cells_; }
  /// Of pixels, row by row.
  [[nodiscard]] std::span<const PixelNearness> nearness() const noexcept { return nearness_; }

 private:
  [[nodiscard]] std::ptrdiff_t cellAt(int x, int y) const;
  [[nodiscard]] std::ptrdiff_t pixelAt(int x, int y) const;

  world::Rect area_;
  std::vector<CellDepths> cells_;
  raster::ImagePool::Bytes memory_;
  std::span<PixelNearness> nearness_;  ///< in the memory
};

/// All still objects as a visitor saw them in one frame: colours, and depths by cells and pixels, with a border beyond
/// the frame on the side to which the head turns. BackdropWarp shows it from nearby eyes. Immutable, any thread.
class Backdrop {
 public:
  struct Origin {
    std::shared_ptr<const View> view;  ///< from whose eye it was drawn
    FrameNumber frame = 0;             ///< that drew or extended it
    bool isFinal = true;               ///< no better version of its objects is in progress
  };
  /// `image` is in pixels of the view's camera and may reach beyond its frame.
  Backdrop(std::shared_ptr<const raster::SemiPlanarImage> image, BackdropDepths depths, Origin origin);

  [[nodiscard]] const raster::SemiPlanarImage& image() const noexcept { return *image_; }
  [[nodiscard]] const Origin& origin() const noexcept { return origin_; }
  [[nodiscard]] const View& view() const noexcept { return *origin_.view; }
  [[nodiscard]] const BackdropDepths& depths() const noexcept { return depths_; }

  /// Pixels of a cell's side.
  static constexpr int kCell = 8;
  [[nodiscard]] int cellsAcross() const noexcept { return across_; }
  [[nodiscard]] int cellsDown() const noexcept { return down_; }
  /// 1 / depth that each cell is warped by, row by row, in 1 / metres.
  [[nodiscard]] const std::vector<float>& nearness() const noexcept { return nearness_; }
  /// Largest 1 / depth; 0 if everything is infinitely far.
  [[nodiscard]] float nearest() const noexcept { return nearest_; }

  /// Error of a warp, root mean square over the image. Each block's error is limited: beyond that limit it looks no
  /// worse, so a leaf close to the eye does not dominate the whole picture.
  struct Error {
    float shift = 0.0F;  ///< pixels: a cell moves as a whole although its pixels differ in depth
    float zoom = 0.0F;   ///< octaves by which the nearest surface of a block is shown too large or too small
  };
  [[nodiscard]] Error errorOf(const WarpCamera& warp) const;

  /// A block of cells, the unit in which errors are summed.
  struct Block {
    world::Vec2 centre{0.0F};  ///< pixels of the camera
    float pixels = 0.0F;
    float covered = 0.0F;  ///< pixels that have a depth
    float mean = 0.0F;     ///< 1 / depth, of covered pixels
    float nearest = 0.0F;  ///< largest 1 / depth
    float squares = 0.0F;  ///< sum over its pixels of the squared difference from the nearness of their cell
  };
  [[nodiscard]] const std::vector<Block>& blocks() const noexcept { return blocks_; }

 private:
  [[nodiscard]] std::size_t indexOf(int column, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(column);
  }
  void chooseNearness();
  void measureBlocks();
  [[nodiscard]] float squaredErrors(const CellDepths& depths, int column, int row) const;

  std::shared_ptr<const raster::SemiPlanarImage> image_;
  BackdropDepths depths_;
  Origin origin_;
  int across_ = 0;
  int down_ = 0;
  std::vector<float> nearness_;
  std::vector<Block> blocks_;
  float nearest_ = 0.0F;
};

}  // namespace grove::node
