#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "node/backend/backend_half.h"
#include "objects/lightfield/backend/light_field_options.h"
#include "objects/lightfield/backend/object_pictures.h"
#include "objects/lightfield/backend/picture_budget.h"

namespace grove::objects::lightfield {

/// The rendering node of all light fields. Returns a light field's description, the picture of a cell of eyes that all
/// visitors share, or a picture for one visitor's camera. Refuses pictures when all visitors together have spent the
/// machine's budget.
class LightFieldBackend final : public node::BackendHalf {
 public:
  /// Slow, like ObjectPictures' constructor.
  LightFieldBackend(const node::BackendServices& services, world::TypeIndex self, const LightFieldOptions& options);
  ~LightFieldBackend() override;

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return pictures_.executor(); }
  [[nodiscard]] int concurrency() const override { return pictures_.executor().width(); }
  [[nodiscard]] std::size_t maxAtOnce() const override;
  /// Each step permits pictures less error. Pictures of other steps stay in use as long as they are good enough.
  void setQuality(int step) override;
  /// On the executor; several of its threads may call it at once.
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

  /// Budget for the new pictures of all visitors together on this many cores.
  [[nodiscard]] static double texelsPerSecond(int cores) noexcept;

 private:
  [[nodiscard]] node::Payload answerOne(const node::Request& request);
  [[nodiscard]] node::Payload info(const LightFieldModel& model) const;
  [[nodiscard]] node::Payload sharedPicture(const node::Request& request, const ObjectPictures::Entry& entry);
  [[nodiscard]] node::Payload ownPicture(const node::Request& request, const ObjectPictures::Entry& entry);
  [[nodiscard]] node::Payload framePicture(const node::Request& request, const ObjectPictures::Entry& entry);
  /// Whether to make the picture; takes its texels from the budget.
  [[nodiscard]] bool mayMake(const node::Request& request, std::int64_t texels, bool mustBeMade);
  void announceInfo();

  pipeline::Timeline& timeline_;
  pipeline::MemoryLedger& memory_;
  const std::function<void(const node::Announcement&)> announce_;
  const LightFieldOptions options_;
  std::atomic<float> maxError_;
  std::atomic<node::Version> infoVersion_{1};
  ObjectPictures pictures_;
  PictureBudget budget_;
  std::vector<std::shared_ptr<const void>> listeners_;  ///< to the models; constructed last, destroyed first
};

}  // namespace grove::objects::lightfield
