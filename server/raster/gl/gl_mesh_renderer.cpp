#include "raster/gl/gl_mesh_renderer.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "raster/gl/gl_surface.h"
#include "raster/gl/tile_packer.h"
#include "raster/outline/outline.h"
#include "raster/shading/vertex_light.h"

namespace grove::raster {
namespace {

// Fits the cache in which software GL draws; atlases grow only for larger tiles.
constexpr int kAtlasWidth = 1024;
constexpr int kAtlasHeight = 384;
constexpr int kAtlasStep = 64;  // pixels: clears no more than needed
constexpr std::size_t kMaxAtlases = 16;

int roundedUp(int pixels, int step) { return (pixels + step - 1) / step * step; }

/// World to clip space of a tile. Window y grows downwards, so that rows are read back from the top. Depth is near /
/// view depth: reversed, without a far plane, and evenly precise in floats (Reed 2015, "Depth Precision Visualized").
world::Mat4 clipMatrix(const world::Camera& camera, const world::Rect& rect) {
  const float focal = camera.focal();
  const auto width = static_cast<float>(rect.width());
  const auto height = static_cast<float>(rect.height());
  const float middleX = static_cast<float>(camera.width) - static_cast<float>(rect.left + rect.right);
  const float middleY = static_cast<float>(camera.height) - static_cast<float>(rect.top + rect.bottom);
  const world::Vec3 f = camera.pose.forward();
  const world::Vec3 x = camera.pose.right() * (2.0F * focal / width) + f * (middleX / width);
  const world::Vec3 y = camera.pose.up() * (-2.0F * focal / height) + f * (middleY / height);
  const world::Vec3 eye = camera.pose.position;
  const world::Mat4 rows(world::Vec4(x, -glm::dot(x, eye)), world::Vec4(y, -glm::dot(y, eye)),
                         world::Vec4(0.0F, 0.0F, 0.0F, camera.nearDepth), world::Vec4(f, -glm::dot(f, eye)));
  return glm::transpose(rows);
}

}  // namespace

/// One worker's program, buffers and atlases.
class GlMeshRenderer::Target {
 public:
  Target(const gl::Workers::Local& local, const MeshMemory& memory)
      : api_(local.api),
        program_(local.api, local.shaders.load("mesh/mesh.vert"), local.shaders.load("mesh/mesh.frag")),
        toClip_(program_.uniform("toClip")),
        lightBuffer_(local.api),
        held_(memory.held("buffers")) {}

  /// Draws `order[first]` and the following ones that fit one atlas; returns the index of the next.
  std::size_t renderSome(std::span<const Drawing> drawings, std::span<const std::size_t> order, std::size_t first,
                         const DetailTexture& texture, ImagePool& pool, std::span<std::shared_ptr<Image>> images) {
    const Drawing& tallest = drawings[order[first]];
    int widest = 0;
    for (const std::size_t i : order.subspan(first)) widest = std::max(widest, drawings[i].rect.width());
    const int width = std::max(kAtlasWidth, roundedUp(widest, 256));
    const int height = std::max(kAtlasHeight, roundedUp(tallest.rect.height(), kAtlasStep));
    TilePacker packer(width, height);
    std::vector<world::Rect> tiles;
    for (std::size_t i = first; i < order.size(); ++i) {
      const world::Rect& rect = drawings[order[i]].rect;
      const std::optional<world::Rect> tile = packer.place(rect.width(), rect.height());
      if (!tile) break;
      tiles.push_back(*tile);
    }
    const std::span<const std::size_t> batch = order.subspan(first, tiles.size());
    const std::vector<std::size_t> lights = light(drawings, batch);
    prepare(atlasFor(width, std::min(height, roundedUp(packer.bottom(), kAtlasStep))));
    for (std::size_t i = 0; i < tiles.size(); ++i) draw(drawings[batch[i]], tiles[i], lights[i]);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const Drawing& drawing = drawings[batch[i]];
      const std::shared_ptr<Image> image = pool.acquire(drawing.rect);
      screenSurface_.make(drawing, surfaceOf(*drawing.object).arrays());
      outline_.find(drawing, screenSurface_);
      outline_.finish(readBack(tiles[i]), drawing, texture, *image);
      images[batch[i]] = image;
    }
    held_.set(bytes());
    return first + tiles.size();
  }

 private:
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 2 * pipeline::vectorBytes(light_) + pipeline::vectorBytes(surface_, depth_) +
                      screenSurface_.bytes() + outline_.bytes();
    for (const auto& [size, atlas] : atlases_) sum += atlas.bytes();
    for (const auto& [object, surface] : surfaces_) sum += surface.bytes();
    return sum;
  }

  gl::Framebuffer& atlasFor(int width, int height) {
    const auto it = atlases_.find({width, height});
    if (it != atlases_.end()) return it->second;
    if (atlases_.size() >= kMaxAtlases) atlases_.clear();
    return atlases_.try_emplace({width, height}, api_, width, height).first->second;
  }

  void prepare(const gl::Framebuffer& atlas) {
    constexpr float kFarthest = 0.0F;
    atlas.bind();
    api_.Disable(GL_SCISSOR_TEST);
    // Depth alone marks covered pixels, so colour needs no clearing.
    api_.ClearNamedFramebufferfv(atlas.name(), GL_DEPTH, 0, &kFarthest);
    api_.Enable(GL_SCISSOR_TEST);
    api_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    api_.Enable(GL_DEPTH_TEST);
    api_.DepthFunc(GL_GREATER);
    api_.Enable(GL_CULL_FACE);
    api_.CullFace(GL_BACK);
    api_.FrontFace(GL_CW);  // GL draws the picture upside down
    program_.use();
  }

  [[nodiscard]] const GlSurface& surfaceOf(const LitSurface& object) {
    const auto it = surfaces_.find(&object);
    return it != surfaces_.end() ? it->second : surfaces_.try_emplace(&object, api_, object).first->second;
  }

  static const Level& levelOf(const Drawing& drawing) {
    return drawing.object->surface.levelFor(drawing.distance, drawing.camera->focal());
  }

  /// Lights the vertices of all drawings at once, because one upload per drawing would be expensive. Returns each
  /// drawing's offset in bytes.
  [[nodiscard]] std::vector<std::size_t> light(std::span<const Drawing> drawings, std::span<const std::size_t> batch) {
    std::vector<std::size_t> starts;
    std::size_t total = 0;
    for (const std::size_t i : batch) {
      starts.push_back(total * sizeof(std::uint32_t));
      total += levelOf(drawings[i]).vertexCount;
    }
    light_.resize(total);
    std::span<std::uint32_t> rest = light_;
    for (const std::size_t i : batch) {
      const std::size_t count = levelOf(drawings[i]).vertexCount;
      lightVertices(surfaceOf(*drawings[i].object).arrays(), drawings[i], rest.first(count));
      rest = rest.subspan(count);
    }
    api_.NamedBufferData(lightBuffer_.name(), static_cast<GLsizeiptr>(total * sizeof(std::uint32_t)), light_.data(),
                         GL_STREAM_DRAW);
    return starts;
  }

  void draw(const Drawing& drawing, const world::Rect& tile, std::size_t firstLight) {
    api_.Viewport(tile.left, tile.top, tile.width(), tile.height());
    api_.Scissor(tile.left, tile.top, tile.width(), tile.height());
    const world::Mat4 clip = clipMatrix(*drawing.camera, drawing.rect);
    const GlSurface& surface = surfaceOf(*drawing.object);
    // Most surfaces have few bones: products and uploads for the others would cost several times as much.
    const auto bones = std::span(drawing.bones).first(surface.arrays().bones);
    std::array<world::Mat4, kMaxBones> toClip;
    std::ranges::transform(bones, toClip.begin(), [&](const world::Mat4& bone) { return clip * bone; });
    api_.UniformMatrix4fv(toClip_, static_cast<GLsizei>(bones.size()), GL_FALSE, &toClip[0][0][0]);
    surface.draw(levelOf(drawing), lightBuffer_, firstLight);
  }

  /// Valid until the next call.
  [[nodiscard]] OpenFragments readBack(const world::Rect& tile) {
    const int width = tile.width();
    const int height = tile.height();
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) + kFragmentRoom;
    surface_.resize(std::max(surface_.size(), pixels));
    depth_.resize(std::max(depth_.size(), pixels));
    api_.ReadPixels(tile.left, tile.top, width, height, GL_RGBA, GL_UNSIGNED_BYTE, surface_.data());
    api_.ReadPixels(tile.left, tile.top, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depth_.data());
    return {surface_.data(), depth_.data(), width, {}};
  }

  const gl::Api& api_;
  gl::Program program_;
  GLint toClip_;
  gl::Buffer lightBuffer_;
  std::vector<std::uint32_t> light_;
  std::vector<std::uint32_t> surface_;
  std::vector<float> depth_;
  ScreenSurface screenSurface_;
  Outline outline_;
  std::map<std::pair<int, int>, gl::Framebuffer> atlases_;
  std::map<const LitSurface*, GlSurface> surfaces_;
  pipeline::HeldMemory held_;
};

GlMeshRenderer::GlMeshRenderer(gl::Workers& workers, ImagePool& images, const MeshMemory& memory)
    : workers_(workers), images_(images), memory_(memory), targets_(static_cast<std::size_t>(workers.width())) {}

GlMeshRenderer::~GlMeshRenderer() {
  workers_.runOnEach([this](gl::Workers::Local& local) { targets_[static_cast<std::size_t>(local.index)].reset(); });
}

void GlMeshRenderer::render(std::span<const Drawing> drawings, std::span<std::shared_ptr<Image>> images) {
  const gl::Workers::Local& local = gl::Workers::local();
  std::unique_ptr<Target>& target = targets_[static_cast<std::size_t>(local.index)];
  if (!target) target = std::make_unique<Target>(local, memory_);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    if (!drawings[i].rect.empty()) order.push_back(i);
  }
  std::ranges::sort(
      order, [&](std::size_t a, std::size_t b) { return drawings[a].rect.height() > drawings[b].rect.height(); });
  for (std::size_t next = 0; next < order.size();)
    next = target->renderSome(drawings, order, next, texture_, images_, images);
}

}  // namespace grove::raster
