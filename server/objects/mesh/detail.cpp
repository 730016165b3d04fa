#include "objects/mesh/detail.h"

#include <algorithm>
#include <array>
#include <span>

#include "objects/mesh/lanes.h"
#include "objects/mesh/vertex_light.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;

static_assert(kFragmentRoom == kLanes);
constexpr std::size_t kScales = 3;
/// Metres of a texel, coarse to fine.
constexpr std::array<float, kScales> kTexel = {0.034F, 0.0071F, 0.0016F};
/// How much a full height changes the logarithm of the brightness, by stain and by a unit of slope.
constexpr std::array<float, kScales> kStain = {0.40F, 0.55F, 0.50F};
constexpr std::array<float, kScales> kSlope = {1.05F, 1.10F, 0.90F};
/// Light of the open sky brings out relief from above wherever the sun does not.
constexpr float kSkyRelief = 0.50F;
/// Smaller features are left out.
constexpr float kLeastPixels = 0.9F;

inline float byteOf(std::uint32_t packed, unsigned shift) {
  return static_cast<float>(static_cast<std::int32_t>((packed >> shift) & 0xFFU));
}

/// Where a scale is looked up: turned out of the axes, where value noise would show its cells, and in texels.
glm::mat3 turnOf(std::size_t scale) {
  const glm::mat3 turn(0.36F, 0.48F, -0.80F, -0.80F, 0.60F, 0.00F, 0.48F, 0.64F, 0.60F);
  return (scale == 1 ? glm::transpose(turn) : turn) / kTexel[scale];
}

/// One scale as the loop wants it: plain floats.
struct Scale {
  Scale(std::size_t index, float focal, Vec3 sunDirection, Vec3 upDirection) {
    const glm::mat3 turn = turnOf(index);
    row0 = Vec3(turn[0].x, turn[1].x, turn[2].x);
    row1 = Vec3(turn[0].y, turn[1].y, turn[2].y);
    row2 = Vec3(turn[0].z, turn[1].z, turn[2].z);
    sun = glm::mat3(turn) * sunDirection * (kTexel[index] * kSlope[index] / 255.0F);
    up = glm::mat3(turn) * upDirection * (kTexel[index] * kSlope[index] * kSkyRelief / 255.0F);
    stain = kStain[index];
    pixels = 1.8F * kTexel[index] * focal;
  }
  Vec3 row0;
  Vec3 row1;
  Vec3 row2;
  Vec3 sun;
  Vec3 up;
  float stain;
  float pixels;  ///< that the smallest features have at one metre
};

/// Brightens a display-encoded channel by a factor exp(change) of its light: the display curve is steepest in its
/// middle.
inline std::uint32_t graded(float channel, float change) {
  const float value = channel + channel * (285.0F - channel) * (0.55F / 285.0F) * change;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::min(std::max(value, 0.0F), 255.0F) + 0.5F));
}

/// A row of pixels in the object's coordinates: the point is origin + depth * (ray + x * step).
struct Line {
  Vec3 origin;
  Vec3 ray;
  Vec3 step;
};

/// Weathers the pixels of many rows together, for what is before the camera is narrow and vectors are wide.
class Weathering {
 public:
  Weathering(const DetailTexture& texture, const std::array<Scale, kScales>& scales, float nearDepth,
             node::Image& image)
      : texture_(texture), scales_(scales), nearDepth_(nearDepth), image_(image) {}

  /// `surface` and `reversed` begin at the row's first column.
  void addRow(int row, node::Span span, const std::uint32_t* surface, const float* reversed, const Line& line) {
    while (span.begin < span.end) {
      if (count_ == kBlock || pieces_ == kPieces) flush();
      const auto count = std::min(static_cast<std::size_t>(span.end - span.begin), kBlock - count_);
      take(surface + span.begin, reversed + span.begin, count, line, span.begin);
      piece_[pieces_++] = {row, span.begin, count};
      count_ += count;
      span.begin += static_cast<int>(count);
    }
  }

  /// Writes what has been added since the last.
  void flush();

 private:
  /// Pixels of one row that lie side by side in the block.
  struct Piece {
    int row;
    int column;
    std::size_t count;
  };
  static constexpr std::size_t kBlock = 256;
  static constexpr std::size_t kPieces = 32;
  static constexpr std::size_t kRoom = kBlock + kFragmentRoom;  // whole vectors are written wherever they begin

  static std::size_t roundedUp(std::size_t count) {
    return (count + kFragmentRoom - 1) / kFragmentRoom * kFragmentRoom;
  }
  void take(const std::uint32_t* surface, const float* reversed, std::size_t count, const Line& line, int column);
  void addScale(const Scale& scale, std::size_t count);
  void weather(std::size_t count);

  const DetailTexture& texture_;
  const std::array<Scale, kScales>& scales_;
  const float nearDepth_;
  node::Image& image_;
  std::array<Piece, kPieces> piece_;
  std::size_t pieces_ = 0;
  std::size_t count_ = 0;
  alignas(64) std::array<std::uint32_t, kRoom> surface_{};
  alignas(64) std::array<float, kRoom> reversed_{};
  // In the object's coordinates.
  alignas(64) std::array<float, kRoom> x_{};
  alignas(64) std::array<float, kRoom> y_{};
  alignas(64) std::array<float, kRoom> z_{};
  // What the scales add up to: the height, and how much the slope brightens.
  alignas(64) std::array<float, kRoom> relief_{};  // how much the sun brings out slopes
  alignas(64) std::array<float, kRoom> stain_{};
  alignas(64) std::array<float, kRoom> slope_{};
  alignas(64) std::array<float, kRoom> depth_{};
};

/// Adds pixels to the block, in whole vectors: what is too much is overwritten by the next.
void Weathering::take(const std::uint32_t* __restrict surface, const float* __restrict reversed, std::size_t count,
                      const Line& line, int column) {
  std::uint32_t* __restrict surfaceTo = surface_.data() + count_;
  float* __restrict reversedTo = reversed_.data() + count_;
  float* __restrict x = x_.data() + count_;
  float* __restrict y = y_.data() + count_;
  float* __restrict z = z_.data() + count_;
  const Vec3 origin = line.origin;
  const Vec3 step = line.step;
  const Vec3 ray = line.ray + step * static_cast<float>(column);
  const float nearDepth = nearDepth_;
  const std::size_t rounded = roundedUp(count);
  for (std::size_t i = 0; i < rounded; ++i) {
    surfaceTo[i] = surface[i];
    reversedTo[i] = reversed[i];
    // Empty pixels are taken for near ones, lest they be looked up beyond all numbers.
    const float metres = nearDepth / (reversed[i] > 0.0F ? reversed[i] : 1.0F);
    const auto along = static_cast<float>(static_cast<std::int32_t>(i));
    x[i] = origin.x + metres * (ray.x + along * step.x);
    y[i] = origin.y + metres * (ray.y + along * step.y);
    z[i] = origin.z + metres * (ray.z + along * step.z);
  }
}

/// Adds one scale: trilinear lookups, with the gradient.
void Weathering::addScale(const Scale& scale, std::size_t count) {
  constexpr std::int32_t kWrap = DetailTexture::kSize - 1;
  // Far from zero, so that cutting off the fraction rounds down.
  constexpr float kFar = 8192.0F;
  const std::uint32_t* texture = texture_.squares();
  const Vec3 row0 = scale.row0;
  const Vec3 row1 = scale.row1;
  const Vec3 row2 = scale.row2;
  const Vec3 sun = scale.sun;
  const Vec3 up = scale.up;
  const float stain = scale.stain / 255.0F;
  const float pixels = scale.pixels / nearDepth_;
  for (std::size_t i = 0; i < count; i += kLanes) {
    const auto x = load<Floats>(&x_[i]);
    const auto y = load<Floats>(&y_[i]);
    const auto z = load<Floats>(&z_[i]);
    const Floats u = row0.x * x + row0.y * y + row0.z * z + kFar;
    const Floats v = row1.x * x + row1.y * y + row1.z * z + kFar;
    const Floats w = row2.x * x + row2.y * y + row2.z * z + kFar;
    const Ints iu = truncated(u);
    const Ints iv = truncated(v);
    const Ints iw = truncated(w);
    const Floats fu = u - toFloats(iu);
    const Floats fv = v - toFloats(iv);
    const Floats fw = w - toFloats(iw);
    constexpr auto kLine = static_cast<std::int32_t>(DetailTexture::kLine);
    const Ints line = (iv & kWrap) * static_cast<std::int32_t>(DetailTexture::kSize) + (iu & kWrap);
    const auto [front, back] = lookUpPair(texture, line * kLine + (iw & kWrap));
    const Floats c00 = toFloats(front & 0xFF);
    const Floats c10 = toFloats(front >> 8 & 0xFF);
    const Floats c01 = toFloats(front >> 16 & 0xFF);
    const Floats c11 = toFloats(front >> 24 & 0xFF);
    const Floats w00 = toFloats(back & 0xFF) - c00;
    const Floats w10 = toFloats(back >> 8 & 0xFF) - c10;
    const Floats w01 = toFloats(back >> 16 & 0xFF) - c01;
    const Floats w11 = toFloats(back >> 24 & 0xFF) - c11;
    const Floats h00 = c00 + fw * w00;
    const Floats h01 = c01 + fw * w01;
    const Floats u0 = c10 + fw * w10 - h00;
    const Floats u1 = c11 + fw * w11 - h01;
    const Floats low = h00 + fu * u0;
    const Floats slopeU = u0 + fv * (u1 - u0);
    const Floats slopeV = h01 + fu * u1 - low;
    const Floats lowW = w00 + fu * (w10 - w00);
    const Floats slopeW = lowW + fv * (w01 + fu * (w11 - w01) - lowW);
    const Floats weight = clamped(pixels * load<Floats>(&reversed_[i]) - kLeastPixels, 0.0F, 1.0F);
    const auto relief = load<Floats>(&relief_[i]);
    const Floats slope =
        slopeU * (relief * sun.x + up.x) + slopeV * (relief * sun.y + up.y) + slopeW * (relief * sun.z + up.z);
    store(load<Floats>(&stain_[i]) + (low + fv * slopeV - 127.5F) * (stain * weight), &stain_[i]);
    store(load<Floats>(&slope_[i]) - slope * weight, &slope_[i]);
  }
}

/// Turns surface into colour and fills in the depth.
void Weathering::weather(std::size_t count) {
  const float nearDepth = nearDepth_;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t packed = surface_[i];
    const float lichen = static_cast<float>(static_cast<std::int32_t>((packed >> 24U) & 0xFU)) * (1.0F / 15.0F);
    const float stain = stain_[i];
    const float change = std::min(std::max(stain + slope_[i], -0.9F), 0.8F);
    const float overgrown = std::min(std::max((lichen + 1.1F * stain - 0.42F) * 6.0F, 0.0F), 1.0F);
    const float warm = 0.22F * stain;
    const std::uint32_t red = graded(byteOf(packed, 0), change + overgrown * 0.26F + warm);
    const std::uint32_t green = graded(byteOf(packed, 8), change + overgrown * 0.34F);
    const std::uint32_t blue = graded(byteOf(packed, 16), change + overgrown * 0.06F - warm);
    const float reversed = reversed_[i];
    const bool covered = reversed > 0.0F;
    surface_[i] = covered ? red | green << 8U | blue << 16U | 0xFF000000U : 0U;
    depth_[i] = covered ? nearDepth / reversed : world::kInfiniteDepth;
  }
}

void Weathering::flush() {
  const std::size_t count = roundedUp(count_);
  float nearest = 0.0F;
  for (std::size_t i = 0; i < count; ++i) {
    nearest = std::max(nearest, reversed_[i]);
    relief_[i] = static_cast<float>(static_cast<std::int32_t>(surface_[i] >> 28U)) * (kMostRelief / 15.0F);
    stain_[i] = 0.0F;
    slope_[i] = 0.0F;
  }
  for (const Scale& scale : scales_) {
    if (scale.pixels * nearest > kLeastPixels * nearDepth_) addScale(scale, count);
  }
  weather(count);
  std::size_t at = 0;
  for (const Piece& piece : std::span(piece_).first(pieces_)) {
    std::copy_n(surface_.data() + at, piece.count, image_.colourRow(piece.row) + piece.column);
    std::copy_n(depth_.data() + at, piece.count, image_.depthRow(piece.row) + piece.column);
    at += piece.count;
  }
  count_ = 0;
  pieces_ = 0;
}

/// A row with nothing to add.
void pass(const std::uint32_t* __restrict surface, const float* __restrict reversed, float nearDepth,
          std::uint32_t* __restrict colour, float* __restrict depth, int count) {
  for (int i = 0; i < count; ++i) {
    const bool covered = reversed[i] > 0.0F;
    colour[i] = covered ? surface[i] | 0xFF000000U : 0U;
    depth[i] = covered ? nearDepth / reversed[i] : world::kInfiniteDepth;
  }
}

}  // namespace

void finish(const Fragments& fragments, const Drawing& drawing, const DetailTexture& texture, node::Image& image) {
  const world::Camera& camera = *drawing.camera;
  const bool weathered = drawing.object->surface.weathered;
  const world::Mat4 toObject = glm::inverse(drawing.bones[0]);
  const glm::mat3 turn(toObject);
  const float metre = glm::length(Vec3(drawing.bones[0][0]));
  const float focal = camera.focal() * metre;
  const Vec3 sun = turn * world::sunDirection() * metre;
  const Vec3 up = turn * Vec3(0, 1, 0) * metre;
  const std::array<Scale, kScales> scales = {Scale(0, focal, sun, up), Scale(1, focal, sun, up),
                                             Scale(2, focal, sun, up)};
  const Vec3 origin(toObject * world::Vec4(camera.pose.position, 1.0F));
  const auto rayAt = [&](int column, int row) {
    return turn * camera.ray(static_cast<float>(drawing.rect.left + column) + 0.5F,
                             static_cast<float>(drawing.rect.top + row) + 0.5F);
  };
  const Vec3 corner = rayAt(0, 0);
  const Vec3 alongRow = rayAt(1, 0) - corner;
  const Vec3 downwards = rayAt(0, 1) - corner;
  image.spans.assign(fragments.spans.begin(), fragments.spans.end());
  Weathering weathering(texture, scales, camera.nearDepth, image);
  for (int row = 0; row < image.height(); ++row) {
    const node::Span span = image.span(row);
    const std::uint32_t* surface = fragments.surface + row * fragments.stride;
    const float* reversed = fragments.depth + row * fragments.stride;
    if (weathered) {
      weathering.addRow(row, span, surface, reversed, {origin, corner + downwards * static_cast<float>(row), alongRow});
    } else {
      pass(surface + span.begin, reversed + span.begin, camera.nearDepth, image.colourRow(row) + span.begin,
           image.depthRow(row) + span.begin, span.end - span.begin);
    }
  }
  weathering.flush();
}

}  // namespace grove::objects::mesh
