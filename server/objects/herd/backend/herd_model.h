#pragma once

#include <cstdint>

#include "world/object.h"

namespace grove::objects::herd {

/// Settings of one herd in a scene file.
struct HerdSettings {
  int animals = 8;
  float range = 14.0F;  ///< metres around the object's position within which the herd stays, unless it is chased
  int seed = 1;
};

/// A herd of fallow deer.
class HerdModel final : public world::Model {
 public:
  explicit HerdModel(const HerdSettings& settings) : settings_(settings) {}

  /// Encloses animals that are chased out of their range, too.
  [[nodiscard]] world::Bounds bounds() const override;
  [[nodiscard]] const HerdSettings& settings() const noexcept { return settings_; }

 private:
  const HerdSettings settings_;
};

}  // namespace grove::objects::herd
