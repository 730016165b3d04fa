#include "stream/encode/h264/deblocking/deblocking.h"

#include <cstddef>

#include "stream/encode/h264/deblocking/deblocking_kernels.h"
#include "stream/encode/h264/deblocking/deblocking_limits.h"
#include "stream/encode/h264/deblocking/deblocking_strengths.h"
#include "stream/encode/h264/residual/quantisation.h"

namespace grove::stream::h264 {
namespace {

EdgeLimits limitsBetween(const Macroblock& p, const Macroblock& q) {
  const auto mean = [](int a, int b) { return (a + b + 1) / 2; };
  return {deblockingLimits(mean(p.quantiser, q.quantiser)),
          deblockingLimits(mean(chromaQuantiser(p.quantiser), chromaQuantiser(q.quantiser)))};
}

/// `border` is null where the picture ends. Most have the same quantiser as their neighbours.
EdgeLimits borderLimits(const Macroblock* border, const Macroblock& macroblock, const EdgeLimits& inside) {
  return border == nullptr || border->quantiser == macroblock.quantiser ? inside : limitsBetween(*border, macroblock);
}

MacroblockPlace pixelsAt(ReferencePicture& picture, int column, int row) {
  const auto chroma = [&](std::size_t i) {
    return picture.plane(i).at(column * kMacroblock / 2, row * kMacroblock / 2);
  };
  return {picture.plane(0).at(column * kMacroblock, row * kMacroblock),
          {chroma(1), chroma(2)},
          picture.plane(0).stride,
          picture.plane(1).stride};
}

}  // namespace

void deblockRow(const MacroblockGrid& grid, int row, ReferencePicture& picture) {
  FilteredEdges edges;
  for (int column = 0; column < grid.across; ++column) {
    const Macroblock& macroblock = grid.at(column, row);
    const Macroblock* const left = column > 0 ? &grid.at(column - 1, row) : nullptr;
    const Macroblock* const above = row > 0 ? &grid.at(column, row - 1) : nullptr;
    if (!findStrengths(macroblock, left, above, edges.strengths)) continue;
    edges.inside = limitsBetween(macroblock, macroblock);
    edges.left = borderLimits(left, macroblock, edges.inside);
    edges.above = borderLimits(above, macroblock, edges.inside);
    filterEdges(edges, pixelsAt(picture, column, row));
  }
}

}  // namespace grove::stream::h264
