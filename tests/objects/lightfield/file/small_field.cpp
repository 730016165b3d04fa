#include "objects/lightfield/file/small_field.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "objects/lightfield/file/view_packer.h"
#include "world/camera.h"

namespace grove::objects::lightfield {

namespace {

/// Two clusters: a leaf and a smooth triangle.
struct SmallNear {
  std::vector<NearCluster> clusters{{.low = {0, 0, 0}, .high = {1, 1, 0}, .vertices = 4, .faces = 2},
                                    {.low = {0, 0, 1},
                                     .high = {1, 1, 1},
                                     .firstVertex = kClusterAlignment,
                                     .vertices = 3,
                                     .firstFace = 2,
                                     .faces = 1,
                                     .firstColour = 2,
                                     .smooth = 1}};
  std::array<std::vector<float>, 3> positions;
  std::vector<NearFace> faces{{0, 1, 3, 2}, {2, 1, 3, 3}, {0, 1, 2, 2}};
  std::array<std::vector<std::uint32_t>, 2> colours;
};

void addNear(LightField& field) {
  const auto near = std::make_shared<SmallNear>();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 2 * kClusterAlignment; ++i) {
      near->positions[axis].push_back(static_cast<float>((i * (axis + 1)) % 5) * 0.25F);
    }
  }
  for (std::size_t lighting = 0; lighting < 2; ++lighting) {
    for (std::uint32_t i = 0; i < 10; ++i) {
      near->colours[lighting].push_back(0xFF102030U + i + 16 * static_cast<std::uint32_t>(lighting));
    }
  }
  field.near.clusters = near->clusters;
  for (std::size_t axis = 0; axis < 3; ++axis) field.near.positions[axis] = near->positions[axis];
  field.near.faces = near->faces;
  field.near.colours.assign(near->colours.begin(), near->colours.end());
  field.bytes += 16 + 2 * sizeof(NearCluster) + 3 * 2 * kClusterAlignment * sizeof(float) + 3 * sizeof(NearFace) +
                 2 * 10 * sizeof(std::uint32_t);
  field.storage =
      std::make_shared<std::pair<std::shared_ptr<const void>, std::shared_ptr<SmallNear>>>(field.storage, near);
}

}  // namespace

LightField makeSmallField() {
  std::mt19937 random(3);
  const std::vector<std::uint8_t> voxels{0, 1, 2, 0, 0, 1};
  std::vector<std::uint32_t> colours(9, 0x80402010U);
  std::vector<float> depths(9, 2.5F);
  depths[4] = world::kInfiniteDepth;

  LightField shape;
  shape.sphere = ViewSphere(1);
  shape.geometry = {{0.1F, 0.0F, 0.2F}, 3.0F, {0.0F, 0.5F, 0.0F}, 1.25F};
  shape.bounds.low = {-0.5F, 0.0F, -0.5F};
  shape.bounds.high = {0.5F, 1.5F, 0.75F};
  shape.size = 32;
  shape.levels = 2;
  shape.sunAzimuth = 1.5F;
  shape.voxels = {3, 2, 1, 0.25F, {-0.5F, 0.0F, -0.5F}, voxels};
  shape.source = "a small Bäumchen";
  for (const int size : {1, 3}) {
    const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    const ObjectCamera camera{{0, 1, 3}, {-0.5F, 0.5F, -1}, {0.25F, 0, 0}, {0, -0.25F, 0}};
    shape.heldOut.push_back({camera, size, std::span(colours).first(pixels), std::span(depths).first(pixels), false});
  }
  LightFieldBuilder builder(shape, 2);
  for (int view = 0; view < shape.sphere.views(); ++view) {
    DenseView dense;
    dense.size = shape.size;
    dense.colour.resize(2);
    for (int i = 0; i < dense.size * dense.size; ++i) {
      const bool covered = i % dense.size < 20 && view != 2;
      dense.depth.push_back(covered ? static_cast<std::uint16_t>(random() % kNoDepth) : kNoDepth);
      for (auto& lit : dense.colour) lit.push_back(covered ? static_cast<std::uint32_t>(random()) : 0);
    }
    builder.set(view, packView(dense, shape.levels));
  }
  LightField field = std::move(builder).build();
  addNear(field);
  return field;
}

std::vector<std::byte> bytesOf(const std::filesystem::path& file) {
  std::vector<std::byte> bytes(std::filesystem::file_size(file));
  std::ifstream(file, std::ios::binary)
      .read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "grove-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace grove::objects::lightfield
