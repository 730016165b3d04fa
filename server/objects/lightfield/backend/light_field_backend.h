#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "node/backend/backend_half.h"
#include "objects/lightfield/backend/light_field_options.h"
#include "objects/lightfield/backend/object_pictures.h"
#include "objects/lightfield/backend/picture_budget.h"

namespace grove::objects::lightfield {

/// The rendering node of all light fields. Answers with what a light field is, with the picture of a cell of eyes that
/// all visitors share, or with one for a single visitor's camera; and that there is no time for it, if visitors
/// together have asked for more pictures than the machine makes.
class LightFieldBackend final : public node::BackendHalf {
 public:
  /// Takes its time, as ObjectPictures does.
  LightFieldBackend(const node::BackendServices& services, world::TypeIndex self, const LightFieldOptions& options);
  ~LightFieldBackend() override;

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  [[nodiscard]] pipeline::Executor& executor() override { return pictures_.executor(); }
  [[nodiscard]] int concurrency() const override { return pictures_.executor().width(); }
  [[nodiscard]] std::size_t maxAtOnce() const override;
  /// Each step permits pictures less error. Those of other steps are shown on as long as they serve.
  void setQuality(int step) override;
  /// On the executor; safe to call from several of its threads at once.
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

  /// What the new pictures of all visitors together may have where so many cores make them.
  [[nodiscard]] static double texelsPerSecond(int cores) noexcept;

 private:
  [[nodiscard]] node::Payload answerOne(const node::Request& request);
  [[nodiscard]] node::Payload info(const LightFieldModel& model) const;
  [[nodiscard]] node::Payload sharedPicture(const node::Request& request, const ObjectPictures::Entry& entry);
  [[nodiscard]] node::Payload ownPicture(const node::Request& request, const ObjectPictures::Entry& entry);
  [[nodiscard]] node::Payload framePicture(const node::Request& request, const ObjectPictures::Entry& entry);
  /// Whether the picture is to be made; takes its texels from the budget.
  [[nodiscard]] bool mayMake(const node::Request& request, const Shot& shot, bool mustBeMade);
  void announceInfo();

  pipeline::Timeline& timeline_;
  pipeline::MemoryLedger& memory_;
  const std::function<void(const node::Announcement&)> announce_;
  const LightFieldOptions options_;
  std::atomic<float> maxError_;
  std::atomic<node::Version> infoVersion_{1};
  ObjectPictures pictures_;
  PictureBudget budget_;
  std::vector<std::shared_ptr<const void>> listeners_;  ///< to the models, the last to come and the first to go
};

}  // namespace grove::objects::lightfield
