#include "objects/mesh/detail.h"

#include <algorithm>
#include <array>

#include "objects/mesh/vertex_light.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;

constexpr std::size_t kLanes = 16;
constexpr std::size_t kBlock = 64;
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
    sun = glm::mat3(turn) * sunDirection * (kTexel[index] * kSlope[index]);
    up = glm::mat3(turn) * upDirection * (kTexel[index] * kSlope[index] * kSkyRelief);
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

/// A run of pixels, from and to.
struct Pixels {
  const std::uint32_t* surface;
  const float* nearOverDepth;
  std::uint32_t* colour;
  float* depth;
  std::size_t count;
};

/// Rounds the end of a row up to whole vectors: pixels one by one cost as much as vectors do, and most tiles are
/// narrow.
class Tail {
 public:
  [[nodiscard]] Pixels take(const Pixels& pixels) {
    std::copy_n(pixels.surface, pixels.count, surface_.data());
    std::copy_n(pixels.nearOverDepth, pixels.count, nearOverDepth_.data());
    const std::size_t rounded = (pixels.count + kLanes - 1) / kLanes * kLanes;
    std::fill(nearOverDepth_.data() + pixels.count, nearOverDepth_.data() + rounded, 0.0F);
    return {surface_.data(), nearOverDepth_.data(), colour_.data(), depth_.data(), rounded};
  }

  void give(std::uint32_t* colour, float* depth, std::size_t count) const {
    std::copy_n(colour_.data(), count, colour);
    std::copy_n(depth_.data(), count, depth);
  }

 private:
  std::array<std::uint32_t, kBlock> surface_{};
  std::array<float, kBlock> nearOverDepth_{};
  std::array<std::uint32_t, kBlock> colour_{};
  std::array<float, kBlock> depth_{};
};

/// Of a run: where its points are in the object's coordinates, and what the scales add up to.
struct Block {
  std::array<float, kBlock> x;
  std::array<float, kBlock> y;
  std::array<float, kBlock> z;
  std::array<float, kBlock> nearness;  ///< 1 / view depth
  std::array<float, kBlock> weight;    ///< of the scale at hand, for bytes
  std::array<float, kBlock> stain;
  std::array<float, kBlock> sun;  ///< slope away from the sun
  std::array<float, kBlock> up;
};

/// A row of pixels in the object's coordinates: the point is origin + depth * (ray + x * step).
struct Line {
  Vec3 origin;
  Vec3 ray;
  Vec3 step;
};

void locate(const Pixels& pixels, const Line& line, std::size_t first, float nearDepth, Block& block) {
  const float* __restrict nearOverDepth = pixels.nearOverDepth;
  const std::size_t count = pixels.count;
  const Vec3 origin = line.origin;
  const Vec3 ray = line.ray;
  const Vec3 step = line.step;
  const float perNear = 1.0F / nearDepth;
  for (std::size_t i = 0; i < count; ++i) {
    // Empty pixels are taken for near ones, lest they be looked up beyond all numbers.
    const float reversed = nearOverDepth[i];
    const float metres = nearDepth / (reversed > 0.0F ? reversed : 1.0F);
    const auto column = static_cast<float>(first + i);
    block.x[i] = origin.x + metres * (ray.x + column * step.x);
    block.y[i] = origin.y + metres * (ray.y + column * step.y);
    block.z[i] = origin.z + metres * (ray.z + column * step.z);
    block.nearness[i] = reversed * perNear;
    block.stain[i] = 0.0F;
    block.sun[i] = 0.0F;
    block.up[i] = 0.0F;
  }
}

/// True if any pixel shows the scale. Apart from its use, for where no pixel does it need not be looked up.
bool weigh(const Scale& scale, std::size_t count, Block& block) {
  const float pixels = scale.pixels;
  float most = 0.0F;
  for (std::size_t i = 0; i < count; ++i) {
    const float seen = std::min(std::max(pixels * block.nearness[i] - kLeastPixels, 0.0F), 1.0F);
    block.weight[i] = seen * (1.0F / 255.0F);
    most = std::max(most, seen);
  }
  return most > 0.0F;
}

/// Adds one scale: trilinear lookups, with the gradient.
void addScale(const std::uint32_t* __restrict texture, const Scale& scale, std::size_t count, Block& block) {
  constexpr std::int32_t kWrap = DetailTexture::kSize - 1;
  constexpr std::int32_t kSlice = DetailTexture::kSize * DetailTexture::kSize;
  // Far from zero, so that cutting off the fraction rounds down.
  constexpr float kFar = 8192.0F;
  const Vec3 row0 = scale.row0;
  const Vec3 row1 = scale.row1;
  const Vec3 row2 = scale.row2;
  const Vec3 sun = scale.sun;
  const Vec3 up = scale.up;
  const float stain = scale.stain;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = block.x[i];
    const float y = block.y[i];
    const float z = block.z[i];
    const float u = row0.x * x + row0.y * y + row0.z * z + kFar;
    const float v = row1.x * x + row1.y * y + row1.z * z + kFar;
    const float w = row2.x * x + row2.y * y + row2.z * z + kFar;
    const auto iu = static_cast<std::int32_t>(u);
    const auto iv = static_cast<std::int32_t>(v);
    const auto iw = static_cast<std::int32_t>(w);
    const float fu = u - static_cast<float>(iu);
    const float fv = v - static_cast<float>(iv);
    const float fw = w - static_cast<float>(iw);
    const std::int32_t at = (iw & kWrap) * kSlice + (iv & kWrap) * (kWrap + 1) + (iu & kWrap);
    const std::uint32_t front = texture[at];
    const std::uint32_t back = texture[at + kSlice];
    const float c00 = byteOf(front, 0);
    const float c10 = byteOf(front, 8);
    const float c01 = byteOf(front, 16);
    const float c11 = byteOf(front, 24);
    const float w00 = byteOf(back, 0) - c00;
    const float w10 = byteOf(back, 8) - c10;
    const float w01 = byteOf(back, 16) - c01;
    const float w11 = byteOf(back, 24) - c11;
    const float h00 = c00 + fw * w00;
    const float h01 = c01 + fw * w01;
    const float u0 = c10 + fw * w10 - h00;
    const float u1 = c11 + fw * w11 - h01;
    const float low = h00 + fu * u0;
    const float slopeU = u0 + fv * (u1 - u0);
    const float slopeV = h01 + fu * u1 - low;
    const float lowW = w00 + fu * (w10 - w00);
    const float slopeW = lowW + fv * (w01 + fu * (w11 - w01) - lowW);
    const float weight = block.weight[i];
    block.stain[i] += (low + fv * slopeV - 127.5F) * (stain * weight);
    block.sun[i] -= (slopeU * sun.x + slopeV * sun.y + slopeW * sun.z) * weight;
    block.up[i] -= (slopeU * up.x + slopeV * up.y + slopeW * up.z) * weight;
  }
}

/// Brightens a display-encoded channel by a factor exp(change) of its light: the display curve is steepest in its
/// middle.
inline std::uint32_t graded(float channel, float change) {
  const float value = channel + channel * (285.0F - channel) * (0.55F / 285.0F) * change;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::min(std::max(value, 0.0F), 255.0F) + 0.5F));
}

void weather(const Pixels& pixels, float nearDepth, const Block& block) {
  const std::uint32_t* __restrict surface = pixels.surface;
  const float* __restrict nearOverDepth = pixels.nearOverDepth;
  std::uint32_t* __restrict colour = pixels.colour;
  float* __restrict depth = pixels.depth;
  const std::size_t count = pixels.count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t packed = surface[i];
    const float relief = static_cast<float>(static_cast<std::int32_t>(packed >> 28U)) * (kMostRelief / 15.0F);
    const float lichen = static_cast<float>(static_cast<std::int32_t>((packed >> 24U) & 0xFU)) * (1.0F / 15.0F);
    const float stain = block.stain[i];
    const float change = std::min(std::max(stain + relief * block.sun[i] + block.up[i], -0.9F), 0.8F);
    const float overgrown = std::min(std::max((lichen + 1.1F * stain - 0.42F) * 6.0F, 0.0F), 1.0F);
    const float warm = 0.22F * stain;
    const std::uint32_t red = graded(byteOf(packed, 0), change + overgrown * 0.26F + warm);
    const std::uint32_t green = graded(byteOf(packed, 8), change + overgrown * 0.34F);
    const std::uint32_t blue = graded(byteOf(packed, 16), change + overgrown * 0.06F - warm);
    const float reversed = nearOverDepth[i];
    const bool covered = reversed > 0.0F;
    colour[i] = covered ? red | green << 8U | blue << 16U | 0xFF000000U : 0U;
    depth[i] = covered ? nearDepth / reversed : world::kInfiniteDepth;
  }
}

/// Where there is nothing to add.
void pass(const Pixels& pixels, float nearDepth) {
  const std::uint32_t* __restrict surface = pixels.surface;
  const float* __restrict nearOverDepth = pixels.nearOverDepth;
  std::uint32_t* __restrict colour = pixels.colour;
  float* __restrict depth = pixels.depth;
  const std::size_t count = pixels.count;
  for (std::size_t i = 0; i < count; ++i) {
    const float reversed = nearOverDepth[i];
    const bool covered = reversed > 0.0F;
    colour[i] = covered ? surface[i] | 0xFF000000U : 0U;
    depth[i] = covered ? nearDepth / reversed : world::kInfiniteDepth;
  }
}

bool anyCovered(const Pixels& pixels) {
  const float* nearOverDepth = pixels.nearOverDepth;
  float most = 0.0F;
  for (std::size_t i = 0; i < pixels.count; ++i) most = std::max(most, nearOverDepth[i]);
  return most > 0.0F;
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
  const auto width = static_cast<std::size_t>(image.width());
  Block block;
  Tail tail;
  for (int row = 0; row < image.height(); ++row) {
    const Line line{origin, corner + downwards * static_cast<float>(row), alongRow};
    for (std::size_t first = 0; first < width; first += kBlock) {
      const std::size_t count = std::min(kBlock, width - first);
      const std::ptrdiff_t at = row * fragments.stride + static_cast<std::ptrdiff_t>(first);
      Pixels pixels{fragments.surface + at, fragments.depth + at, image.colourRow(row) + first,
                    image.depthRow(row) + first, count};
      const bool whole = count % kLanes == 0;
      if (!whole) pixels = tail.take(pixels);
      if (weathered && anyCovered(pixels)) {
        locate(pixels, line, first, camera.nearDepth, block);
        for (const Scale& scale : scales) {
          if (weigh(scale, pixels.count, block)) addScale(texture.squares(), scale, pixels.count, block);
        }
        weather(pixels, camera.nearDepth, block);
      } else {
        pass(pixels, camera.nearDepth);
      }
      if (!whole) tail.give(image.colourRow(row) + first, image.depthRow(row) + first, count);
    }
  }
}

}  // namespace grove::objects::mesh
