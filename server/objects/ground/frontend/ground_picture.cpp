#include "objects/ground/frontend/ground_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/floor_to.h"
#include "objects/ground/frontend/grow_kernels.h"
#include "objects/ground/frontend/relief/relief_kernels.h"
#include "objects/ground/frontend/root_kernels.h"
#include "objects/ground/frontend/shade_kernels.h"
#include "raster/soften_kernels.h"
#include "world/strongest_lights.h"

namespace grove::objects::ground {
namespace {

constexpr std::size_t kMaxLights = 8;
constexpr int kMaxRowStep = 4;  // rows between samples of light and soil
constexpr raster::Softening kSoftening = raster::Softening::kHalf;

int levelFor(float texels, const Pyramid& pyramid) {
  return std::clamp(static_cast<int>(std::floor(std::log2(std::max(texels, 1.0F)) + 0.5F)), 0, pyramid.levels() - 2);
}

/// Rows between samples of light and soil; fewer where the ground is seen at a flat angle.
int rowStep(const Frame& frame, int row) {
  const float along = rowAt(frame, row & ~(kMaxRowStep - 1)).along;
  return along < 0.10F ? kMaxRowStep : along < 0.6F ? 2 : 1;
}

/// Number of nearer rows whose grass can reach up to this row, where a metre has `scaleAt(row)` pixels. The search
/// starts at the neighbour row's reach, which is similar.
template <typename ScaleAt>
int reachOf(const ScaleAt& scaleAt, float tallest, int row, int ofNeighbour) {
  const auto reaches = [&](int rows) { return scaleAt(row + rows) * tallest + 0.5F >= static_cast<float>(rows); };
  int reach = ofNeighbour;
  while (reach > 0 && !reaches(reach)) --reach;
  while (reach + 1 < kRootRows - 1 && reaches(reach + 1)) ++reach;
  return reach;
}

/// The nearest row whose grass can reach up to this row. Before the eye, the ground may be higher than below it.
int lowestRow(world::Camera camera, float ground, float tallest, int row) {
  constexpr float kRise = 0.3F;
  constexpr float kMinHeight = 0.2F;
  if (ground > 0.0F) camera.pose.position.y = std::max(camera.pose.position.y - ground - kRise, kMinHeight);
  const Frame frame = frameOf(camera);
  const auto scaleAt = [&](int each) { return rowAt(frame, each).pixelsPerMetre; };
  return row + reachOf(scaleAt, tallest, row, 0);
}

/// Lights with their heights above the ground.
std::vector<world::PointLight> aboveGround(std::vector<world::PointLight> lights, std::span<const world::Hill> hills) {
  for (world::PointLight& light : lights) {
    light.position.y -= world::groundHeight(hills, {light.position.x, light.position.z});
  }
  return lights;
}

std::vector<world::PointLight> nearestLights(std::span<const world::PointLight> lights, world::Vec3 eye) {
  if (lights.size() <= kMaxLights) return {lights.begin(), lights.end()};
  const auto nearness = [&](const world::PointLight& light) { return -glm::distance(light.position, eye); };
  return world::strongestLights(lights, kMaxLights, -world::kInfiniteDepth, nearness);
}

}  // namespace

/// Works on one strip from its nearest row up, because a row searches for its grass in the rows below. Softens colours
/// against aliasing, because a pixel shows one texel of the meadow: so a row is complete when the row above it is
/// shaded.
class GroundPicture::StripPainter {
 public:
  StripPainter(const GroundPicture& picture, raster::Image& image, int firstColumn)
      : maps_(picture.maps_),
        light_(picture.light_),
        frame_(picture.frame_),
        lights_(picture.lights_),
        image_(image),
        lowest_(picture.lowest_),
        firstColumn_(firstColumn),
        hills_(hillsBefore(frame_, firstColumn, picture.first_, lowest_, maps_.hills)),
        left_(std::max(firstColumn, image.rect.left)),
        right_(std::min(firstColumn + kTile, image.rect.right)),
        searched_(lowest_ + 1) {}

  /// `first`: the farthest row.
  void paint(int first) {
    near_ = sampled_.data();
    far_ = near_ + 1;
    int reach = 0;
    for (int y = lowest_; y >= first; --y) {
      const GroundRow& ground = groundAt(y);
      const Row row = meanOf(frame_, ground);
      scales_[slotOf(y)] = row.pixelsPerMetre;
      const auto scaleAt = [&](int each) { return each > lowest_ ? 0.0F : scales_[slotOf(each)]; };
      reach = reachOf(scaleAt, maps_.meadow.tallest, y, reach);
      const SoilBetween soil = soilAt(y);
      growGrass(frame_, ground, maps_.meadow, samplingFor(row, maps_.meadow), soil, grass_);
      if (y > image_.rect.bottom) continue;
      findRoots(row, reach, soil, grass_);
      shade(y, soil);
      if (y + 1 < image_.rect.bottom) finish(y + 1, y);
    }
    // Nothing is above the horizon.
    if (first == image_.rect.top) finish(first, first);
  }

 private:
  static constexpr int kNoRow = std::numeric_limits<int>::min();
  struct SoilRow {
    int row = kNoRow;
    FineSoil soil;
  };

  static std::size_t slotOf(int row) { return static_cast<unsigned>(row) % kRootRows; }

  /// Searches the rows up to this one, nearest first. Keeps the newest rows.
  const GroundRow& groundAt(int row) {
    const auto kept = [&](int each) -> GroundRow& { return grounds_[static_cast<unsigned>(each) % grounds_.size()]; };
    for (; searched_ > row; --searched_) {
      const GroundRow* const nearer = searched_ > lowest_ ? nullptr : &kept(searched_);
      findGround(frame_, hills_, searched_ - 1, firstColumn_, nearer, kept(searched_ - 1));
    }
    return kept(row);
  }

  void sample(int row, SoilRow& out) {
    const GroundRow& ground = groundAt(row);
    const Row at = meanOf(frame_, ground);
    const float texel = maps_.clearing.metres / static_cast<float>(maps_.clearing.pyramid.size());
    const float area = at.across * kCoarse * at.along * static_cast<float>(rowStep(frame_, row));
    sampleSoil(frame_, ground, firstColumn_, maps_.clearing, levelFor(std::sqrt(area) / texel, maps_.clearing.pyramid),
               light_, lights_, samples_);
    spreadSoil(samples_, out.soil);
    out.row = row;
  }

  /// Interpolates between the two sampled rows around `row`.
  SoilBetween soilAt(int row) {
    const int step = rowStep(frame_, row);
    const int top = row & ~(step - 1);
    if (far_->row != top) {
      if (far_->row == top + step) {
        std::swap(near_, far_);
      } else if (row != top) {
        sample(top + step, *near_);
      }
      sample(top, *far_);
      if (row != top) stepSoil(far_->soil, near_->soil, step, step_);
    }
    return {far_->soil, step_, row - top};
  }

  using Colours = std::array<std::uint32_t, kTile>;

  /// A row softened across, of the newest ones.
  Colours& shaded(int row) { return shaded_[static_cast<unsigned>(row) % shaded_.size()]; }

  void shade(int row, const SoilBetween& soil) {
    shadeRow(row, soil, grass_, colour_.data(), depth_.data());
    raster::softenAcross(colour_.data(), kTile, kSoftening, shaded(row).data());
    const int y = row - image_.rect.top;
    if (y < 0 || y >= image_.height()) return;
    std::copy_n(depth_.begin() + (left_ - firstColumn_), right_ - left_,
                image_.depthRow(y) + (left_ - image_.rect.left));
  }

  /// Writes a row's colours into the image. `above` is the row above, or the row itself.
  void finish(int row, int above) {
    const auto part = [&](int each) { return shaded(each).data() + (left_ - firstColumn_); };
    raster::softenDown(part(above), part(row), part(row + 1), right_ - left_, kSoftening,
                       image_.colourRow(row - image_.rect.top) + (left_ - image_.rect.left));
  }

  const GroundMaps& maps_;
  const GroundLight& light_;
  const Frame& frame_;
  std::span<const world::PointLight> lights_;
  raster::Image& image_;
  const int lowest_;
  const int firstColumn_;
  const std::vector<world::Hill> hills_;
  const int left_;  // columns of the strip that lie in the image
  const int right_;
  int searched_;  ///< the newest row of `grounds_`
  SoilRow* near_ = nullptr;
  SoilRow* far_ = nullptr;
  std::array<GroundRow, 2 * kMaxRowStep> grounds_;  ///< the newest rows
  std::array<SoilRow, 2> sampled_;
  SampledSoil samples_;
  FineSoil step_{};  // difference per row from the farther to the nearer sampled row
  GrassRows grass_;
  alignas(64) Colours colour_;
  alignas(64) std::array<float, kTile> depth_;
  std::array<Colours, 4> shaded_;
  std::array<float, kRootRows> scales_{};  ///< pixels per metre of the newest rows
};

GroundPicture::GroundPicture(const GroundMaps& maps, const GroundLight& light, const world::Camera& camera,
                             world::Rect rect, std::span<const world::PointLight> lights, raster::ImagePool& images)
    : maps_(maps),
      light_(light),
      frame_(frameOf(camera)),
      lights_(aboveGround(nearestLights(lights, camera.pose.position), maps.hills)) {
  const world::Vec3 eye = camera.pose.position;
  const float ground = world::groundHeight(maps.hills, {eye.x, eye.z});
  if (eye.y <= ground) return;
  const auto inverse = [&](int row) { return frame_.firstInverse + static_cast<float>(row) * frame_.inverseStep; };
  while (!rect.empty() && inverse(rect.top) < 1.0F / kFarthest) ++rect.top;
  if (rect.empty()) return;

  image_ = images.acquire(rect);
  image_->opaque = true;
  firstColumn_ = floorTo(rect.left, kTile);
  parts_ = static_cast<std::size_t>((rect.right - firstColumn_ + kTile - 1) / kTile);
  // Softening needs a row on each side.
  first_ = inverse(rect.top - 1) < 1.0F / kFarthest ? rect.top : rect.top - 1;
  lowest_ = lowestRow(camera, ground, maps.meadow.tallest, rect.bottom);
}

GroundPicture::~GroundPicture() = default;

void GroundPicture::paint(std::size_t part) {
  StripPainter(*this, *image_, firstColumn_ + static_cast<int>(part) * kTile).paint(first_);
}

}  // namespace grove::objects::ground
