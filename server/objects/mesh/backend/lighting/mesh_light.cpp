#include "objects/mesh/backend/lighting/mesh_light.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/checksum.h"
#include "base/log.h"
#include "node/backend/prepare/prepare_each.h"
#include "objects/mesh/backend/lighting/kept_light.h"
#include "raster/shading/light_bake.h"

namespace grove::objects::mesh {
namespace {

using Light = std::vector<std::vector<world::Vec4>>;

/// Increment if raster::bakeLight() returns other values for the same world.
constexpr std::uint64_t kBakeVersion = 2;
/// Milliseconds of work, so that all workers stay busy until the end, and progress is visible.
constexpr std::size_t kVerticesPerTask = 1024;

/// A hash of all inputs of the light.
std::uint64_t keyOf(const std::vector<PlacedMesh>& meshes, const node::BackendServices& services) {
  const world::WorldGeometry& geometry = services.geometry;
  const world::Sky& sky = services.scene.layout.sky;
  Checksum checksum;
  checksum.add(std::vector<std::uint64_t>{kBakeVersion, meshes.size()});
  std::vector<world::Vec3> light{sky.sun};
  for (const float along : {-1.0F, 1.0F}) {
    for (int axis = 0; axis < 3; ++axis) {
      world::Vec3 direction(0.0F);
      direction[axis] = along;
      light.push_back(sky.ambient(direction));
    }
  }
  checksum.add(light);
  checksum.add(services.scene.layout.hills);
  for (const world::PlacedTriangles& each : geometry.shades()) {
    checksum.add(std::vector<world::Mat4>{each.toWorld});
    checksum.add(each.triangles->positions);
    checksum.add(each.triangles->indices);
  }
  for (const PlacedMesh& mesh : meshes) {
    checksum.add(mesh.surface->vertices);
    checksum.add(std::vector<world::Mat4>{mesh.toWorld});
    checksum.add(mesh.shades ? std::vector<raster::Triangle>{} : mesh.surface->levels.back().triangles);
  }
  return checksum.value();
}

Light bake(const std::vector<PlacedMesh>& meshes, const node::BackendServices& services) {
  struct Task {
    std::size_t mesh;
    std::size_t begin;
    std::size_t end;
  };
  Light light;
  light.reserve(meshes.size());
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::size_t vertices = meshes[i].surface->vertices.size();
    light.emplace_back(vertices);
    for (std::size_t begin = 0; begin < vertices; begin += kVerticesPerTask) {
      tasks.push_back({i, begin, std::min(begin + kVerticesPerTask, vertices)});
    }
  }
  std::vector<std::unique_ptr<const world::RayScene>> own(meshes.size());
  std::vector<std::size_t> alone;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (!meshes[i].shades) alone.push_back(i);
  }
  node::prepareEach(services, "shapes of the meshes", alone.size(), [&](std::size_t a) {
    const PlacedMesh& mesh = meshes[alone[a]];
    world::Triangles placed;
    placed.append(mesh.surface->triangles(), mesh.toWorld);
    own[alone[a]] = std::make_unique<const world::RayScene>(placed);
  });
  node::prepareEach(services, "light of the meshes", tasks.size(), [&](std::size_t t) {
    const auto& [i, begin, end] = tasks[t];
    const raster::Obstacles obstacles{services.geometry.rays(), own[i].get(), services.scene.layout.hills};
    raster::bakeLight(*meshes[i].surface, meshes[i].toWorld, services.scene.layout.sky, obstacles, begin,
                      std::span(light[i]).subspan(begin, end - begin));
  });
  return light;
}

/// Reads the cached light; returns nothing if there is none and warns about unusable files.
std::optional<Light> kept(const std::filesystem::path& file, std::uint64_t key, const std::vector<PlacedMesh>& meshes) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  std::vector<std::size_t> vertices;
  vertices.reserve(meshes.size());
  for (const PlacedMesh& mesh : meshes) vertices.push_back(mesh.surface->vertices.size());
  try {
    return readKeptLight(file, key, vertices);
  } catch (const std::exception& e) {
    log::warning(std::string(e.what()) + "; it is rebuilt");
    return std::nullopt;
  }
}

}  // namespace

Light lightOf(const std::vector<PlacedMesh>& meshes, const node::BackendServices& services) {
  std::size_t vertices = 0;
  for (const PlacedMesh& mesh : meshes) vertices += mesh.surface->vertices.size();
  if (vertices < kMinKeptVertices) return bake(meshes, services);
  const std::uint64_t key = keyOf(meshes, services);
  const std::filesystem::path file = keptLightFile(key);
  if (auto light = kept(file, key, meshes)) return *std::move(light);
  Light light = bake(meshes, services);
  try {
    writeKeptLight(file, key, light);
  } catch (const std::exception& e) {
    log::warning(std::string(e.what()) + "; the next start computes the light again");
  }
  return light;
}

}  // namespace grove::objects::mesh
