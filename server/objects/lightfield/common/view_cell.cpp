#include "objects/lightfield/common/view_cell.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace grove::objects::lightfield {
namespace {

// Focal lengths are rounded up, so that visitors with windows of similar sizes share pictures.
constexpr float kFocalsPerOctave = 4.0F;
// A picture is at most this step sharper than the farthest eye of its shell needs.
constexpr float kShellsPerOctave = 8.0F;
// Steps by which an eye may be farther than a picture's own eye: beyond that, skipped texels begin to flicker.
constexpr float kFarther = 2.0F;
// Share of the error for eyes that are too near or too far. Moving to and fro costs little error, so most of it is left
// for moving around, which makes the cell about as long as it is wide.
constexpr float kRadialShare = 0.25F;
// People move around an object more than above it.
constexpr float kAspect = 2.0F;
// Chord of the widest cell, relative to the distance: even a distant object's light changes with the direction.
constexpr float kWidest = 0.25F;
// Eyes nearer to the ball than this, in radii, have no cell.
constexpr float kOutside = 1.05F;
// Limits of an eye's distance from the eye of a stale picture: beyond them too much is missing.
constexpr float kMinCosine = 0.5F;
constexpr float kMaxOctaves = 1.0F;
constexpr float kErrorsPerPixel = 64.0F;
constexpr float kMaxLayers = 1.0e6F;
constexpr float kPi = std::numbers::pi_v<float>;
// Limits of ids: far beyond those of real eyes.
constexpr std::int32_t kMaxErrors = 1 << 16;
constexpr std::int32_t kMaxFocals = 80;
constexpr std::int32_t kMaxShells = 256;

/// Permitted distance of eyes between two distances from the axis of their cell.
///
/// Let the ball have radius R around the origin, c be the cell's eye at distance D, and e = c + d another eye, whose
/// offset d has the length `radial` along the axis through c and `side` across it. Points p and q on one ray from c
/// that leaves the axis by the angle a lie on its chord through the ball, of length L = 2 sqrt(R^2 - (D sin a)^2). The
/// distance of e from that ray is h <= side + radial sin a. With x the place along the ray, counted from the foot F of
/// e on it, p and q are seen from e under the angle
///     integral of h / (h^2 + x^2) dx from p to q  <=  h (1/x0 - 1/x1)  =  h L / (x0 x1)
/// where x0 and x1 are the ends of the chord. x0 x1 is the power of F, |F|^2 - R^2, and |F| >= |e| - h. Since
/// L <= 2R and L sin a <= R^2 / D (largest at D sin a = R / sqrt 2), and sin a <= R / D wherever there is a chord,
///     angle <= (2 R side + radial R^2 / D) / ((|e| - side - radial R / D)^2 - R^2).
/// This is the error over the focal length, as in reprojectionError(); the function solves for `side`.
float permittedSide(float ball, float nearest, float axis, float radial, float angle) {
  const float clear = nearest - radial * ball / axis;
  const float c = clear * clear - ball * ball - radial * ball * ball / (axis * angle);
  const float b = clear + ball / angle;
  return c > 0.0F && clear > 0.0F ? c / (b + std::sqrt(b * b - c)) : 0.0F;
}

/// Values that all cells of one layer share.
struct Layer {
  float sharp = 0.0F;      ///< focal length
  float low = 0.0F;        ///< smallest distance of its shell
  float thickness = 0.0F;  ///< of the shell
  float layers = 0.0F;     ///< in the shell
  float nearest = 0.0F;    ///< distance
  float axis = 0.0F;       ///< distance of the cells' own eyes
  float radial = 0.0F;     ///< permitted distance of an eye from the cell's own, along the axis
  float side = 0.0F;       ///< and across it
  float halfBand = 0.0F;   ///< radians
  float bands = 0.0F;
  float reach = 0.0F;  ///< metres
};

/// The shell of an id, without the layer's own distances; nothing if it has no layers.
std::optional<Layer> shellOf(float ball, const CellId& id) {
  Layer layer;
  layer.sharp = std::exp2(static_cast<float>(id.focal) / kFocalsPerOctave);
  const float angle = static_cast<float>(id.error) / kErrorsPerPixel / layer.sharp;
  layer.low = ball * std::exp2(static_cast<float>(id.shell) / kShellsPerOctave);
  layer.thickness = layer.low * (std::exp2(1.0F / kShellsPerOctave) - 1.0F);
  const float power = std::max(layer.low * layer.low - ball * ball, 1.0e-6F * ball * ball);
  layer.layers = std::ceil(0.5F * layer.thickness * ball * ball / (layer.low * power * kRadialShare * angle));
  if (!(layer.layers < kMaxLayers)) return std::nullopt;
  return layer;
}

/// The complete layer; nothing if an eye in one of its cells could hardly move.
std::optional<Layer> layerOf(float ball, const CellId& id) {
  std::optional<Layer> layer = shellOf(ball, id);
  if (!layer) return std::nullopt;
  const auto index = static_cast<float>(id.layer);
  const float angle = static_cast<float>(id.error) / kErrorsPerPixel / layer->sharp;
  layer->nearest = layer->low + layer->thickness * index / layer->layers;
  if (!(layer->nearest > ball)) return std::nullopt;
  const float farthest = layer->low + layer->thickness * (index + 1.0F) / layer->layers;
  layer->axis = 0.5F * (layer->nearest + farthest);

  // Eyes off the axis are nearer along it by side^2 / 2 nearest.
  const float half = farthest - layer->axis;
  const float guess = std::min(permittedSide(ball, layer->nearest, layer->axis, half, angle), kWidest * farthest);
  layer->radial = half + guess * guess / (2.0F * layer->nearest);
  layer->side = std::min(permittedSide(ball, layer->nearest, layer->axis, layer->radial, angle), guess);

  // A chord across the cell's middle is at most the root of the sum of the squares of its two half sides (haversine
  // formula), and no eye is farther from the axis than the farthest distance times that chord.
  const float chord = layer->side / farthest;
  layer->halfBand = chord / std::sqrt(1.0F + kAspect * kAspect);
  layer->reach = layer->halfBand * layer->nearest * kAspect;
  if (!(layer->reach >= kMinReach)) return std::nullopt;
  layer->bands = std::ceil(0.5F * kPi / layer->halfBand);
  return layer;
}

float bandBegin(const Layer& layer, float band) { return (band / layer.bands - 0.5F) * kPi; }

/// Number of columns in a band of elevations.
float columnsOf(const Layer& layer, float band) {
  const float lowest = bandBegin(layer, band);
  const float highest = bandBegin(layer, band + 1.0F);
  const float widest = lowest < 0.0F && highest > 0.0F ? 1.0F : std::max(std::cos(lowest), std::cos(highest));
  return std::max(1.0F, std::ceil(kPi * widest / (kAspect * layer.halfBand)));
}

/// A layer's cell with its own eye.
std::optional<ViewCell> cellIn(const Layer& layer, const ViewGeometry& geometry, const CellId& id) {
  ViewCell cell;
  cell.id = id;
  cell.reach = layer.reach;
  const auto band = static_cast<float>(id.band);
  const float up = 0.5F * (bandBegin(layer, band) + bandBegin(layer, band + 1.0F));
  const float around = ((static_cast<float>(id.column) + 0.5F) / columnsOf(layer, band) - 0.5F) * 2.0F * kPi;
  const world::Vec3 direction(std::cos(up) * std::sin(around), std::sin(up), std::cos(up) * std::cos(around));
  ViewGeometry aimed = geometry;
  aimed.centre = geometry.target;
  aimed.radius = layer.axis;
  const ViewCamera camera = viewCamera(aimed, direction);
  // A point's distances from the cell's eye and from another eye differ by at most the distance between the eyes.
  const float size =
      std::ceil(layer.sharp / camera.focal * (1.0F + (layer.side + layer.radial) / (layer.nearest - geometry.extent)));
  if (!(size <= static_cast<float>(kMaxCellSize))) return std::nullopt;
  cell.size = static_cast<int>(size);
  cell.camera = objectCamera(camera, cell.size);
  return cell;
}

}  // namespace

float reprojectionError(const ViewGeometry& geometry, world::Vec3 own, world::Vec3 eye, float focal, float errorPixels,
                        std::int32_t sharper) {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  const float ball = geometry.extent;
  const world::Vec3 from = own - geometry.target;
  const world::Vec3 to = eye - geometry.target;
  const float axis = glm::length(from);
  const float distance = glm::length(to);
  const float nearer = std::log2(axis / distance) * kShellsPerOctave;
  if (!(distance > kOutside * ball && std::abs(nearer) <= kMaxOctaves * kShellsPerOctave)) return kNever;
  const float blurred = nearer - static_cast<float>(sharper) * (kShellsPerOctave / kFocalsPerOctave);
  if (!(glm::dot(from, to) >= kMinCosine * axis * distance)) return kNever;
  const float along = glm::dot(eye - own, from) / axis;
  const float side = glm::length(eye - own - along * from / axis);
  const float radial = std::abs(along);
  // So far aside that the proof no longer holds; the angle is still large.
  const float clear = std::max(distance - side - radial * ball / axis, kOutside * ball);
  const float angle = (2.0F * ball * side + radial * ball * ball / axis) / (clear * clear - ball * ball);
  return std::max({angle * focal / errorPixels, blurred, -blurred / kFarther, side / (kWidest * axis)});
}

std::optional<ViewCell> viewCell(const ViewGeometry& geometry, world::Vec3 eye, float focal, float errorPixels) {
  assert(geometry.extent > 0.0F && focal > 0.0F && errorPixels > 0.0F);
  const float ball = geometry.extent;
  const world::Vec3 from = eye - geometry.target;
  const float distance = glm::length(from);
  if (!(distance > kOutside * ball)) return std::nullopt;

  CellId id;
  id.error = std::max(static_cast<std::int32_t>(std::lround(errorPixels * kErrorsPerPixel)), 1);
  id.focal = static_cast<std::int32_t>(std::ceil(std::log2(focal) * kFocalsPerOctave - 1.0e-3F));
  id.shell = static_cast<std::int32_t>(std::floor(std::log2(distance / ball) * kShellsPerOctave));
  const auto shell = shellOf(ball, id);
  if (!shell) return std::nullopt;
  const float at = std::floor((distance - shell->low) / shell->thickness * shell->layers);
  id.layer = static_cast<std::int32_t>(std::clamp(at, 0.0F, shell->layers - 1.0F));
  const auto layer = layerOf(ball, id);
  if (!layer) return std::nullopt;
  const float elevation = std::asin(std::clamp(from.y / distance, -1.0F, 1.0F));
  const float band = std::clamp(std::floor((elevation / kPi + 0.5F) * layer->bands), 0.0F, layer->bands - 1.0F);
  const float columns = columnsOf(*layer, band);
  const float azimuth = std::atan2(from.x, from.z) / (2.0F * kPi) + 0.5F;
  id.band = static_cast<std::int32_t>(band);
  id.column = static_cast<std::int32_t>(std::clamp(std::floor(azimuth * columns), 0.0F, columns - 1.0F));
  return cellIn(*layer, geometry, id);
}

std::optional<ViewCell> viewCell(const ViewGeometry& geometry, const CellId& id) {
  const bool isPossible = id.error >= 1 && id.error <= kMaxErrors && id.focal >= 0 && id.focal <= kMaxFocals &&
                          id.shell >= 0 && id.shell <= kMaxShells && id.layer >= 0 && id.band >= 0 && id.column >= 0;
  if (!isPossible) return std::nullopt;
  const auto layer = layerOf(geometry.extent, id);
  if (!layer || static_cast<float>(id.layer) >= layer->layers || static_cast<float>(id.band) >= layer->bands ||
      static_cast<float>(id.column) >= columnsOf(*layer, static_cast<float>(id.band))) {
    return std::nullopt;
  }
  return cellIn(*layer, geometry, id);
}

}  // namespace grove::objects::lightfield
