#include "node/messages/packing/picture_packing.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "node/messages/packing/packing.h"
#include "world/camera.h"

namespace grove::node {
namespace {

constexpr int kTile = 16;
constexpr int kMaxEdge = 16384;
constexpr std::uint32_t kCoverage = 0xFF000000U;

/// A piece of one row of a tile.
struct Piece {
  int row = 0;
  int begin = 0;
  int count = 0;
};

struct Tiles {
  int across = 0;
  int down = 0;
  std::vector<std::uint8_t> covered;  ///< by tile, row by row: 1 if any pixel is visible
};

int tilesAlong(int pixels) { return (pixels + kTile - 1) / kTile; }

std::size_t tileCount(const world::Rect& rect) {
  return static_cast<std::size_t>(tilesAlong(rect.width())) * static_cast<std::size_t>(tilesAlong(rect.height()));
}

Tiles tilesOf(const world::Rect& rect) {
  return {tilesAlong(rect.width()), tilesAlong(rect.height()), std::vector<std::uint8_t>(tileCount(rect))};
}

Tiles coveredTiles(const raster::Image& picture) {
  Tiles tiles = tilesOf(picture.rect);
  if (picture.opaque) {
    std::ranges::fill(tiles.covered, std::uint8_t{1});
    return tiles;
  }
  for (int row = 0; row < picture.height(); ++row) {
    const raster::Span span = picture.span(row);
    const std::uint32_t* const colour = picture.colourRow(row);
    std::uint8_t* const covered = tiles.covered.data() + std::ptrdiff_t{row / kTile} * tiles.across;
    for (int begin = span.begin; begin < span.end;) {
      const int end = std::min(span.end, (begin / kTile + 1) * kTile);
      std::uint32_t any = 0;
      for (int x = begin; x < end; ++x) any |= colour[x];
      covered[begin / kTile] |= (any & kCoverage) != 0 ? 1 : 0;
      begin = end;
    }
  }
  return tiles;
}

/// The rows of the covered tiles, with neighbouring tiles merged.
std::vector<Piece> piecesOf(const Tiles& tiles, int width, int height) {
  std::vector<Piece> pieces;
  for (int row = 0; row < height; ++row) {
    const std::uint8_t* const covered = tiles.covered.data() + std::ptrdiff_t{row / kTile} * tiles.across;
    for (int tile = 0; tile < tiles.across; ++tile) {
      if (covered[tile] == 0) continue;
      const int first = tile;
      while (tile + 1 < tiles.across && covered[tile + 1] != 0) ++tile;
      const int end = std::min((tile + 1) * kTile, width);
      pieces.push_back({row, first * kTile, end - first * kTile});
    }
  }
  return pieces;
}

std::size_t pixelsOf(const std::vector<Piece>& pieces) {
  std::size_t pixels = 0;
  for (const Piece& piece : pieces) pixels += static_cast<std::size_t>(piece.count);
  return pixels;
}

/// Empty rows may have a span that ends before it begins.
std::uint32_t joined(raster::Span span) {
  if (span.begin >= span.end) return 0;
  return static_cast<std::uint32_t>(span.begin) | static_cast<std::uint32_t>(span.end) << 16U;
}

void putSpans(PackWriter& writer, const raster::Image& picture) {
  std::vector<std::uint32_t> spans;
  spans.reserve(picture.spans.size());
  for (const raster::Span& span : picture.spans) spans.push_back(joined(span));
  writer.putPlanes(std::span<const std::uint32_t>(spans));
}

std::vector<raster::Span> takeSpans(PackReader& reader, const world::Rect& rect) {
  const auto rows = static_cast<std::size_t>(rect.height());
  reader.expect(rows * sizeof(std::uint32_t));
  std::vector<std::uint32_t> packed(rows);
  reader.takePlanes(std::span(packed));
  std::vector<raster::Span> spans;
  spans.reserve(rows);
  for (const std::uint32_t both : packed) {
    const raster::Span span{static_cast<int>(both & 0xFFFFU), static_cast<int>(both >> 16U)};
    if (span.begin > span.end || span.end > rect.width()) reader.fail("has a span out of range");
    spans.push_back(span);
  }
  return spans;
}

Tiles takeTiles(PackReader& reader, const world::Rect& rect) {
  reader.expect(tileCount(rect));
  Tiles tiles = tilesOf(rect);
  reader.takeBytes(std::as_writable_bytes(std::span(tiles.covered)));
  return tiles;
}

/// A plane's values in the pieces, in order. Outside of the rows' spans, the memory is undefined: writes `elsewhere`
/// instead.
template <class Pixel>
std::vector<Pixel> gathered(const std::vector<Piece>& pieces, const raster::Image& picture,
                            std::span<const Pixel> plane, Pixel elsewhere) {
  std::vector<Pixel> pixels;
  pixels.reserve(pixelsOf(pieces));
  for (const Piece& piece : pieces) {
    const raster::Span span = picture.span(piece.row);
    const int end = piece.begin + piece.count;
    const int first = std::clamp(span.begin, piece.begin, end);
    const int last = std::clamp(span.end, first, end);
    const Pixel* const row = plane.data() + std::ptrdiff_t{piece.row} * picture.width();
    pixels.insert(pixels.end(), static_cast<std::size_t>(first - piece.begin), elsewhere);
    pixels.insert(pixels.end(), row + first, row + last);
    pixels.insert(pixels.end(), static_cast<std::size_t>(end - last), elsewhere);
  }
  return pixels;
}

template <class Pixel>
void putPlane(PackWriter& writer, const std::vector<Piece>& pieces, const raster::Image& picture,
              std::span<const Pixel> plane, Pixel elsewhere) {
  if (picture.spans.empty() && pixelsOf(pieces) == plane.size()) {
    writer.putPlanes(plane);
  } else {
    writer.putPlanes(std::span<const Pixel>(gathered(pieces, picture, plane, elsewhere)));
  }
}

/// The inverse of putPlane(): all of the plane.
template <class Pixel>
void takePlane(PackReader& reader, const std::vector<Piece>& pieces, std::span<Pixel> plane, int width,
               Pixel elsewhere) {
  const std::size_t count = pixelsOf(pieces);
  if (count == plane.size()) {
    reader.takePlanes(plane);
    return;
  }
  std::vector<Pixel> pixels(count);
  reader.takePlanes(std::span(pixels));
  std::ranges::fill(plane, elsewhere);
  const Pixel* from = pixels.data();
  for (const Piece& piece : pieces) {
    std::copy_n(from, piece.count, plane.data() + std::ptrdiff_t{piece.row} * width + piece.begin);
    from += piece.count;
  }
}

/// Reads a rectangle; one with pixels must lie within `asked`.
world::Rect takeRect(PackReader& reader, const world::Rect& asked) {
  world::Rect rect;
  rect.left = reader.takeWithin(-kMaxEdge, kMaxEdge);
  rect.top = reader.takeWithin(-kMaxEdge, kMaxEdge);
  rect.right = reader.takeWithin(rect.left, kMaxEdge);
  rect.bottom = reader.takeWithin(rect.top, kMaxEdge);
  if (rect.empty()) return {rect.left, rect.top, rect.left, rect.top};
  if (world::overlap(rect, asked) != rect) reader.fail("is larger than requested");
  const auto pixels = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
  if (pixels > kMaxPicturePixels) reader.fail("is too large");
  return rect;
}

}  // namespace

PackedBytes packPicture(const raster::Image& picture) {
  const world::Rect& rect = picture.rect;
  if (picture.colour.size() > kMaxPicturePixels) throw PackingError("a picture is too large to pack");
  const Tiles tiles = coveredTiles(picture);
  const std::vector<Piece> pieces = piecesOf(tiles, rect.width(), rect.height());
  PackWriter writer(64 + tiles.covered.size() + picture.spans.size() * sizeof(raster::Span) +
                    pixelsOf(pieces) * (sizeof(std::uint32_t) + sizeof(float)));
  writer.put(rect.left).put(rect.top).put(rect.right).put(rect.bottom);
  writer.put(static_cast<std::uint8_t>(picture.opaque ? 1 : 0));
  writer.put(static_cast<std::uint8_t>(picture.spans.empty() ? 0 : 1));
  if (!picture.spans.empty()) putSpans(writer, picture);
  writer.putBytes(std::as_bytes(std::span(tiles.covered)));
  putPlane(writer, pieces, picture, std::span<const std::uint32_t>(picture.colour), std::uint32_t{0});
  putPlane(writer, pieces, picture, std::span<const float>(picture.depth), world::kInfiniteDepth);
  return writer.take();
}

std::shared_ptr<const raster::Image> unpackPicture(std::span<const std::byte> bytes, const world::Rect& asked,
                                                   raster::ImagePool& images) {
  PackReader reader(bytes, "a picture");
  const world::Rect rect = takeRect(reader, asked);
  const bool opaque = reader.takeWithin<std::uint8_t>(0, 1) != 0;
  const bool hasSpans = reader.takeWithin<std::uint8_t>(0, 1) != 0;
  std::vector<raster::Span> spans = hasSpans ? takeSpans(reader, rect) : std::vector<raster::Span>();
  const std::vector<Piece> pieces = piecesOf(takeTiles(reader, rect), rect.width(), rect.height());
  reader.expect(pixelsOf(pieces) * (sizeof(std::uint32_t) + sizeof(float)));
  const std::shared_ptr<raster::Image> picture = images.acquire(rect);
  picture->opaque = opaque;
  picture->spans = std::move(spans);
  const std::span<std::uint32_t> colour = picture->colour;
  const std::span<float> depth = picture->depth;
  takePlane(reader, pieces, colour, rect.width(), std::uint32_t{0});
  takePlane(reader, pieces, depth, rect.width(), world::kInfiniteDepth);
  reader.finish();
  if (opaque && !std::ranges::all_of(colour, [](std::uint32_t pixel) { return pixel >= kCoverage; })) {
    reader.fail("is marked opaque, but has transparent pixels");
  }
  if (std::ranges::any_of(depth, [](float metres) { return !(metres >= 0.0F); })) reader.fail("has an invalid depth");
  return picture;
}

}  // namespace grove::node
