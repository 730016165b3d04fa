#include "objects/lightfield/backend/simd/sampler_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "objects/lightfield/backend/simd/sampler_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "objects/lightfield/backend/simd/blend_inl.h"
#include "objects/lightfield/backend/simd/surface_search_inl.h"

HWY_BEFORE_NAMESPACE();
namespace grove::objects::lightfield::simd::HWY_NAMESPACE {

using world::Vec3;

/// Distance below which nothing is shown, metres.
constexpr float kNear = 0.02F;

/// Renders the tiles of one picture.
class Picture {
 public:
  Picture(const SampleRequest& request, DepthCorrection correction, raster::Image& image)
      : request_(request),
        field_(*request.field),
        image_(image),
        corrected_(correction == DepthCorrection::kOn),
        lenses_(field_, request.level),
        search_(field_, request.level, lenses_),
        blend_(field_, request.level, request.lighting, lenses_) {
    tile_.eye = request.camera.eye;
  }

  void render() {
    for (int top = 0; top < image_.height(); top += kTileHeight) {
      for (int left = 0; left < image_.width(); left += kTileWidth) {
        if (!aim(left, top)) {
          clear(left, top);
          continue;
        }
        if (corrected_) {
          search_.run(tile_);
        } else {
          meetPlane();
        }
        write(left, top, blend_.run(tile_));
      }
    }
  }

 private:
  /// Sets up the tile's rays; returns false if none hits the object's bounds.
  bool aim(int left, int top) {
    const Vec3 eye = request_.camera.eye;
    const Vec3 corner = request_.camera.ray(static_cast<float>(image_.rect.left + left) + 0.5F,
                                            static_cast<float>(image_.rect.top + top) + 0.5F);
    const Vec3 right = request_.camera.perColumn;
    const Vec3 down = request_.camera.perRow;
    const Vec3 low = field_.bounds.low - eye;
    const Vec3 high = field_.bounds.high - eye;
    const Vec3 out = eye - field_.geometry.centre;
    const float beyond = glm::dot(out, out) - field_.geometry.radius * field_.geometry.radius;
    const float n = static_cast<float>(field_.sphere.subdivision());
    const int columns = std::min(kTileWidth, image_.width() - left);
    const int rows = std::min(kTileHeight, image_.height() - top);
    Mask anyMeets;
    for (int g = 0; g < kGroups; ++g) {
      const auto at = static_cast<std::size_t>(g);
      const Floats column = toFloats((upwards() & (kGroupWidth - 1)) + groupColumn(g));
      const Floats row = toFloats(shiftRight<2>(upwards()) + groupRow(g));
      const Floats x = corner.x + row * down.x + column * right.x;
      const Floats y = corner.y + row * down.y + column * right.y;
      const Floats z = corner.z + row * down.z + column * right.z;
      Floats from = kNear;
      Floats to = world::kInfiniteDepth;
      cut(x, low.x, high.x, from, to);
      cut(y, low.y, high.y, from, to);
      cut(z, low.z, high.z, from, to);
      const Mask inside = (column < static_cast<float>(columns)) & (row < static_cast<float>(rows));
      to = onlyWhere(inside, to);
      tile_.rayX[at] = x;
      tile_.rayY[at] = y;
      tile_.rayZ[at] = z;
      tile_.from[at] = from;
      tile_.to[at] = to;
      anyMeets |= to > from;

      const Floats square = x * x + y * y + z * z;
      const Floats along = out.x * x + out.y * y + out.z * z;
      const Floats root = sqrt(max(along * along - square * beyond, 0.0F));
      const Floats entry = -(along + root) / square;
      const Floats px = out.x + entry * x;
      const Floats py = max(out.y + entry * y, 0.0F);
      const Floats pz = out.z + entry * z;
      const Floats scale = n / max(abs(px) + py + abs(pz), 1.0e-20F);
      tile_.u[at] = px * scale;
      tile_.v[at] = pz * scale;
    }
    return any(anyMeets);
  }

  static void cut(Floats direction, float low, float high, Floats& from, Floats& to) {
    const Floats inverse = 1.0F / select(abs(direction) > 1.0e-12F, direction, 1.0e-12F);
    const Floats a = low * inverse;
    const Floats b = high * inverse;
    from = max(from, min(a, b));
    to = min(to, max(a, b));
  }

  /// Without depth, all points are assumed to lie on the plane through the object's middle.
  void meetPlane() {
    const Vec3 ahead = field_.geometry.target - tile_.eye;
    const float distance = glm::dot(ahead, ahead);
    for (std::size_t g = 0; g < kGroups; ++g) {
      const Floats advance = ahead.x * tile_.rayX[g] + ahead.y * tile_.rayY[g] + ahead.z * tile_.rayZ[g];
      tile_.depth[g] = distance / max(advance, 1.0e-6F);
      tile_.found[g] = (tile_.to[g] > tile_.from[g]) & (advance > 0.0F);
      tile_.guessed[g] = tile_.found[g];
    }
  }

  void write(int left, int top, const Blended& blended) const {
    const int columns = std::min(kTileWidth, image_.width() - left);
    const int rows = std::min(kTileHeight, image_.height() - top);
    const float clear = 1.0F - request_.haze.amount;
    const auto veil = [&](std::size_t channel) { return request_.haze.colour[channel] * request_.haze.amount; };
    for (int g = 0; g < kGroups; ++g) {
      const auto at = static_cast<std::size_t>(g);
      const int first = groupColumn(g);
      const int count = std::min(kGroupWidth, columns - first);
      const int lines = std::min(kGroupHeight, rows - groupRow(g));
      if (lines <= 0 || count <= 0) continue;
      const Floats scale = 1.0F / max(blended.weight[at], 1.0e-6F);
      const Floats coverage = blended.coverage[at] * scale;
      const auto byte = [&](Floats sum, float veiled) {
        return truncate(min(sum * scale * clear + coverage * veiled, 255.0F) + 0.5F);
      };
      const Ints alpha = truncate(coverage + 0.5F);
      const Ints colour = byte(blended.red[at], veil(0)) | shiftLeft<8>(byte(blended.green[at], veil(1))) |
                          shiftLeft<16>(byte(blended.blue[at], veil(2))) | shiftLeft<24>(alpha);
      const Mask shown = tile_.found[at] & (alpha > 0);
      std::uint32_t colours[kLanes];
      float depths[kLanes];
      store(onlyWhere(shown, colour), colours);
      store(select(shown, tile_.depth[at], world::kInfiniteDepth), depths);
      for (int line = 0; line < lines; ++line) {
        const int row = top + groupRow(g) + line;
        std::copy_n(colours + line * kGroupWidth, count, image_.colourRow(row) + left + first);
        std::copy_n(depths + line * kGroupWidth, count, image_.depthRow(row) + left + first);
      }
    }
  }

  void clear(int left, int top) const {
    const int columns = std::min(kTileWidth, image_.width() - left);
    const int bottom = std::min(top + kTileHeight, image_.height());
    for (int row = top; row < bottom; ++row) {
      std::fill_n(image_.colourRow(row) + left, columns, 0U);
      std::fill_n(image_.depthRow(row) + left, columns, world::kInfiniteDepth);
    }
  }

  const SampleRequest& request_;
  const LightField& field_;
  raster::Image& image_;
  const bool corrected_;
  Lenses lenses_;
  SurfaceSearch search_;
  Blend blend_;
  Tile tile_;
};

void renderPicture(const SampleRequest& request, DepthCorrection correction, raster::Image& image) {
  Picture(request, correction, image).render();
}

}  // namespace grove::objects::lightfield::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace grove::objects::lightfield::simd {

HWY_EXPORT(renderPicture);

void renderPicture(const SampleRequest& request, DepthCorrection correction, raster::Image& image) {
  HWY_DYNAMIC_DISPATCH(renderPicture)(request, correction, image);
}

}  // namespace grove::objects::lightfield::simd

#endif  // HWY_ONCE
