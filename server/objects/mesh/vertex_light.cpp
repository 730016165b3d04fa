#include "objects/mesh/vertex_light.h"

#include <algorithm>
#include <cmath>

namespace grove::objects::mesh {
namespace {

using world::Vec3;

constexpr std::size_t kBlock = 256;

/// The light of one frame in the coordinates of one bone, so that no vertex has to be moved.
struct BoneLight {
  BoneLight(const Drawing& drawing, const world::Mat4& bone) {
    const world::Mat4 toBone = glm::inverse(bone);
    metre = glm::length(Vec3(bone[0]));
    const glm::mat3 turn = glm::mat3(toBone) * metre;
    sun = turn * world::sunDirection();
    up = turn * Vec3(0, 1, 0);
    eye = Vec3(toBone * world::Vec4(drawing.camera->pose.position, 1.0F));
    for (std::size_t i = 0; i < static_cast<std::size_t>(drawing.lamps.count); ++i) {
      lamps[i] = Vec3(toBone * world::Vec4(drawing.lamps.position[i], 1.0F));
    }
  }

  float metre;  ///< of a unit of the bone's coordinates
  Vec3 sun;
  Vec3 up;
  Vec3 eye;
  std::array<Vec3, kMostLamps> lamps{};
};

/// Irradiance, as a white surface reflects it, without the sun's.
struct Indirect {
  std::array<float, kBlock> r;
  std::array<float, kBlock> g;
  std::array<float, kBlock> b;
};

void addLamp(const VertexArrays& v, std::size_t first, std::size_t count, Vec3 at, Vec3 colour, float metre,
             Indirect& indirect) {
  const float* px = v.positionX.data() + first;
  const float* py = v.positionY.data() + first;
  const float* pz = v.positionZ.data() + first;
  const float* nx = v.normalX.data() + first;
  const float* ny = v.normalY.data() + first;
  const float* nz = v.normalZ.data() + first;
  const float squareMetre = metre * metre;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = at.x - px[i];
    const float y = at.y - py[i];
    const float z = at.z - pz[i];
    const float squared = x * x + y * y + z * z + 1.0e-6F;
    const float cosine = (nx[i] * x + ny[i] * y + nz[i] * z) / std::sqrt(squared);
    const float share = std::max(0.0F, (cosine + 0.15F) / 1.15F) / (squared * squareMetre + 0.02F);
    indirect.r[i] += colour.r * share;
    indirect.g[i] += colour.g * share;
    indirect.b[i] += colour.b * share;
  }
}

/// What world::ambient() says, for normals in the bone's coordinates.
void addAmbient(const VertexArrays& v, std::size_t first, std::size_t count, const BoneLight& light,
                Indirect& indirect) {
  // The ambient light is a polynomial of two cosines; three directions tell its coefficients.
  const Vec3 level = world::sunDirection() * Vec3(1, 0, 1);
  const Vec3 sunwards = glm::normalize(level);
  const Vec3 away = world::ambient(-sunwards);
  const Vec3 glow = world::ambient(sunwards) - away;
  const Vec3 slope = 0.5F * (world::ambient({0, 1, 0}) - world::ambient({0, -1, 0}));
  const Vec3 towards = (light.sun - light.up * world::sunDirection().y) / glm::length(level);
  const Vec3 up = light.up;
  const float* nx = v.normalX.data() + first;
  const float* ny = v.normalY.data() + first;
  const float* nz = v.normalZ.data() + first;
  const float* r = v.indirectR.data() + first;
  const float* g = v.indirectG.data() + first;
  const float* b = v.indirectB.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const float rise = nx[i] * up.x + ny[i] * up.y + nz[i] * up.z;
    const float near = 0.5F + 0.5F * (nx[i] * towards.x + ny[i] * towards.y + nz[i] * towards.z);
    indirect.r[i] = r[i] * (away.r + slope.r * rise + glow.r * near * near);
    indirect.g[i] = g[i] * (away.g + slope.g * rise + glow.g * near * near);
    indirect.b[i] = b[i] * (away.b + slope.b * rise + glow.b * near * near);
  }
}

/// world::toDisplay() in bytes, with the power 1 / 2.4 as a sum of roots, to 0.3 / 255 (I. Taylor, "sRGB
/// Approximations for HLSL").
inline float displayed(float linear) {
  const float x = std::max(linear, 0.0F) * 0.85F;
  const float mapped = std::min((x * (2.51F * x + 0.03F)) / (x * (2.43F * x + 0.59F) + 0.14F), 1.0F);
  const float root2 = std::sqrt(mapped);
  const float root4 = std::sqrt(root2);
  const float curved =
      0.662002687F * root2 + 0.684122060F * root4 - 0.323583601F * std::sqrt(root4) - 0.0225411470F * mapped;
  return 255.0F * (mapped <= 0.0031308F ? 12.92F * mapped : curved);
}

inline std::uint32_t toByte(float value) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(value + 0.5F)); }

void sendToEye(const VertexArrays& v, std::size_t first, std::size_t count, const Drawing& drawing,
               const BoneLight& light, const Indirect& indirect, std::uint32_t* out) {
  const Vec3 sunColour = world::sunColour();
  // The glow of the haze is a polynomial of the cosine to the sun; two directions tell its coefficients.
  const Vec3 haze = world::hazeColour(-world::sunDirection());
  const Vec3 glow = (world::hazeColour(world::sunDirection()) - haze) / 0.66F;
  const Vec3 tint = drawing.tint - 1.0F;
  // An exponential in the distance, by how much a thousand metres let through.
  const float perMetre = std::log(1.0F - world::hazeAmount(1000.0F)) / 1000.0F * light.metre;
  const Vec3 eye = light.eye;
  const Vec3 sun = light.sun;
  const float sunShare = drawing.sunShare;
  const float* px = v.positionX.data() + first;
  const float* py = v.positionY.data() + first;
  const float* pz = v.positionZ.data() + first;
  const float* nx = v.normalX.data() + first;
  const float* ny = v.normalY.data() + first;
  const float* nz = v.normalZ.data() + first;
  const float* ar = v.albedoR.data() + first;
  const float* ag = v.albedoG.data() + first;
  const float* ab = v.albedoB.data() + first;
  const float* emission = v.emission.data() + first;
  const float* tinted = v.tint.data() + first;
  const float* sunSeen = v.sun.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const float cosine = nx[i] * sun.x + ny[i] * sun.y + nz[i] * sun.z;
    const float seen = sunSeen[i] * sunShare;
    const float direct = std::max(0.0F, cosine) * seen;
    const float r = indirect.r[i] + sunColour.r * direct;
    const float g = indirect.g[i] + sunColour.g * direct;
    const float b = indirect.b[i] + sunColour.b * direct;
    const float x = px[i] - eye.x;
    const float y = py[i] - eye.y;
    const float z = pz[i] - eye.z;
    const float length = std::sqrt(x * x + y * y + z * z + 1.0e-8F);
    const float cleared = std::exp(perMetre * length);
    const float hazy = 1.0F - cleared;
    const float sunwards = std::max(0.0F, (x * sun.x + y * sun.y + z * sun.z) / length);
    const float power2 = sunwards * sunwards;
    const float power4 = power2 * power2;
    const float power8 = power4 * power4;
    const float glowing = 0.36F * power4 + 0.30F * power8 * power8;
    const float shown = emission[i];
    const auto channel = [&](float albedo, float tintBy, float lit, float air, float glowOf) {
      return displayed(albedo * (1.0F + tintBy * tinted[i]) * (lit + shown) * cleared +
                       (air + glowOf * glowing) * hazy);
    };
    const std::uint32_t red = toByte(channel(ar[i], tint.r, r, haze.r, glow.r));
    const std::uint32_t green = toByte(channel(ag[i], tint.g, g, haze.g, glow.g));
    const std::uint32_t blue = toByte(channel(ab[i], tint.b, b, haze.b, glow.b));
    const float grazing = std::clamp(4.0F * cosine + 0.5F, 0.0F, 1.0F);
    const float relief = seen * grazing * cleared * (sunColour.r + sunColour.g + sunColour.b) / (r + g + b + shown);
    const std::uint32_t alpha = toByte(255.0F / kMostRelief * std::min(relief, kMostRelief));
    out[i] = red | green << 8U | blue << 16U | alpha << 24U;
  }
}

}  // namespace

void lightVertices(const VertexArrays& arrays, const Drawing& drawing, std::span<std::uint32_t> out) {
  Indirect indirect;
  for (const VertexArrays::Run& run : arrays.runs) {
    const BoneLight light(drawing, drawing.bones[run.bone]);
    const std::size_t end = std::min(run.end, out.size());
    for (std::size_t first = run.begin; first < end; first += kBlock) {
      const std::size_t count = std::min(kBlock, end - first);
      if (drawing.object->baked) {
        std::copy_n(arrays.indirectR.data() + first, count, indirect.r.data());
        std::copy_n(arrays.indirectG.data() + first, count, indirect.g.data());
        std::copy_n(arrays.indirectB.data() + first, count, indirect.b.data());
      } else {
        addAmbient(arrays, first, count, light, indirect);
      }
      for (std::size_t i = 0; i < static_cast<std::size_t>(drawing.lamps.count); ++i) {
        addLamp(arrays, first, count, light.lamps[i], drawing.lamps.colour[i], light.metre, indirect);
      }
      sendToEye(arrays, first, count, drawing, light, indirect, out.data() + first);
    }
  }
}

}  // namespace grove::objects::mesh
