#pragma once

#include "node/backend/backend_half.h"
#include "objects/sky/common/panorama.h"

namespace grove::objects::sky {

/// The sky with the landscape at the horizon: a panorama that is painted once and shown behind everything.
///
/// Scene file: `type = "sky"`, `seed` (integer, 0 to 1,000,000): each seed is a different evening.
class SkyBackendType final : public node::BackendType {
 public:
  /// Smaller panoramas bake faster.
  explicit SkyBackendType(PanoramaSize size = {}) : size_(size) {}

  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] bool needsAllModels() const override { return false; }
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex self) const override;

 private:
  const PanoramaSize size_;
};

}  // namespace grove::objects::sky
