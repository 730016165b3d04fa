#include "objects/mesh/rasteriser.h"

#include <algorithm>
#include <cmath>

#include "objects/mesh/scan_converter.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;
using world::Vec4;

constexpr int kLanes = 16;
constexpr std::size_t kPlanes = 6;
constexpr int kRowsAtOnce = 32;
constexpr float kSixteenths = 15.0F / 255.0F;

using Planes = std::array<float, kPlanes>;

inline float onGrid(float pixels) { return std::floor(pixels * (1.0F / kSubPixel) + 0.5F) * kSubPixel; }

inline float byteOf(std::uint32_t packed, unsigned shift) {
  return static_cast<float>(static_cast<std::int32_t>((packed >> shift) & 0xFFU));
}

/// The run's vertices, as pixels times depth and depth.
void transformRun(const VertexArrays& arrays, std::size_t first, std::size_t end, const world::Mat4& bone,
                  const world::Camera& camera, ScreenVertices& vertices) {
  const Vec3 forward = camera.pose.forward();
  const float focal = camera.focal();
  const world::Mat4 toBone = glm::transpose(bone);
  const auto plane = [&](Vec3 axis) { return toBone * Vec4(axis, -glm::dot(axis, camera.pose.position)); };
  const Vec4 pu = plane(camera.pose.right() * focal + forward * (0.5F * static_cast<float>(camera.width)));
  const Vec4 pv = plane(camera.pose.up() * -focal + forward * (0.5F * static_cast<float>(camera.height)));
  const Vec4 pz = plane(forward);
  const float* __restrict x = arrays.positionX.data();
  const float* __restrict y = arrays.positionY.data();
  const float* __restrict z = arrays.positionZ.data();
  float* __restrict u = vertices.u.data();
  float* __restrict v = vertices.v.data();
  float* __restrict depth = vertices.depth.data();
  float nearest = vertices.nearest;
  for (std::size_t i = first; i < end; ++i) {
    u[i] = pu.x * x[i] + pu.y * y[i] + pu.z * z[i] + pu.w;
    v[i] = pv.x * x[i] + pv.y * y[i] + pv.z * z[i] + pv.w;
    depth[i] = pz.x * x[i] + pz.y * y[i] + pz.z * z[i] + pz.w;
    nearest = std::min(nearest, depth[i]);
  }
  vertices.nearest = nearest;
}

/// One vector of pixels: what is nearer than the depth there replaces it. `row` are the planes at the first pixel.
inline void fill(const Planes& row, const Planes& step, float least, float most, int count,
                 std::uint32_t* __restrict surface, float* __restrict depth) {
  for (int i = 0; i < kLanes; ++i) {
    const auto lane = static_cast<float>(i);
    // A sliver's planes are too steep for floats, so what they give is held within the triangle's range.
    const float reversed = std::min(std::max(row[0] + lane * step[0], least), most);
    const float scale = 1.0F / reversed;
    const auto shade = [&](std::size_t plane, float top) {
      const float value = std::min(std::max((row[plane] + lane * step[plane]) * scale, 0.0F), top);
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(value + 0.5F));
    };
    const std::uint32_t packed = shade(1, 255.0F) | shade(2, 255.0F) << 8U | shade(3, 255.0F) << 16U |
                                 shade(5, 15.0F) << 24U | shade(4, 15.0F) << 28U;
    const bool shown = (i < count) & (reversed > depth[i]);
    surface[i] = shown ? packed : surface[i];
    depth[i] = shown ? reversed : depth[i];
  }
}

}  // namespace

ClipVertex ScreenVertices::clipVertex(std::size_t index, float lichen) const noexcept {
  const std::uint32_t packed = light[index];
  return {u[index],
          v[index],
          depth[index],
          {byteOf(packed, 0), byteOf(packed, 8), byteOf(packed, 16), byteOf(packed, 24) * kSixteenths, lichen * 15.0F}};
}

void Canvas::begin(const world::Rect& to) {
  for (std::size_t row = 0; row < spans.size(); ++row) {
    const node::Span span = spans[row];
    if (span.begin < span.end) {
      std::fill_n(depth.data() + static_cast<std::ptrdiff_t>(row) * stride + span.begin, span.end - span.begin, 0.0F);
    }
  }
  rect = to;
  stride = (to.width() + 2 * kLanes - 2) / kLanes * kLanes;
  const std::size_t pixels = static_cast<std::size_t>(stride) * static_cast<std::size_t>(to.height());
  // Where the depth says that nothing is, the surface is whatever was there before.
  if (surface.size() < pixels) surface.resize(pixels);
  if (depth.size() < pixels) depth.resize(pixels);
  spans.assign(static_cast<std::size_t>(to.height()), {to.width(), 0});
}

void project(const VertexArrays& arrays, const Drawing& drawing, ScreenVertices& vertices) {
  const std::size_t count = vertices.light.size();
  const float nearDepth = drawing.camera->nearDepth;
  vertices.u.resize(count);
  vertices.v.resize(count);
  vertices.depth.resize(count);
  vertices.corners.resize(count);
  vertices.nearest = world::kInfiniteDepth;
  for (const VertexArrays::Run& run : arrays.runs) {
    transformRun(arrays, run.begin, std::min(run.end, count), drawing.bones[run.bone], *drawing.camera, vertices);
  }
  const float* __restrict u = vertices.u.data();
  const float* __restrict v = vertices.v.data();
  const float* __restrict depth = vertices.depth.data();
  const float* __restrict lichen = arrays.lichen.data();
  const std::uint32_t* __restrict light = vertices.light.data();
  Corner* __restrict corners = vertices.corners.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float perDepth = 1.0F / depth[i];
    const float reversed = nearDepth * perDepth;
    const std::uint32_t packed = light[i];
    corners[i] = {onGrid(u[i] * perDepth),
                  onGrid(v[i] * perDepth),
                  {reversed, byteOf(packed, 0) * reversed, byteOf(packed, 8) * reversed, byteOf(packed, 16) * reversed,
                   byteOf(packed, 24) * kSixteenths * reversed, lichen[i] * 15.0F * reversed}};
  }
}

Corner projected(const ClipVertex& vertex, float nearDepth) noexcept {
  const float reversed = nearDepth / vertex.depth;
  const std::array<float, 5>& shade = vertex.shade;
  return {onGrid(vertex.u / vertex.depth),
          onGrid(vertex.v / vertex.depth),
          {reversed, shade[0] * reversed, shade[1] * reversed, shade[2] * reversed, shade[3] * reversed,
           shade[4] * reversed}};
}

void drawTriangle(const Corner& a, const Corner& b, const Corner& c, Canvas& canvas) noexcept {
  const float abx = b.x - a.x;
  const float aby = b.y - a.y;
  const float acx = c.x - a.x;
  const float acy = c.y - a.y;
  const float twiceArea = abx * acy - acx * aby;
  // Counter-clockwise from outside, but the screen's y grows downwards.
  if (twiceArea >= 0.0F) return;
  const ScanConverter scan({a.x, a.y}, {b.x, b.y}, {c.x, c.y}, canvas.rect);
  if (scan.top() >= scan.bottom()) return;
  const float perArea = 1.0F / twiceArea;
  Planes alongX;
  Planes alongY;
  for (std::size_t k = 0; k < kPlanes; ++k) {
    const float ab = b.planes[k] - a.planes[k];
    const float ac = c.planes[k] - a.planes[k];
    alongX[k] = (ab * acy - ac * aby) * perArea;
    alongY[k] = (ac * abx - ab * acx) * perArea;
  }
  const float least = std::min({a.planes[0], b.planes[0], c.planes[0]});
  const float most = std::max({a.planes[0], b.planes[0], c.planes[0]});
  std::array<node::Span, kRowsAtOnce> spans;
  for (int first = scan.top(); first < scan.bottom(); first += kRowsAtOnce) {
    const int rows = std::min(kRowsAtOnce, scan.bottom() - first);
    scan.convert(first, std::span(spans).first(static_cast<std::size_t>(rows)));
    for (int i = 0; i < rows; ++i) {
      const node::Span span = spans[static_cast<std::size_t>(i)];
      if (span.begin >= span.end) continue;
      node::Span& drawn = canvas.spans[static_cast<std::size_t>(first + i - canvas.rect.top)];
      drawn.begin = std::min(drawn.begin, span.begin - canvas.rect.left);
      drawn.end = std::max(drawn.end, span.end - canvas.rect.left);
      const float down = static_cast<float>(first + i) + 0.5F - a.y;
      const std::ptrdiff_t start = (first + i - canvas.rect.top) * canvas.stride - canvas.rect.left;
      for (int x = span.begin; x < span.end; x += kLanes) {
        const float across = static_cast<float>(x) + 0.5F - a.x;
        Planes row;
        for (std::size_t k = 0; k < kPlanes; ++k) row[k] = a.planes[k] + alongX[k] * across + alongY[k] * down;
        fill(row, alongX, least, most, span.end - x, canvas.surface.data() + start + x,
             canvas.depth.data() + start + x);
      }
    }
  }
}

}  // namespace grove::objects::mesh
