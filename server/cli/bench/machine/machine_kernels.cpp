#include "cli/bench/machine/machine_kernels.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "node/frontend/backdrops/backdrop.h"
#include "node/frontend/backdrops/backdrop_warp.h"
#include "objects/fluid/backend/simulation/fluid_simulation.h"
#include "raster/simd/simd_mesh_renderer.h"
#include "stream/encode/jpeg/jpeg_encoder.h"

namespace grove::cli {
namespace {

using objects::fluid::FluidSimulation;
using world::Vec3;

constexpr world::Rect kFrame{0, 0, 1280, 720};

class NoObstacles final : public world::VoxelObstacles {
 public:
  [[nodiscard]] std::vector<std::uint8_t> solidCells(const world::Cube& cube) const override { return filled(cube, 0); }
  [[nodiscard]] std::vector<std::uint8_t> sunlitCells(const world::Cube& cube, Vec3 /*towardsSun*/) const override {
    return filled(cube, 1);
  }

 private:
  [[nodiscard]] static std::vector<std::uint8_t> filled(const world::Cube& cube, std::uint8_t value) {
    const auto cells = static_cast<std::size_t>(cube.cells);
    return std::vector<std::uint8_t>(cells * cells * cells, value);
  }
};

MachineKernel fluidStep() {
  constexpr int kGrowingSteps = 60;
  struct Fire {
    NoObstacles obstacles;
    world::Sky sky;
    FluidSimulation simulation{objects::fluid::FluidSettings(), Vec3(0.0F), obstacles, sky};
  };
  const auto fire = std::make_shared<Fire>();
  for (int i = 0; i < kGrowingSteps; ++i) fire->simulation.step(FluidSimulation::kTick, {}, {});
  return {"fluid", 14.0, [fire] { fire->simulation.step(FluidSimulation::kTick, {}, {}); }};
}

/// A ball with bumps of all sizes.
raster::LitSurface bumpyBall() {
  raster::Surface ball = raster::makeDeformedBox({12, 12, 12}, 3, [](Vec3 cube) {
    const Vec3 direction = glm::normalize(cube);
    const float bumps = std::sin(9.0F * direction.x) * std::sin(11.0F * direction.y) + std::sin(31.0F * direction.z);
    raster::Vertex vertex;
    vertex.position = (1.0F + 0.05F * bumps) * direction;
    return vertex;
  });
  ball.computeNormals();
  ball.weathered = true;
  const std::size_t count = ball.vertices.size();
  return {std::move(ball), std::vector<world::Vec4>(count, world::Vec4(0.8F, 0.3F, 0.4F, 0.5F)), true};
}

MachineKernel triangles() {
  struct Stone {
    Stone() {
      camera.pose.position = {0.0F, 0.0F, 3.0F};
      drawing.object = &ball;
      drawing.camera = &camera;
      drawing.sky = &sky;
      drawing.rect = kFrame;
      drawing.distance = 2.0F;
      drawing.bones.fill(world::Mat4(1.0F));
    }
    const raster::LitSurface ball = bumpyBall();
    const world::Sky sky;
    world::Camera camera;
    raster::Drawing drawing;
    pipeline::MemoryLedger memory;
    raster::ImagePool images;
    raster::SimdMeshRenderer renderer{images, {memory, "mesh"}};
  };
  const auto stone = std::make_shared<Stone>();
  return {"triangles", 4.8, [stone] {
            std::shared_ptr<raster::Image> image;
            stone->renderer.render({&stone->drawing, 1}, {&image, 1});
          }};
}

/// Hills with stripes under a sky, as colour and depth.
std::shared_ptr<raster::Image> landscape(raster::ImagePool& images) {
  auto image = images.acquire(kFrame);
  for (int y = 0; y < image->height(); ++y) {
    for (int x = 0; x < image->width(); ++x) {
      const auto across = static_cast<float>(x);
      const float hills = 260.0F + 40.0F * std::sin(across / 70.0F) + 15.0F * std::sin(across / 17.0F);
      const float below = static_cast<float>(y) - hills;
      const auto wave = [](float phase) { return static_cast<std::uint32_t>(127.5F + 100.0F * std::sin(phase)); };
      image->colourRow(y)[x] =
          0xFF000000U | wave(across / 3.0F) << 16U | wave(below / 5.0F) << 8U | wave((across + below) / 11.0F);
      image->depthRow(y)[x] = below < 0.0F ? world::kInfiniteDepth : 900.0F / (below + 10.0F);
    }
  }
  return image;
}

MachineKernel backdropWarp() {
  struct Frame {
    Frame() {
      const auto image = landscape(images);
      node::BackdropDepths depths(kFrame, images);
      depths.measure(*image);
      auto colours = raster::acquireSemiPlanar(images, kFrame);
      raster::toSemiPlanar(*image, *colours);
      backdrop.emplace(std::move(colours), std::move(depths), node::Backdrop::Origin{std::make_shared<node::View>()});
      camera.pose.position += Vec3(0.2F, 0.0F, -0.3F);
    }
    raster::ImagePool images;
    std::optional<node::Backdrop> backdrop;
    world::Camera camera;
    const std::shared_ptr<raster::YuvImage> picture = raster::acquireYuv(images, kFrame);
    const std::shared_ptr<raster::Image> layers = images.acquire(kFrame);
    node::CellNearness nearness{kFrame.width(), kFrame.height(), images};
    const node::FreshParts fresh{kFrame, std::vector<world::Rect>{}};
  };
  const auto frame = std::make_shared<Frame>();
  return {"warp", 1.33, [frame] {
            node::BackdropWarp(*frame->backdrop, frame->camera)
                .fill(kFrame.top, kFrame.bottom, frame->fresh, {*frame->picture, *frame->layers, frame->nearness});
          }};
}

MachineKernel colours() {
  struct Conversion {
    raster::ImagePool images;
    const std::shared_ptr<raster::Image> image = landscape(images);
    const std::shared_ptr<raster::YuvImage> picture = raster::acquireYuv(images, kFrame);
  };
  const auto conversion = std::make_shared<Conversion>();
  return {"colours", 0.34, [conversion] { raster::toYuv(*conversion->image, kFrame, *conversion->picture); }};
}

MachineKernel jpeg() {
  struct Encoding {
    Encoding() { raster::toYuv(*landscape(images), kFrame, *picture); }
    raster::ImagePool images;
    const std::shared_ptr<raster::YuvImage> picture = raster::acquireYuv(images, kFrame);
    stream::JpegEncoder encoder{75};
    std::vector<std::uint8_t> bytes;
  };
  const auto encoding = std::make_shared<Encoding>();
  return {"jpeg", 2.8, [encoding] {
            encoding->bytes.clear();
            encoding->encoder.encode(*encoding->picture, {}, encoding->bytes);
          }};
}

}  // namespace

std::vector<MachineKernel> machineKernels() { return {fluidStep(), triangles(), backdropWarp(), colours(), jpeg()}; }

}  // namespace grove::cli
