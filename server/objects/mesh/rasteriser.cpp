#include "objects/mesh/rasteriser.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "objects/mesh/scan_converter.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;
using world::Vec4;

constexpr std::size_t kPlanes = 6;
constexpr float kSixteenths = 15.0F / 255.0F;

/// As in a Corner: x, y, then what is linear on the screen.
using Planes [[gnu::vector_size(sizeof(Corner))]] = float;

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

/// Some planes at kLanes columns.
using Row = std::array<Floats, kPlanes>;

/// One vector of pixels: what is nearer than the depth there replaces it, from the lane `begin` to before `end`.
inline void fill(const Row& row, Floats least, Floats most, int begin, int end, std::uint32_t* surface, float* depth) {
  // A sliver's planes are too steep for floats, so what they give is held within the triangle's range.
  const Floats reversed = clamped(row[0], least, most);
  const Floats scale = 1.0F / reversed;
  const auto shade = [&](std::size_t plane, float top) {
    return truncated(clamped(row[plane] * scale + 0.5F, 0.0F, top + 0.5F));
  };
  const Ints packed =
      shade(1, 255.0F) | shade(2, 255.0F) << 8 | shade(3, 255.0F) << 16 | shade(5, 15.0F) << 24 | shade(4, 15.0F) << 28;
  const auto before = load<Floats>(depth);
  const Ints shown = (kUpwards >= begin) & (kUpwards < end) & (reversed > before);
  store(shown ? packed : load<Ints>(surface), surface);
  store(shown ? reversed : before, depth);
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

int Canvas::widen(int top, int rows, const SpanRows& drawn) noexcept {
  int right = rect.left;
  for (int i = 0; i < rows; ++i) {
    if (drawn.begin[i] >= drawn.end[i]) continue;
    node::Span& span = spans[static_cast<std::size_t>(top + i - rect.top)];
    span.begin = std::min(span.begin, drawn.begin[i] - rect.left);
    span.end = std::max(span.end, drawn.end[i] - rect.left);
    right = std::max(right, drawn.end[i]);
  }
  return right;
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
  const auto atA = std::bit_cast<Planes>(a);
  const Planes ab = std::bit_cast<Planes>(b) - atA;
  const Planes ac = std::bit_cast<Planes>(c) - atA;
  const Planes alongX = (ab * acy - ac * aby) * perArea;
  const Planes alongY = (ac * abx - ab * acx) * perArea;
  const Floats least = std::min({a.planes[0], b.planes[0], c.planes[0]}) - Floats{};
  const Floats most = std::max({a.planes[0], b.planes[0], c.planes[0]}) - Floats{};
  const int left = std::max(canvas.rect.left, static_cast<int>(std::min({a.x, b.x, c.x})));
  SpanRows spans;
  for (int top = scan.top(); top < scan.bottom(); top += kLanes) {
    const int rows = std::min(kLanes, scan.bottom() - top);
    scan.convert(top, spans);
    const int right = canvas.widen(top, rows, spans);
    // Most triangles fit into one square of lanes.
    for (int x = left; x < right; x += kLanes) {
      const Planes corner =
          atA + alongX * (static_cast<float>(x) + 0.5F - a.x) + alongY * (static_cast<float>(top) + 0.5F - a.y);
      Row row;
      Row down;
      for (std::size_t k = 0; k < kPlanes; ++k) {
        row[k] = corner[k + 2] + alongX[k + 2] * toFloats(kUpwards);
        down[k] = alongY[k + 2] - Floats{};
      }
      const auto goDown = [&] {
        for (std::size_t k = 0; k < kPlanes; ++k) row[k] += down[k];
      };
      const std::ptrdiff_t start = (top - canvas.rect.top) * canvas.stride + x - canvas.rect.left;
      for (int i = 0; i < rows; ++i, goDown()) {
        const int begin = spans.begin[i] - x;
        const int end = spans.end[i] - x;
        if (begin >= std::min(end, kLanes) || end <= 0) continue;
        fill(row, least, most, begin, end, canvas.surface.data() + start + i * canvas.stride,
             canvas.depth.data() + start + i * canvas.stride);
      }
    }
  }
}

}  // namespace grove::objects::mesh
