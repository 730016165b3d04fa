#include "objects/lightfield/file/view_packer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace grove::objects::lightfield {
namespace {

constexpr float kClusterTexels = 4.0F;

/// The depth of four texels at half resolution: the front surface if they lie on both sides of an edge, because a mean
/// of both would lie in empty space. `reach` is the largest depth of a surface, in steps of depth.
std::uint16_t frontDepth(const std::array<std::uint16_t, 4>& children, float reach) {
  const std::uint16_t front = *std::ranges::min_element(children);
  if (front == kNoDepth) return kNoDepth;
  std::uint32_t sum = 0;
  std::uint32_t count = 0;
  for (const std::uint16_t depth : children) {
    if (depth == kNoDepth || static_cast<float>(depth - front) > reach) continue;
    sum += depth;
    ++count;
  }
  return static_cast<std::uint16_t>((sum + count / 2) / count);
}

std::uint32_t meanColour(const std::array<std::uint32_t, 4>& children) {
  constexpr std::uint32_t kEvenBytes = 0x00FF00FFU;
  constexpr std::uint32_t kHalf = 0x00020002U;
  std::uint32_t even = kHalf;
  std::uint32_t odd = kHalf;
  for (const std::uint32_t colour : children) {
    even += colour & kEvenBytes;
    odd += (colour >> 8U) & kEvenBytes;
  }
  return ((even >> 2U) & kEvenBytes) | (((odd >> 2U) & kEvenBytes) << 8U);
}

/// Calls f(texel of the half, its four children) for a picture of `half` squared texels and one of twice its size.
template <class T, class F>
void forEachQuad(const std::vector<T>& fine, int half, F f) {
  const auto across = static_cast<std::size_t>(half);
  for (std::size_t y = 0; y < across; ++y) {
    for (std::size_t x = 0; x < across; ++x) {
      const T* top = fine.data() + 4 * y * across + 2 * x;
      f(y * across + x, std::array<T, 4>{top[0], top[1], top[2 * across], top[2 * across + 1]});
    }
  }
}

DenseView halved(const DenseView& fine) {
  DenseView coarse;
  coarse.size = fine.size / 2;
  const auto texels = static_cast<std::size_t>(coarse.size) * static_cast<std::size_t>(coarse.size);
  // A view is about as deep as it is wide.
  const float reach = kClusterTexels * static_cast<float>(kNoDepth) / static_cast<float>(coarse.size);
  coarse.depth.resize(texels);
  forEachQuad(fine.depth, coarse.size,
              [&](std::size_t at, const auto& children) { coarse.depth[at] = frontDepth(children, reach); });
  for (const auto& lit : fine.colour) {
    auto& into = coarse.colour.emplace_back(texels);
    forEachQuad(lit, coarse.size, [&](std::size_t at, const auto& children) { into[at] = meanColour(children); });
  }
  return coarse;
}

/// Copies a block with its apron from a square picture; texels beyond the border are `nothing`.
template <class T>
std::array<T, kBlockTexels> cut(const std::vector<T>& picture, int size, int row, int column, T nothing) {
  std::array<T, kBlockTexels> block;
  block.fill(nothing);
  const int height = std::min(kBlockStride, size - row * kBlock);
  const int width = std::min(kBlockStride, size - column * kBlock);
  for (int y = 0; y < height; ++y) {
    const auto from = picture.begin() + std::ptrdiff_t{row * kBlock + y} * size + column * kBlock;
    std::copy_n(from, width, block.begin() + std::ptrdiff_t{y} * kBlockStride);
  }
  return block;
}

void packLevel(const DenseView& view, PackedView& into) {
  const int across = view.size / kBlock;
  auto& table = into.blocks.emplace_back();
  table.reserve(static_cast<std::size_t>(across) * static_cast<std::size_t>(across));
  for (int row = 0; row < across; ++row) {
    for (int column = 0; column < across; ++column) {
      const auto depth = cut(view.depth, view.size, row, column, kNoDepth);
      // The apron counts: a footprint that starts in an empty block may end in a covered one.
      if (std::ranges::all_of(depth, [](std::uint16_t d) { return d == kNoDepth; })) {
        table.push_back(kNoBlock);
        continue;
      }
      table.push_back(static_cast<std::uint32_t>(into.blockCount()));
      into.depth.insert(into.depth.end(), depth.begin(), depth.end());
      for (std::size_t k = 0; k < view.colour.size(); ++k) {
        const auto colour = cut(view.colour[k], view.size, row, column, std::uint32_t{0});
        into.colour[k].insert(into.colour[k].end(), colour.begin(), colour.end());
      }
    }
  }
}

/// Memory of a field assembled here.
struct Store {
  std::vector<std::vector<std::uint32_t>> blocks;
  std::vector<std::uint16_t> depth;
  std::vector<std::vector<std::uint32_t>> colour;
  std::vector<std::uint8_t> voxels;
  std::vector<std::vector<std::uint32_t>> heldOutColour;
  std::vector<std::vector<float>> heldOutDepth;
};

template <class T>
std::size_t append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
  return from.size() * sizeof(T);
}

}  // namespace

PackedView packView(const DenseView& view, int levels) {
  assert(levels >= 1 && (view.size >> (levels - 1)) >= kBlock);
  PackedView packed;
  packed.colour.resize(view.colour.size());
  packLevel(view, packed);
  DenseView coarse;
  for (int level = 1; level < levels; ++level) {
    coarse = halved(level == 1 ? view : coarse);
    packLevel(coarse, packed);
  }
  return packed;
}

LightFieldBuilder::LightFieldBuilder(LightField shape, int lightings)
    : shape_(std::move(shape)), lightings_(lightings), views_(static_cast<std::size_t>(shape_.sphere.views())) {
  assert(lightings >= 1 && lightings <= kMaxLightings);
}

void LightFieldBuilder::set(int view, PackedView packed) {
  assert(packed.blocks.size() == static_cast<std::size_t>(shape_.levels));
  assert(packed.colour.size() == static_cast<std::size_t>(lightings_));
  auto& place = views_[static_cast<std::size_t>(view)];
  assert(place.blocks.empty() && "each view once");
  place = std::move(packed);
}

LightField LightFieldBuilder::build() && {
  LightField field = std::move(shape_);
  const auto store = std::make_shared<Store>();
  store->blocks.resize(static_cast<std::size_t>(field.levels));
  store->colour.resize(static_cast<std::size_t>(lightings_));
  field.bytes = 0;
  for (PackedView& packed : views_) {
    assert(!packed.blocks.empty() && "a view is missing");
    const auto first = static_cast<std::uint32_t>(store->depth.size() / kBlockTexels);
    for (std::size_t level = 0; level < store->blocks.size(); ++level) {
      for (std::uint32_t& block : packed.blocks[level]) block += block == kNoBlock ? 0 : first;
      field.bytes += append(store->blocks[level], packed.blocks[level]);
    }
    field.bytes += append(store->depth, packed.depth);
    for (std::size_t k = 0; k < store->colour.size(); ++k) field.bytes += append(store->colour[k], packed.colour[k]);
    packed = {};
  }
  store->voxels.assign(field.voxels.cells.begin(), field.voxels.cells.end());
  field.voxels.cells = store->voxels;
  field.bytes += store->voxels.size();
  for (HeldOutView& view : field.heldOut) {
    view.colour = store->heldOutColour.emplace_back(view.colour.begin(), view.colour.end());
    view.depth = store->heldOutDepth.emplace_back(view.depth.begin(), view.depth.end());
    field.bytes += view.colour.size_bytes() + view.depth.size_bytes();
  }
  field.blocks.assign(store->blocks.begin(), store->blocks.end());
  field.depth = store->depth;
  field.colour.assign(store->colour.begin(), store->colour.end());
  field.storage = store;
  return field;
}

}  // namespace grove::objects::lightfield
