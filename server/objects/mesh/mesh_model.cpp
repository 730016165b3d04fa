#include "objects/mesh/mesh_model.h"

#include <string>
#include <utility>

#include "objects/mesh/shapes.h"

namespace grove::objects::mesh {
namespace {

/// Sizes that are natural for a shape.
Size usualSize(const std::string& shape) {
  if (shape == "lintel") return {0.6F, 3.0F, 0.8F};
  if (shape == "rocks") return {0.5F, 2.4F, 2.0F};
  if (shape == "logs") return {0.32F, 0.75F, 0.75F};
  return {};
}

Surface makeShape(const std::string& shape, const Size& size, std::uint32_t seed) {
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

RendererKind rendererNamed(const std::string& name) {
  if (name == "gl") return RendererKind::kGl;
  if (name == "simd") return RendererKind::kSimd;
  if (name == "embree") return RendererKind::kEmbree;
  return RendererKind::kAuto;
}

}  // namespace

MeshModel::MeshModel(const world::Parameters& parameters) {
  const std::string shape = parameters.choice("shape", {"stone", "lintel", "rocks", "logs"});
  const auto seed = static_cast<std::uint32_t>(parameters.integer("seed", 1, 0, 1'000'000));
  Size size = usualSize(shape);
  const auto metres = [&](const char* key, float usual) {
    return static_cast<float>(parameters.number(key, static_cast<double>(usual), 0.1, 20.0));
  };
  size.height = metres("height", size.height);
  size.width = metres("width", size.width);
  size.depth = metres("depth", size.depth);
  renderer_ = rendererNamed(parameters.choice("renderer", {"auto", "gl", "simd", "embree"}));
  surface_ = makeShape(shape, size, seed);
  if (shape != "logs") solid_ = surface_.triangles();
  bounds_ = surface_.bounds();
  obstacleRadius_ = obstacleOf(shape, size);
}

MeshModel::MeshModel(Surface surface, RendererKind renderer)
    : renderer_(renderer), surface_(std::move(surface)), solid_(surface_.triangles()), bounds_(surface_.bounds()) {}

}  // namespace grove::objects::mesh
