#include "objects/mesh/backend/mesh_model.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "models/model_source.h"
#include "objects/mesh/backend/shapes/holes.h"
#include "objects/mesh/backend/shapes/model_surface.h"
#include "objects/mesh/backend/shapes/shapes.h"

namespace grove::objects::mesh {
namespace {

/// Default sizes of a shape.
Size usualSize(const std::string& shape) {
  if (shape == "lintel") return {0.6F, 3.0F, 0.8F};
  if (shape == "rocks") return {0.5F, 2.4F, 2.0F};
  if (shape == "logs") return {0.32F, 0.75F, 0.75F};
  return {};
}

raster::Surface surfaceOfShape(const std::string& shape, const Size& size, std::uint32_t seed) {
  if (shape == "lintel") return makeLintel(size, seed);
  if (shape == "rocks") return makeRocks(size, seed);
  if (shape == "logs") return makeLogs(size, seed);
  return makeStandingStone(size, seed);
}

std::optional<float> obstacleOf(const std::string& shape, const Size& size) {
  if (shape == "lintel") return std::nullopt;
  if (shape == "rocks") return 0.9F * size.height;
  if (shape == "logs") return 0.5F * size.width;
  return 0.25F * (size.width + size.depth);
}

/// Radius of the upright cylinder around everything at a visitor's chest height; nothing if no part is that high.
std::optional<float> trunkRadius(const world::Triangles& solid) {
  std::optional<float> radius;
  for (const auto& triangle : solid.indices) {
    for (const std::uint32_t corner : triangle) {
      const world::Vec3 at = solid.positions[corner];
      if (at.y > 0.7F && at.y < 1.3F) radius = std::max(radius.value_or(0.0F), std::hypot(at.x, at.z));
    }
  }
  return radius;
}

raster::RendererKind rendererNamed(const std::string& name) {
  if (name == "gl") return raster::RendererKind::kGl;
  if (name == "simd") return raster::RendererKind::kSimd;
  if (name == "embree") return raster::RendererKind::kEmbree;
  return raster::RendererKind::kAuto;
}

}  // namespace

MeshModel::MeshModel(const world::Parameters& parameters)
    : renderer_(rendererNamed(parameters.choice("renderer", {"auto", "gl", "simd", "embree"}))) {
  const models::ModelSource source = models::readModelSource(parameters);
  if (source.plant.empty() && source.file.empty()) {
    makeShape(parameters);
  } else {
    // Further keys of a light field.
    for (const char* key : {"subdivision", "size", "lightings"}) (void)parameters.integer(key, 1, 1, 1024);
    makeModel(models::loadModel(source, models::Detail::kSmall, parameters));
  }
  bounds_ = surface_.bounds();
}

void MeshModel::makeShape(const world::Parameters& parameters) {
  const std::string shape = parameters.choice("shape", {"stone", "lintel", "rocks", "logs"});
  const auto seed = static_cast<std::uint32_t>(parameters.integer("seed", 1, 0, 1'000'000));
  Size size = usualSize(shape);
  const auto metres = [&](const char* key, float usual) {
    return static_cast<float>(parameters.number(key, static_cast<double>(usual), 0.1, 20.0));
  };
  size.height = metres("height", size.height);
  size.width = metres("width", size.width);
  size.depth = metres("depth", size.depth);
  surface_ = surfaceOfShape(shape, size, seed);
  if (shape != "logs") solid_ = surface_.triangles();
  obstacleRadius_ = obstacleOf(shape, size);
}

void MeshModel::makeModel(models::Model given) {
  const models::Model model = withHolesCut(std::move(given));
  surface_ = surfaceOf(model);
  shade_ = model.triangles;
  world::Triangles solid = solidOf(model);
  if (solid.indices.empty()) return;
  obstacleRadius_ = trunkRadius(solid);
  solid_ = std::move(solid);
}

MeshModel::MeshModel(raster::Surface surface, raster::RendererKind renderer)
    : renderer_(renderer), surface_(std::move(surface)), solid_(surface_.triangles()), bounds_(surface_.bounds()) {}

}  // namespace grove::objects::mesh
