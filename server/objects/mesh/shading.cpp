#include "objects/mesh/shading.h"

#include <algorithm>
#include <cmath>

#include "objects/mesh/noise.h"

namespace grove::objects::mesh {
namespace {

using world::Vec3;
using world::Vec4;

constexpr float kCoarse = 9.0F;  // cells per metre
constexpr float kFine = kFineDetail;
const glm::mat3 kTurn{0.36F, 0.48F, -0.80F, -0.80F, 0.60F, 0.00F, 0.48F, 0.64F, 0.60F};
const glm::mat3 kCoarseTurn = kCoarse * kTurn;
const glm::mat3 kFineTurn = kFine * glm::transpose(kTurn);
const Vec3 kLichen{0.36F, 0.37F, 0.26F};

Varyings shadeVertex(const Vertex& vertex, Vec4 light, const Drawing& drawing) {
  const world::Mat4& bone = drawing.bones[static_cast<std::size_t>(vertex.bone)];
  Varyings out;
  out.place = Vec3(bone * Vec4(vertex.position, 1.0F));
  out.facing = glm::normalize(glm::mat3(bone) * vertex.normal);
  out.paint = vertex.albedo * glm::mix(Vec3(1.0F), drawing.tint, vertex.tint);
  out.grain = vertex.grain;
  out.lichen = vertex.lichen;
  out.sun = light.x * drawing.sunShare;
  const Vec3 share(light.y, light.z, light.w);
  out.indirect = drawing.object->baked ? share : world::ambient(out.facing) * share;
  for (std::size_t i = 0; i < static_cast<std::size_t>(drawing.lamps.count); ++i) {
    const Vec3 towards = drawing.lamps.position[i] - out.place;
    const float squared = glm::dot(towards, towards);
    const float cosine = glm::dot(out.facing, towards) / std::sqrt(squared + 1.0e-6F);
    out.indirect += drawing.lamps.colour[i] * (std::max(0.0F, (cosine + 0.15F) / 1.15F) / (squared + 0.02F));
  }
  const Vec3 sight = out.place - drawing.camera->pose.position;
  const float metres = glm::length(sight);
  const float hazy = world::hazeAmount(metres);
  out.cleared = 1.0F - hazy;
  out.added = out.paint * (vertex.emission * out.cleared) + world::hazeColour(sight / metres) * hazy;
  return out;
}

}  // namespace

std::vector<Varyings> shadeVertices(const Drawing& drawing) {
  const LitSurface& object = *drawing.object;
  std::vector<Varyings> all;
  all.reserve(object.surface.vertices.size());
  for (std::size_t i = 0; i < object.surface.vertices.size(); ++i) {
    all.push_back(shadeVertex(object.surface.vertices[i], object.light[i], drawing));
  }
  return all;
}

Varyings interpolate(const Varyings& a, const Varyings& b, const Varyings& c, float u, float v) {
  const float w = 1.0F - u - v;
  const auto mixed = [&](auto Varyings::*member) { return a.*member * w + b.*member * u + c.*member * v; };
  return {mixed(&Varyings::place),    mixed(&Varyings::facing), mixed(&Varyings::paint),
          mixed(&Varyings::grain),    mixed(&Varyings::lichen), mixed(&Varyings::sun),
          mixed(&Varyings::indirect), mixed(&Varyings::added),  mixed(&Varyings::cleared)};
}

Vec3 shadePixel(const Varyings& at, float pixelsPerMetre) {
  Vec3 n = at.facing;
  Vec3 ground = at.paint;
  float cavity = 1.0F;
  if (at.grain > 0.0F) {
    const float coarseShare = at.grain * std::clamp(pixelsPerMetre / (3.0F * kCoarse) - 0.4F, 0.0F, 1.0F);
    const float fineShare = at.grain * std::clamp(pixelsPerMetre / (3.0F * kFine) - 1.0F, 0.0F, 1.0F);
    const NoiseSample coarse = valueNoise(kCoarseTurn * at.place);
    const NoiseSample fine = valueNoise(kFineTurn * at.place);
    const float height = coarse.value - 0.5F;
    const float grain = (fine.value - 0.5F) * fineShare;
    n -= coarse.gradient * kCoarseTurn * (0.022F * coarseShare) + fine.gradient * kFineTurn * (0.0055F * fineShare);
    cavity = 1.0F + 0.5F * height * coarseShare + 0.45F * grain;
    const float lichen = std::clamp((coarse.value + 0.5F * grain + at.lichen - 1.0F) * 7.0F, 0.0F, 1.0F) * at.grain;
    ground = glm::mix(ground * (1.0F + 0.5F * height * coarseShare + 0.5F * grain), kLichen, 0.75F * lichen);
  }
  const float direct = std::max(0.0F, glm::dot(n, world::sunDirection())) / glm::length(n) * at.sun;
  const Vec3 lit = ground * (world::sunColour() * direct + at.indirect * cavity);
  return lit * at.cleared + at.added;
}

}  // namespace grove::objects::mesh
