#include "objects/lightfield/backend/shader/shader_sampler.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "gl/framebuffer.h"
#include "gl/program.h"
#include "objects/lightfield/backend/shader/gl_field_cache.h"

namespace grove::objects::lightfield {
namespace {

constexpr GLuint kRequestBinding = 0;
// Rows of a target before the next round; a taller picture gets its own target.
constexpr int kMaxRows = 4096;
constexpr int kStep = 256;      // pixels: targets grow in these steps
constexpr float kNear = 0.02F;  // same as in sample.frag

/// Same as in shaders/lightfield/request.glsl.
struct Request {
  world::Vec4 eye;
  world::Vec4 corner;
  world::Vec4 perColumn;
  world::Vec4 perRow;
  world::Vec4 low;
  world::Vec4 high;
  world::Vec4 centre;
  world::Vec4 target;
  world::Vec4 haze;
  std::int32_t subdivision;
  std::int32_t size;
  std::int32_t firstEntry;
  std::int32_t blocksAcross;
  std::int32_t top;
  std::int32_t corrected;
  std::int32_t padding[2];
};
static_assert(sizeof(Request) % sizeof(world::Vec4) == 0, "std140");

world::Vec4 padded(world::Vec3 v) { return {v, 0.0F}; }

Request requestFor(const SampleRequest& asked, const world::Rect& rect, int top, DepthCorrection correction) {
  const LightField& field = *asked.field;
  const auto level = static_cast<std::size_t>(asked.level);
  std::size_t firstEntry = 0;
  for (std::size_t l = 0; l < level; ++l) firstEntry += field.blocks[l].size();
  const auto& haze = asked.haze;
  return {padded(asked.camera.eye),
          padded(asked.camera.ray(static_cast<float>(rect.left), static_cast<float>(rect.top))),
          padded(asked.camera.perColumn),
          padded(asked.camera.perRow),
          padded(field.bounds.low),
          padded(field.bounds.high),
          {field.geometry.centre, field.geometry.radius},
          padded(field.geometry.target),
          {haze.colour[0], haze.colour[1], haze.colour[2], haze.amount},
          field.sphere.subdivision(),
          field.size >> asked.level,
          static_cast<std::int32_t>(firstEntry),
          field.blocksAcross(asked.level),
          top,
          correction == DepthCorrection::kOn ? 1 : 0,
          {}};
}

int roundedUp(int pixels) { return (pixels + kStep - 1) / kStep * kStep; }

}  // namespace

/// One worker's program, target and textures.
class ShaderSampler::Target {
 public:
  Target(const gl::Workers::Local& local, DepthCorrection correction, std::size_t maxBytes,
         pipeline::MemoryLedger* memory)
      : api_(local.api),
        correction_(correction),
        program_(local.api, local.shaders.load("lightfield/sample.vert"), local.shaders.load("lightfield/sample.frag")),
        noVertices_(local.api),
        request_(local.api),
        fields_(local.api, maxBytes) {
    if (memory != nullptr) held_.emplace(*memory, "textures", "lightfield", pipeline::Work::kAcrossUser);
  }

  /// Renders pictures until the target is full; returns their number.
  std::size_t renderSome(std::span<const SampleRequest> requests, std::span<raster::Image* const> images) {
    std::size_t count = 0;
    int width = 1;
    int height = 0;
    std::vector<int> tops;
    for (; count < images.size() && (count == 0 || height + images[count]->height() <= kMaxRows); ++count) {
      tops.push_back(height);
      width = std::max(width, images[count]->width());
      height += images[count]->height();
    }
    prepare(width, height);
    for (std::size_t i = 0; i < count; ++i) draw(requests[i], images[i]->rect, tops[i]);
    for (std::size_t i = 0; i < count; ++i) readBack(*images[i], tops[i]);
    if (held_) held_->set(fields_.bytes() + target_->bytes());
    return count;
  }

 private:
  void prepare(int width, int height) {
    if (!target_ || target_->width() < width || target_->height() < height) {
      const int wide = std::max(roundedUp(width), target_ ? target_->width() : 0);
      const int tall = std::max(roundedUp(std::max(height, 1)), target_ ? target_->height() : 0);
      target_.reset();
      target_.emplace(api_, wide, tall);
    }
    target_->bind();
    api_.Disable(GL_SCISSOR_TEST);
    api_.Disable(GL_CULL_FACE);
    api_.Enable(GL_DEPTH_TEST);
    api_.DepthFunc(GL_ALWAYS);
    api_.BindVertexArray(noVertices_.name());
    program_.use();
  }

  void draw(const SampleRequest& asked, const world::Rect& rect, int top) {
    if (rect.empty()) return;
    fields_.bind(*asked.field, asked.lighting);
    const Request request = requestFor(asked, rect, top, correction_);
    api_.NamedBufferData(request_.name(), sizeof request, &request, GL_STREAM_DRAW);
    api_.BindBufferBase(GL_UNIFORM_BUFFER, kRequestBinding, request_.name());
    api_.Viewport(0, top, rect.width(), rect.height());
    api_.DrawArrays(GL_TRIANGLES, 0, 3);
  }

  void readBack(raster::Image& image, int top) const {
    if (image.rect.empty()) return;
    api_.ReadPixels(0, top, image.width(), image.height(), GL_RGBA, GL_UNSIGNED_BYTE, image.colour.data());
    api_.ReadPixels(0, top, image.width(), image.height(), GL_DEPTH_COMPONENT, GL_FLOAT, image.depth.data());
    for (float& depth : image.depth) depth = depth > 0.0F ? kNear / depth : world::kInfiniteDepth;
  }

  const gl::Api& api_;
  const DepthCorrection correction_;
  gl::Program program_;
  gl::VertexArray noVertices_;
  gl::Buffer request_;
  GlFieldCache fields_;
  std::optional<gl::Framebuffer> target_;
  std::optional<pipeline::HeldMemory> held_;
};

ShaderSampler::ShaderSampler(gl::Workers& workers, DepthCorrection correction, std::size_t maxBytes)
    : workers_(workers),
      correction_(correction),
      maxBytes_(maxBytes),
      targets_(static_cast<std::size_t>(workers.width())) {}

ShaderSampler::ShaderSampler(gl::Workers& workers, pipeline::MemoryLedger& memory) : ShaderSampler(workers) {
  memory_ = &memory;
}

ShaderSampler::~ShaderSampler() {
  workers_.runOnEach([this](gl::Workers::Local& local) { targets_[static_cast<std::size_t>(local.index)].reset(); });
}

void ShaderSampler::render(std::span<const SampleRequest> requests, std::span<raster::Image* const> images) {
  assert(requests.size() == images.size());
  const gl::Workers::Local& local = gl::Workers::local();
  std::unique_ptr<Target>& target = targets_[static_cast<std::size_t>(local.index)];
  if (!target) target = std::make_unique<Target>(local, correction_, maxBytes_, memory_);
  while (!requests.empty()) {
    const std::size_t done = target->renderSome(requests, images);
    requests = requests.subspan(done);
    images = images.subspan(done);
  }
}

}  // namespace grove::objects::lightfield
