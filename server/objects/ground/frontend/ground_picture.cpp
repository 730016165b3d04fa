#include "objects/ground/frontend/ground_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/floor_to.h"
#include "objects/ground/frontend/grow_kernels.h"
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

/// Number of nearer rows whose grass can reach up to this row. The search starts at the neighbour row's reach, which is
/// similar.
int reachOf(const Frame& frame, float tallest, int row, int ofNeighbour) {
  const auto reaches = [&](int rows) {
    return rowAt(frame, row + rows).pixelsPerMetre * tallest + 0.5F >= static_cast<float>(rows);
  };
  int reach = ofNeighbour;
  while (reach > 0 && !reaches(reach)) --reach;
  while (reach + 1 < kRootRows - 1 && reaches(reach + 1)) ++reach;
  return reach;
}

std::vector<world::PointLight> nearestLights(std::span<const world::PointLight> lights, world::Vec3 eye) {
  if (lights.size() <= kMaxLights) return {lights.begin(), lights.end()};
  const auto nearness = [&](const world::PointLight& light) { return -glm::distance(light.position, eye); };
  return world::strongestLights(lights, kMaxLights, -world::kInfiniteDepth, nearness);
}

}  // namespace

/// Values that the strips of a row share.
struct GroundPicture::RowPlan {
  Row row;
  int reach = 0;  // rows nearer to the eye whose grass can be seen in this one
  MeadowSampling sampling;
};

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
        firstColumn_(firstColumn),
        left_(std::max(firstColumn, image.rect.left)),
        right_(std::min(firstColumn + kTile, image.rect.right)) {}

  void paint(std::span<const RowPlan> plans) {
    for (const RowPlan& plan : plans) {
      const SoilBetween soil = soilAt(plan.row.row);
      growGrass(frame_, plan.row, firstColumn_, maps_.meadow, plan.sampling, soil, grass_);
      if (plan.row.row > image_.rect.bottom) continue;
      findRoots(plan.row, plan.reach, soil, grass_);
      shade(plan.row, soil);
      if (plan.row.row + 1 < image_.rect.bottom) finish(plan.row.row + 1, plan.row.row);
    }
    // Nothing is above the horizon.
    if (plans.back().row.row == image_.rect.top) finish(image_.rect.top, image_.rect.top);
  }

 private:
  static constexpr int kNoRow = std::numeric_limits<int>::min();
  struct SoilRow {
    int row = kNoRow;
    FineSoil soil;
  };

  void sample(int row, SoilRow& out) {
    const Row at = rowAt(frame_, row);
    const float texel = maps_.clearing.metres / static_cast<float>(maps_.clearing.pyramid.size());
    const float area = at.across * kCoarse * at.along * static_cast<float>(rowStep(frame_, row));
    sampleSoil(frame_, at, firstColumn_, maps_.clearing, levelFor(std::sqrt(area) / texel, maps_.clearing.pyramid),
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

  void shade(const Row& row, const SoilBetween& soil) {
    shadeRow(frame_, row, soil, grass_, colour_.data(), depth_.data());
    raster::softenAcross(colour_.data(), kTile, kSoftening, shaded(row.row).data());
    const int y = row.row - image_.rect.top;
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
  const int firstColumn_;
  const int left_;  // columns of the strip that lie in the image
  const int right_;
  std::array<SoilRow, 2> sampled_;
  SoilRow* near_ = &sampled_[0];
  SoilRow* far_ = &sampled_[1];
  SampledSoil samples_;
  FineSoil step_{};  // difference per row from the farther to the nearer sampled row
  GrassRows grass_;
  alignas(64) Colours colour_;
  alignas(64) std::array<float, kTile> depth_;
  std::array<Colours, 4> shaded_;
};

GroundPicture::GroundPicture(const GroundMaps& maps, const GroundLight& light, const world::Camera& camera,
                             world::Rect rect, std::span<const world::PointLight> lights, raster::ImagePool& images)
    : maps_(maps), light_(light), frame_(frameOf(camera)), lights_(nearestLights(lights, camera.pose.position)) {
  if (camera.pose.position.y <= 0.0F) return;
  const auto inverse = [&](int row) { return frame_.firstInverse + static_cast<float>(row) * frame_.inverseStep; };
  while (!rect.empty() && inverse(rect.top) < 1.0F / kFarthest) ++rect.top;
  if (rect.empty()) return;

  image_ = images.acquire(rect);
  image_->opaque = true;
  firstColumn_ = floorTo(rect.left, kTile);
  parts_ = static_cast<std::size_t>((rect.right - firstColumn_ + kTile - 1) / kTile);
  // Softening needs a row on each side.
  const int first = inverse(rect.top - 1) < 1.0F / kFarthest ? rect.top : rect.top - 1;
  int reach = reachOf(frame_, maps.meadow.tallest, rect.bottom, 0);
  const int lowest = rect.bottom + reach;
  plans_.reserve(static_cast<std::size_t>(lowest + 1 - first));
  for (int y = lowest; y >= first; --y) {
    const Row row = rowAt(frame_, y);
    reach = reachOf(frame_, maps.meadow.tallest, y, reach);
    plans_.push_back({row, reach, samplingFor(row, maps.meadow)});
  }
}

GroundPicture::~GroundPicture() = default;

void GroundPicture::paint(std::size_t part) {
  StripPainter(*this, *image_, firstColumn_ + static_cast<int>(part) * kTile).paint(plans_);
}

}  // namespace grove::objects::ground
