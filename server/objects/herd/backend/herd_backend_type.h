#pragma once

#include "node/backend/backend_half.h"

namespace grove::objects::herd {

/// Options of all herds of a scene, `[types.herd]`.
struct HerdOptions final : node::TypeOptions {
  int variants = 1;  ///< how often the motion database repeats each clip with other speeds, phases and glances
};

/// `type = "herd"`: animals (1 to 64), range (metres), seed.
class HerdBackendType final : public node::BackendType {
 public:
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] std::shared_ptr<const node::TypeOptions> options(const world::Parameters& parameters) const override;
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex self) const override;
};

}  // namespace grove::objects::herd
