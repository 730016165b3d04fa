#include "objects/lightfield/bake/bake_key.h"

#include <vector>

#include "base/checksum.h"

namespace grove::bake {
namespace {

/// Increment if the same model and options give other views than before, so that old partial bakes are not mixed with
/// new ones.
constexpr std::uint64_t kBakeVersion = 5;

}  // namespace

std::uint64_t bakeKeyOf(const models::Model& model, const BakeOptions& options) {
  Checksum checksum;
  const std::vector<std::uint64_t> numbers{kBakeVersion,
                                           static_cast<std::uint64_t>(options.samples),
                                           static_cast<std::uint64_t>(options.truthSamples),
                                           static_cast<std::uint64_t>(options.subdivision),
                                           static_cast<std::uint64_t>(options.tile),
                                           static_cast<std::uint64_t>(options.group),
                                           static_cast<std::uint64_t>(options.rough)};
  checksum.add(numbers);
  const world::Sky& sky = options.sky;
  checksum.add(std::vector<world::Vec3>{sky.sun, sky.sunColour, sky.zenith, sky.haze, sky.glow, sky.ambientSky,
                                        sky.ambientGround, sky.ambientGlow});
  checksum.add(model.triangles.positions);
  checksum.add(model.triangles.indices);
  checksum.add(model.normals);
  checksum.add(model.colours);
  checksum.add(model.uvs);
  checksum.add(model.materialOf);
  for (const models::Material& m : model.materials) {
    checksum.add(std::vector<world::Vec3>{m.albedo, m.transmittance});
    checksum.add(std::vector<float>{m.alphaCutoff, static_cast<float>(m.texture), m.solid ? 1.0F : 0.0F,
                                    m.blended ? 1.0F : 0.0F, m.twoSided ? 1.0F : 0.0F});
  }
  for (const models::Texture& texture : model.textures) {
    checksum.add(std::vector<int>{texture.width, texture.height});
    checksum.add(texture.texels);
  }
  return checksum.value();
}

}  // namespace grove::bake
