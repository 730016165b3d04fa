#include "objects/mesh/backend/mesh_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "objects/mesh/backend/mesh_backend_type.h"
#include "objects/mesh/backend/shapes/model_surface.h"

namespace grove::objects::mesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::shared_ptr<const MeshModel> model(const std::string& settings) {
  const world::Scene scene = world::parseScene("[[object]]\ntype = \"mesh\"\nname = \"it\"\n" + settings, "test.toml");
  return std::static_pointer_cast<const MeshModel>(MeshBackendType().model(scene.objects.at(0).parameters));
}

std::string errorOf(const std::string& settings) {
  try {
    (void)model(settings);
  } catch (const world::SceneError& error) {
    return error.what();
  }
  return "no error";
}

/// Each edge belongs to one triangle in each direction.
bool isClosed(const world::Triangles& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : triangles.indices) {
    ++edges[{a, b}];
    ++edges[{b, c}];
    ++edges[{c, a}];
  }
  return std::ranges::all_of(edges, [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != edges.end() && back->second == 1;
  });
}

double volume(const world::Triangles& triangles) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles.indices) {
    sum += static_cast<double>(
        glm::dot(triangles.positions[a], glm::cross(triangles.positions[b], triangles.positions[c])));
  }
  return sum / 6.0;
}

TEST(MeshModel, EveryShapeIsClosedAndFacesOutwards) {
  for (const char* shape : {"stone", "lintel", "rocks", "logs"}) {
    const auto made = model(std::string("shape = \"") + shape + "\"\nseed = 5\n");
    const world::Triangles triangles = made->surface().triangles();
    EXPECT_TRUE(isClosed(triangles)) << shape;
    EXPECT_GT(volume(triangles), 0.0) << shape;
    EXPECT_GE(triangles.indices.size(), 2000U) << shape;
    EXPECT_LE(triangles.indices.size(), 7000U) << shape;
    for (const raster::Level& level : made->surface().levels) EXPECT_FALSE(level.triangles.empty()) << shape;
  }
}

TEST(MeshModel, SmokePassesLogsAndVisitorsDoNot) {
  EXPECT_NE(model("shape = \"rocks\"\n")->solid(), nullptr);
  const auto logs = model("shape = \"logs\"\n");
  EXPECT_EQ(logs->solid(), nullptr);
  EXPECT_TRUE(logs->obstacleRadius().has_value());
}

TEST(MeshModel, AStoneHasAboutItsSize) {
  const auto made = model("shape = \"stone\"\nheight = 3.4\nwidth = 1.5\ndepth = 0.7\nseed = 8\n");
  const world::Bounds bounds = made->bounds();
  EXPECT_NEAR(bounds.high.y, 3.4F, 0.6F);
  EXPECT_LT(bounds.low.y, 0.0F);
  EXPECT_GT(bounds.low.y, -0.5F);
  EXPECT_NEAR(bounds.size().x, 1.5F, 0.6F);
  EXPECT_NEAR(bounds.size().z, 0.7F, 0.5F);
  ASSERT_TRUE(made->obstacleRadius().has_value());
  EXPECT_NEAR(*made->obstacleRadius(), 0.55F, 0.01F);
}

TEST(MeshModel, SeedsAreRepeatableAndDiffer) {
  const auto first = model("seed = 3\n");
  EXPECT_EQ(first->solid()->positions, model("seed = 3\n")->solid()->positions);
  EXPECT_NE(first->solid()->positions, model("seed = 4\n")->solid()->positions);
}

TEST(MeshModel, RendererIsChosenInTheSceneFile) {
  EXPECT_EQ(model("")->renderer(), raster::RendererKind::kAuto);
  EXPECT_EQ(model("renderer = \"gl\"\n")->renderer(), raster::RendererKind::kGl);
  EXPECT_EQ(model("renderer = \"simd\"\n")->renderer(), raster::RendererKind::kSimd);
  EXPECT_EQ(model("renderer = \"embree\"\n")->renderer(), raster::RendererKind::kEmbree);
}

TEST(MeshModel, BadSettingsNameTheKey) {
  EXPECT_THAT(errorOf("shape = \"teapot\"\n"), AllOf(HasSubstr("test.toml:4"), HasSubstr("shape")));
  EXPECT_THAT(errorOf("renderer = \"vulkan\"\n"),
              AllOf(HasSubstr("test.toml:4"), HasSubstr("renderer"), HasSubstr("auto"), HasSubstr("gl"),
                    HasSubstr("simd"), HasSubstr("embree")));
  EXPECT_THAT(errorOf("height = 900.0\n"), AllOf(HasSubstr("test.toml:4"), HasSubstr("height")));
  EXPECT_THAT(errorOf("width = -1.0\n"), HasSubstr("width"));
}

TEST(MeshModel, APlantIsAMeshWithTheKeysOfItsLightField) {
  const auto oak = model("plant = \"oak\"\nseed = 2\nsubdivision = 8\nsize = 256\nlightings = 3\n");
  EXPECT_GT(oak->surface().levels.at(0).triangles.size(), 100'000U);
  EXPECT_GT(oak->bounds().high.y, 5.0F);
  ASSERT_NE(oak->solid(), nullptr);
  ASSERT_NE(oak->shade(), nullptr);
  EXPECT_LT(oak->solid()->indices.size(), oak->shade()->indices.size()) << "leaves shade but let smoke through";
  ASSERT_TRUE(oak->obstacleRadius().has_value());
  EXPECT_GT(*oak->obstacleRadius(), 0.1F);
  EXPECT_LT(*oak->obstacleRadius(), 0.8F) << "one walks under the crown";
}

TEST(MeshModel, LeavesAreDoubleSided) {
  models::Model leaf;
  leaf.triangles.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  leaf.triangles.indices = {{0, 1, 2}};
  leaf.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  leaf.materialOf = {0};
  leaf.materials.push_back({.name = "leaf", .albedo = {0.2F, 0.4F, 0.1F}, .transmittance = {0.2F, 0.2F, 0.0F}});
  const raster::Surface surface = surfaceOf(leaf);
  ASSERT_EQ(surface.levels.at(0).triangles.size(), 2U);
  ASSERT_EQ(surface.vertices.size(), 6U);
  EXPECT_EQ(surface.vertices[0].normal, -surface.vertices[5].normal);
  EXPECT_EQ(surface.vertices[0].albedo, world::Vec3(0.3F, 0.5F, 0.1F));
  EXPECT_TRUE(solidOf(leaf).indices.empty());
}

TEST(MeshModel, AGltfFileIsAMesh) {
  const auto tree = model("model = \"" GROVE_TESTS "/models/gltf/lantern_tree.gltf\"\n");
  EXPECT_GT(tree->surface().levels.at(0).triangles.size(), 100U);
  EXPECT_THAT(errorOf("model = \"/nowhere.glb\"\n"), AllOf(HasSubstr("test.toml:4"), HasSubstr("/nowhere.glb")));
  EXPECT_THAT(errorOf("model = \"a.glb\"\nplant = \"oak\"\n"), HasSubstr("either"));
}

}  // namespace
}  // namespace grove::objects::mesh
