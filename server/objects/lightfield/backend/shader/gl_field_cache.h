#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "objects/lightfield/backend/shader/gl_light_field.h"

namespace grove::objects::lightfield {

/// The light fields that one GL context holds as textures. Those that were not drawn for longest are dropped when there
/// is no room, and those that nobody uses any more when there is a new one.
class GlFieldCache {
 public:
  GlFieldCache(const gl::Api& api, std::size_t maxBytes) : api_(api), maxBytes_(maxBytes) {}

  /// Binds a field's textures, uploading what is missing. Throws EnvironmentError if the field alone is too big for the
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
