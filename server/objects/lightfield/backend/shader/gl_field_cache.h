#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "objects/lightfield/backend/shader/gl_light_field.h"

namespace grove::objects::lightfield {

/// Light fields as textures of one GL context. Evicts the least recently drawn ones when space runs out, and unused
/// ones when a new one arrives.
class GlFieldCache {
 public:
  GlFieldCache(const gl::Api& api, std::size_t maxBytes) : api_(api), maxBytes_(maxBytes) {}

  /// Binds a field's textures and uploads missing ones. Throws EnvironmentError if the field alone is too large for the
  /// driver or the budget.
  void bind(const LightField& field, int lighting);

  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Entry {
    GlLightField textures;
    std::uint64_t lastUse;
  };
  using Entries = std::map<const void*, Entry>;  // by LightField::storage

  void makeRoom(std::size_t bytes, const void* but);

  const gl::Api& api_;
  const std::size_t maxBytes_;
  std::uint64_t uses_ = 0;
  Entries entries_;
};

}  // namespace grove::objects::lightfield
