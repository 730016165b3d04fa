#include "objects/herd/frontend/deer_shadow.h"

#include <algorithm>
#include <cmath>

#include "world/ground/ground_shadow.h"

namespace grove::objects::herd {
namespace {

using world::Vec3;

// Metres above the ground: shadows fall on grass, and fade where it ends. The ground may bend away from the plane with
// the distance from the animal.
constexpr float kLowest = -0.14F;
constexpr float kFadesFrom = 0.14F;
constexpr float kFadesTo = 0.34F;
constexpr float kBend = 0.025F;  // per metre
/// Above that, the animal's own pixels stay as they are.
constexpr float kOwnHeight = 0.05F;

/// Share of kLongestShadow after which the sun's shadow fades.
constexpr float kFadesAfter = 0.6F;
/// Of red, green and blue as they are displayed; what remains is the sky's light.
constexpr Vec3 kSunStrength(0.56F, 0.48F, 0.36F);
/// Below this share of the sun, its shadow is invisible.
constexpr float kFaintest = 0.04F;
/// A body that is nearer than what is behind it by more than that is not the same surface. Relative.
constexpr float kSameDepth = 0.002F;

/// Pixels.
constexpr int kChunk = 64;

Vec3 horizontal(Vec3 way) { return glm::normalize(Vec3(way.x, 0.0F, way.z) + Vec3(1.0e-6F, 0.0F, 0.0F)); }

/// `sun` and `sky`: the hidden shares.
std::uint32_t darkened(std::uint32_t colour, float sun, float sky) {
  const Vec3 light = 256.0F * (1.0F - sky) * (1.0F - sun * kSunStrength);
  const auto channel = [&](unsigned shift, float of256) {
    return (((colour >> shift & 0xFFU) * static_cast<std::uint32_t>(static_cast<int>(of256))) >> 8U) << shift;
  };
  return (colour & 0xFF000000U) | channel(0, light.r) | channel(8, light.g) | channel(16, light.b);
}

/// 1 at the ground, 0 beyond what shadows fall on; `bend`: metres by which the ground may be off the plane.
float fadeAt(float height, float bend) {
  return (1.0F - glm::smoothstep(kFadesFrom + bend, kFadesTo + bend, height)) *
         glm::smoothstep(kLowest - bend, 0.5F * kLowest - bend, height);
}

/// Corners of the space in which the ground may be darkened.
std::array<Vec3, 16> cornersOf(const Ground& ground, std::span<const Capsule> casters, const Contact& contact,
                               Vec3 place, Vec3 sun, bool hasSun) {
  const Vec3 away = -horizontal(sun);
  const Vec3 aside(-away.z, 0.0F, away.x);
  const float perMetre = glm::length(world::shadowPerMetre(sun));
  const float middle = glm::dot(place, aside);
  const float start = glm::dot(place, away);
  float left = middle;
  float right = middle;
  float end = start;
  if (hasSun) {
    for (const Capsule& each : casters) {
      for (const auto& [at, radius] : {std::pair(each.from, each.fromRadius), std::pair(each.to, each.toRadius)}) {
        const float across = glm::dot(at, aside);
        left = std::min(left, across - radius);
        right = std::max(right, across + radius);
        const float height = std::max(0.0F, ground.height.at(at)) + radius;
        end = std::max(end, glm::dot(at, away) + radius + std::min(perMetre * height, world::kLongestShadow));
      }
    }
  }
  const float around = contact.radius();
  const auto corner = [&](float along, float across, float above) {
    const Vec3 point = ground.below(along * away + across * aside);
    return Vec3(point.x, point.y + above, point.z);
  };
  const float bend = kBend * (end - start);
  std::array<Vec3, 16> corners;
  std::size_t i = 0;
  for (const bool isHigh : {false, true}) {
    const float near = isHigh ? kFadesTo : kLowest;
    const float far = isHigh ? kFadesTo + bend : kLowest - bend;
    for (const float across : {middle - around, middle + around}) {
      corners[i++] = corner(start - around, across, near);
      corners[i++] = corner(start + around, across, near);
    }
    for (const float across : {left, right}) {
      corners[i++] = corner(start, across, near);
      corners[i++] = corner(end, across, far);
    }
  }
  return corners;
}

/// One row of an animal's own picture; nothing if it has none there.
class BodyRow {
 public:
  BodyRow(const raster::Image* body, int y) {
    if (body == nullptr || y < body->rect.top || y >= body->rect.bottom) return;
    const int line = y - body->rect.top;
    const raster::Span span = body->span(line);
    depths_ = body->depthRow(line) + span.begin;
    begin_ = body->rect.left + span.begin;
    end_ = body->rect.left + span.end;
  }

  /// Whether a pixel of the frame with this depth shows the animal.
  [[nodiscard]] bool isAt(int x, float depth) const {
    return x >= begin_ && x < end_ && std::abs(depths_[x - begin_] - depth) <= kSameDepth * depth;
  }

 private:
  const float* depths_ = nullptr;
  int begin_ = 0;
  int end_ = 0;
};

}  // namespace

DeerShadow::DeerShadow(const AnimalPose& pose, float size, const Capsules& casters, float sunShare,
                       const world::Sky& sky, const world::Camera& camera, const world::Rect& frame)
    : ground_(pose),
      place_(pose.place),
      away_(-horizontal(sky.sun)),
      sunStrength_(sky.sun.y > 0.0F && sunShare > kFaintest ? sunShare : 0.0F),
      mask_(sunStrength_ > 0.0F ? SunMask(casters, sky.sun, ground_.point) : SunMask()),
      contact_(pose, size, ground_),
      hull_(cornersOf(ground_, casters, contact_, pose.place, sky.sun, sunStrength_ > 0.0F), camera, frame) {}

void DeerShadow::draw(const world::Camera& camera, const raster::Image* body, raster::Image& frame) const {
  const PixelRays rays(camera);
  for (int y = rect().top; y < rect().bottom; ++y) {
    const raster::Span span = hull_.row(y);
    if (span.begin < span.end) drawRow(rays, {span.begin, y, span.end, y + 1}, body, frame);
  }
}

void DeerShadow::drawRow(const PixelRays& rays, const world::Rect& row, const raster::Image* body,
                         raster::Image& frame) const {
  constexpr float kMostBend = kBend * (world::kLongestShadow + kReach);
  const BodyRow own(body, row.top);
  const Vec3 eye = rays.eye;
  const Vec3 step = rays.right;
  const Vec3 ray = rays.of(row.left, row.top);
  const AffineRow heights(ground_.height, eye, ray, step);
  const AffineRow columns(mask_.column(), eye, ray, step);
  const AffineRow lines(mask_.line(), eye, ray, step);
  const std::ptrdiff_t start = row.left - frame.rect.left;
  std::uint32_t* const colours = frame.colourRow(row.top - frame.rect.top) + start;
  const float* const depths = frame.depthRow(row.top - frame.rect.top) + start;
  std::array<float, kChunk> height;
  std::array<float, kChunk> column;
  std::array<float, kChunk> line;
  for (int from = 0; from < row.width(); from += kChunk) {
    const int count = std::min(kChunk, row.width() - from);
    // Most pixels are no ground: what tells them apart is computed for many at once.
    heights.fill(depths + from, from, count, height.data());
    columns.fill(depths + from, from, count, column.data());
    lines.fill(depths + from, from, count, line.data());
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (!(height[at] > kLowest - kMostBend && height[at] < kFadesTo + kMostBend)) continue;
      const int x = from + i;
      const float sun = sunStrength_ * mask_.at(column[at], line[at]);
      const Vec3 place = eye + depths[x] * (ray + static_cast<float>(x) * step) - place_;
      const float sky = contact_.at(place.x, place.z);
      if (sun + sky <= 0.0F) continue;
      if (height[at] > kOwnHeight && own.isAt(row.left + x, depths[x])) continue;
      const float along = std::max(0.0F, glm::dot(place, away_));
      const float fade = fadeAt(height[at], kBend * along);
      const float reach = 1.0F - glm::smoothstep(kFadesAfter * world::kLongestShadow, world::kLongestShadow, along);
      colours[x] = darkened(colours[x], sun * reach * fade, sky * fade);
    }
  }
}

}  // namespace grove::objects::herd
