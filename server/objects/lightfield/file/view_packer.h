#pragma once

#include <cstdint>
#include <vector>

#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

/// One rendered view, rows from the top, encoded as LightField describes.
struct DenseView {
  int size = 0;
  std::vector<std::uint16_t> depth;                ///< size * size
  std::vector<std::vector<std::uint32_t>> colour;  ///< by lighting, size * size each
};

/// One view with its mip pyramid in blocks, numbered from 0 within the view.
struct PackedView {
  std::vector<std::vector<std::uint32_t>> blocks;  ///< by level, row by row; kNoBlock if empty
  std::vector<std::uint16_t> depth;                ///< kBlockTexels per block
  std::vector<std::vector<std::uint32_t>> colour;  ///< by lighting

  [[nodiscard]] std::size_t blockCount() const noexcept { return depth.size() / kBlockTexels; }
};

[[nodiscard]] PackedView packView(const DenseView& view, int levels);

/// Assembles a light field in memory, for small ones and for tests; `grove bake` streams into a file instead.
class LightFieldBuilder {
 public:
  /// `shape` has everything but blocks, depth, colour, bytes and storage.
  LightFieldBuilder(LightField shape, int lightings);
  /// Add each view once, in any order.
  void set(int view, PackedView packed);
  [[nodiscard]] LightField build() &&;

 private:
  LightField shape_;
  int lightings_;
  std::vector<PackedView> views_;
};

}  // namespace grove::objects::lightfield
