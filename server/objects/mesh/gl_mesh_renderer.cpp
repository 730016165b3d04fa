#include "objects/mesh/gl_mesh_renderer.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "objects/mesh/gl_surface.h"
#include "objects/mesh/shading.h"
#include "objects/mesh/tile_packer.h"
#include "objects/mesh/view_depth.h"

namespace grove::objects::mesh {
namespace {

// Small enough for the cache that software GL draws in; larger ones are for larger tiles only.
constexpr int kAtlasWidth = 1024;
constexpr int kAtlasHeight = 384;
constexpr std::size_t kMostAtlases = 6;
constexpr float kLeastCosine = 0.6F;

int roundedUp(int pixels) { return (pixels + 255) / 256 * 256; }

/// World to clip space of a tile. Window y grows downwards, so that rows are read back from the top, and depth is
/// near / view depth: reversed, without a far end, and evenly precise in floats (Reed 2015, "Depth Precision
/// Visualized").
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

struct Pass {
  Pass(const gl::Workers::Local& local, const char* fragment)
      : program(local.api, local.shaders.load("mesh/mesh.vert"), local.shaders.load(fragment)),
        clip(program.uniform("clip")),
        bones(program.uniform("bones")),
        eye(program.uniform("eye")),
        tint(program.uniform("tint")),
        sunShare(program.uniform("sunShare")),
        baked(program.uniform("baked")),
        lampCount(program.uniform("lampCount")),
        lampPosition(program.uniform("lampPosition")),
        lampColour(program.uniform("lampColour")),
        pixelsPerMetre(program.uniform("pixelsPerMetre")) {}
  gl::Program program;
  GLint clip;
  GLint bones;
  GLint eye;
  GLint tint;
  GLint sunShare;
  GLint baked;
  GLint lampCount;
  GLint lampPosition;
  GLint lampColour;
  GLint pixelsPerMetre;
};

/// False if even the nearest point is too far for it. Towards the frame's corners depth is less than distance.
bool showsFineDetail(const Drawing& drawing) {
  return drawing.camera->focal() > 3.0F * kFineDetail * kLeastCosine * (drawing.distance - drawing.reach);
}

}  // namespace

/// One worker's program, buffers and atlases.
class GlMeshRenderer::Bench {
 public:
  explicit Bench(const gl::Workers::Local& local)
      : api_(local.api), near_(local, "mesh/mesh.frag"), far_(local, "mesh/mesh_far.frag") {}

  /// Draws from `order[first]` on as many as one atlas holds; returns the next that is left.
  std::size_t renderSome(std::span<const Drawing> drawings, std::span<const std::size_t> order, std::size_t first,
                         node::ImagePool& pool, std::span<std::shared_ptr<const node::Image>> images) {
    const Drawing& tallest = drawings[order[first]];
    int widest = 0;
    for (const std::size_t i : order.subspan(first)) widest = std::max(widest, drawings[i].rect.width());
    const int width = std::max(kAtlasWidth, roundedUp(widest));
    const int height = std::max(kAtlasHeight, roundedUp(tallest.rect.height()));
    TilePacker packer(width, height);
    std::vector<world::Rect> tiles;
    for (std::size_t i = first; i < order.size(); ++i) {
      const world::Rect& rect = drawings[order[i]].rect;
      const std::optional<world::Rect> tile = packer.place(rect.width(), rect.height());
      if (!tile) break;
      tiles.push_back(*tile);
    }
    prepare(atlasFor(width, height));
    for (std::size_t i = 0; i < tiles.size(); ++i) draw(drawings[order[first + i]], tiles[i]);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const std::size_t which = order[first + i];
      images[which] = readBack(drawings[which], tiles[i], pool);
    }
    return first + tiles.size();
  }

 private:
  gl::Framebuffer& atlasFor(int width, int height) {
    const auto it = atlases_.find({width, height});
    if (it != atlases_.end()) return it->second;
    if (atlases_.size() >= kMostAtlases) atlases_.clear();
    return atlases_.try_emplace({width, height}, api_, width, height).first->second;
  }

  void prepare(const gl::Framebuffer& atlas) {
    constexpr std::array<float, 4> kNothing = {0.0F, 0.0F, 0.0F, 0.0F};
    atlas.bind();
    api_.Disable(GL_SCISSOR_TEST);
    api_.ClearNamedFramebufferfv(atlas.name(), GL_COLOR, 0, kNothing.data());
    api_.ClearNamedFramebufferfv(atlas.name(), GL_DEPTH, 0, kNothing.data());
    api_.Enable(GL_SCISSOR_TEST);
    api_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    api_.Enable(GL_DEPTH_TEST);
    api_.DepthFunc(GL_GREATER);
    api_.Enable(GL_CULL_FACE);
    api_.CullFace(GL_BACK);
    api_.FrontFace(GL_CW);  // the picture is upside down to GL
  }

  void draw(const Drawing& drawing, const world::Rect& tile) {
    const world::Camera& camera = *drawing.camera;
    const LitSurface& object = *drawing.object;
    api_.Viewport(tile.left, tile.top, tile.width(), tile.height());
    api_.Scissor(tile.left, tile.top, tile.width(), tile.height());
    const world::Mat4 clip = clipMatrix(camera, drawing.rect);
    const float focal = camera.focal();
    const Pass& pass = showsFineDetail(drawing) ? near_ : far_;
    pass.program.use();
    api_.UniformMatrix4fv(pass.clip, 1, GL_FALSE, &clip[0][0]);
    api_.UniformMatrix4fv(pass.bones, static_cast<GLsizei>(kMostBones), GL_FALSE, &drawing.bones[0][0][0]);
    api_.Uniform3fv(pass.eye, 1, &camera.pose.position.x);
    api_.Uniform3fv(pass.tint, 1, &drawing.tint.x);
    api_.Uniform1f(pass.sunShare, drawing.sunShare);
    api_.Uniform1f(pass.baked, object.baked ? 1.0F : 0.0F);
    api_.Uniform1f(pass.pixelsPerMetre, focal);
    api_.Uniform1i(pass.lampCount, drawing.lamps.count);
    if (drawing.lamps.count > 0) {
      api_.Uniform3fv(pass.lampPosition, drawing.lamps.count, &drawing.lamps.position[0].x);
      api_.Uniform3fv(pass.lampColour, drawing.lamps.count, &drawing.lamps.colour[0].x);
    }
    auto it = surfaces_.find(&object);
    if (it == surfaces_.end()) it = surfaces_.try_emplace(&object, api_, object).first;
    it->second.draw(object.surface.levelFor(drawing.distance, focal));
  }

  /// Each tile straight into its image: software GL copies no byte twice that way.
  [[nodiscard]] std::shared_ptr<const node::Image> readBack(const Drawing& drawing, const world::Rect& tile,
                                                            node::ImagePool& pool) const {
    const std::shared_ptr<node::Image> image = pool.acquire(drawing.rect);
    const int width = tile.width();
    const int height = tile.height();
    api_.ReadPixels(tile.left, tile.top, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image->colour.data());
    api_.ReadPixels(tile.left, tile.top, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, image->depth.data());
    toViewDepth(image->depth, drawing.camera->nearDepth);
    return image;
  }

  const gl::Api& api_;
  Pass near_;
  Pass far_;
  std::map<std::pair<int, int>, gl::Framebuffer> atlases_;
  std::map<const LitSurface*, GlSurface> surfaces_;
};

GlMeshRenderer::GlMeshRenderer(gl::Workers& workers, node::ImagePool& images)
    : workers_(workers), images_(images), benches_(static_cast<std::size_t>(workers.width())) {}

GlMeshRenderer::~GlMeshRenderer() {
  workers_.runOnEach([this](gl::Workers::Local& local) { benches_[static_cast<std::size_t>(local.index)].reset(); });
}

void GlMeshRenderer::render(std::span<const Drawing> drawings, std::span<std::shared_ptr<const node::Image>> images) {
  const gl::Workers::Local& local = gl::Workers::local();
  std::unique_ptr<Bench>& bench = benches_[static_cast<std::size_t>(local.index)];
  if (!bench) bench = std::make_unique<Bench>(local);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    if (!drawings[i].rect.empty()) order.push_back(i);
  }
  std::ranges::sort(
      order, [&](std::size_t a, std::size_t b) { return drawings[a].rect.height() > drawings[b].rect.height(); });
  for (std::size_t next = 0; next < order.size();) next = bench->renderSome(drawings, order, next, images_, images);
}

}  // namespace grove::objects::mesh
