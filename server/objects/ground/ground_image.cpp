#include "objects/ground/ground_image.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace grove::objects::ground {
namespace {

constexpr float kFarthest = 140.0F;  // metres; there the forest of the sky's panorama begins
constexpr std::size_t kMostLights = 8;

Frame frameOf(const world::Camera& camera) {
  const float sine = std::sin(camera.pose.pitch);
  const float cosine = std::cos(camera.pose.pitch);
  const float vStep = -2.0F * camera.tanHalfY() / static_cast<float>(camera.height);
  const float v0 = camera.tanHalfY() + 0.5F * vStep;
  const float yaw = camera.pose.yaw;
  Frame frame;
  frame.eyeX = camera.pose.position.x;
  frame.eyeY = camera.pose.position.y;
  frame.eyeZ = camera.pose.position.z;
  frame.forwardX = -std::sin(yaw);
  frame.forwardZ = -std::cos(yaw);
  frame.sideX = std::cos(yaw);
  frame.sideZ = -std::sin(yaw);
  frame.sideStep = 2.0F * camera.tanHalfX() / static_cast<float>(camera.width);
  frame.firstSide = 0.5F * frame.sideStep - camera.tanHalfX();
  frame.firstInverse = -(sine + v0 * cosine) / frame.eyeY;
  frame.inverseStep = -vStep * cosine / frame.eyeY;
  frame.firstAhead = cosine - v0 * sine;
  frame.aheadStep = -vStep * sine;
  frame.focal = camera.focal();
  return frame;
}

/// How far apart neighbouring pixels of a row are on the ground, in metres.
struct Footprint {
  float across = 0.0F;
  float along = 0.0F;
};

Footprint footprintOf(const Frame& frame, const Row& row) {
  const float flat = std::max(0.05F, std::fabs(row.ahead));
  return {row.depth * frame.sideStep, row.depth * row.depth * frame.inverseStep * flat};
}

int levelFor(float texels, const Pyramid& pyramid) {
  return std::clamp(static_cast<int>(std::floor(std::log2(std::max(texels, 1.0F)) + 0.5F)), 0, pyramid.levels() - 2);
}

/// More taps where the ground is seen at a flatter angle; then the level that leaves neither holes nor mush.
MeadowSampling samplingFor(const Footprint& footprint, const Meadow& meadow) {
  const float texel = meadow.metres / static_cast<float>(meadow.pyramid.size());
  MeadowSampling sampling;
  sampling.taps = footprint.along < 2.0F * texel ? 1 : footprint.along < 8.0F * footprint.across ? 2 : 4;
  const float even = std::sqrt(footprint.across * footprint.along);
  const float size = std::max(footprint.across, std::min(even, footprint.along / static_cast<float>(sampling.taps)));
  const float lod = std::clamp(std::log2(size / texel), 0.0F, static_cast<float>(meadow.pyramid.levels() - 2));
  sampling.level = static_cast<int>(lod);
  sampling.coarser = lod - std::floor(lod);
  return sampling;
}

/// Rows nearer to the eye whose grass can reach up to this row.
int reachOf(const Frame& frame, int row) {
  int reach = 0;
  while (reach + 1 < kRootRows - 1) {
    const Row nearer = rowAt(frame, row + reach + 1);
    if (nearer.pixelsPerMetre * kTallest + 0.5F < static_cast<float>(reach + 1)) break;
    ++reach;
  }
  return reach;
}

std::vector<world::PointLight> nearestLights(std::span<const world::PointLight> lights, world::Vec3 eye) {
  std::vector<world::PointLight> nearest(lights.begin(), lights.end());
  const auto distance = [&](const world::PointLight& light) { return glm::distance(light.position, eye); };
  if (nearest.size() > kMostLights) {
    std::ranges::nth_element(nearest, nearest.begin() + kMostLights, {}, distance);
    nearest.resize(kMostLights);
  }
  return nearest;
}

/// Works on one tile from its nearest row up, because a row looks for its grass in the rows below.
class TilePainter {
 public:
  TilePainter(const GroundMaps& maps, const Frame& frame, std::span<const world::PointLight> lights, node::Image& image)
      : maps_(maps), frame_(frame), lights_(lights), image_(image) {}

  void paint(int firstColumn) {
    const world::Rect rect = image_.rect;
    const int lowest = rect.bottom - 1 + reachOf(frame_, rect.bottom - 1);
    const int left = std::max(firstColumn, rect.left);
    const int right = std::min(firstColumn + kTile, rect.right);
    for (int y = lowest; y >= rect.top; --y) {
      const Row row = rowAt(frame_, y);
      const Footprint footprint = footprintOf(frame_, row);
      const float texel = maps_.clearing.metres / static_cast<float>(maps_.clearing.pyramid.size());
      const float even = std::sqrt(footprint.across * kCoarse * footprint.along);
      sampleClearing(frame_, row, firstColumn, maps_.clearing, levelFor(even / texel, maps_.clearing.pyramid),
                     maps_.daylight, lights_, coarse_);
      refine(coarse_, fine_);
      const MeadowSampling sampling = samplingFor(footprint, maps_.meadow);
      growGrass(frame_, row, firstColumn, maps_.meadow, sampling, fine_, grass_);
      if (y >= rect.bottom) continue;
      findRoots(y, reachOf(frame_, y), grass_);
      shadeRow(frame_, row, firstColumn, maps_.meadow, sampling, fine_, grass_, maps_.tone, colour_.data(),
               depth_.data());
      std::copy(colour_.begin() + (left - firstColumn), colour_.begin() + (right - firstColumn),
                image_.colourRow(y - rect.top) + (left - rect.left));
      std::copy(depth_.begin() + (left - firstColumn), depth_.begin() + (right - firstColumn),
                image_.depthRow(y - rect.top) + (left - rect.left));
    }
  }

 private:
  const GroundMaps& maps_;
  const Frame& frame_;
  std::span<const world::PointLight> lights_;
  node::Image& image_;
  CoarseRow coarse_;
  FineRow fine_;
  GrassRows grass_;
  alignas(64) std::array<std::uint32_t, kTile> colour_;
  alignas(64) std::array<float, kTile> depth_;
};

}  // namespace

std::shared_ptr<const node::Image> groundImage(const GroundMaps& maps, const world::Camera& camera, world::Rect rect,
                                               std::span<const world::PointLight> lights, node::ImagePool& images) {
  if (camera.pose.position.y <= 0.0F) return nullptr;
  const Frame frame = frameOf(camera);
  const auto inverse = [&](int row) { return frame.firstInverse + static_cast<float>(row) * frame.inverseStep; };
  while (!rect.empty() && inverse(rect.top) < 1.0F / kFarthest) ++rect.top;
  if (rect.empty()) return nullptr;

  const auto image = images.acquire(rect);
  const std::vector<world::PointLight> nearest = nearestLights(lights, camera.pose.position);
  TilePainter painter(maps, frame, nearest, *image);
  for (int column = rect.left / kTile * kTile; column < rect.right; column += kTile) painter.paint(column);
  return image;
}

}  // namespace grove::objects::ground
