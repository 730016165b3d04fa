#include "objects/lightfield/backend/shader/gl_field_cache.h"

#include <string>

#include "base/error.h"

namespace grove::objects::lightfield {

void GlFieldCache::bind(const LightField& field, int lighting) {
  const void* const key = field.storage.get();
  auto found = entries_.find(key);
  if (found == entries_.end() || !found->second.textures.isOf(field)) {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.textures.isAbandoned(); });
    makeRoom(GlLightField::minBytes(field), key);
    found = entries_.try_emplace(key, Entry{GlLightField(api_, field), 0}).first;
  }
  makeRoom(found->second.textures.missingBytes(lighting), key);
  found->second.textures.bind(field, lighting);
  found->second.lastUse = ++uses_;
}

std::size_t GlFieldCache::bytes() const noexcept {
  std::size_t sum = 0;
  for (const auto& [key, entry] : entries_) sum += entry.textures.bytes();
  return sum;
}

void GlFieldCache::makeRoom(std::size_t bytes, const void* but) {
  while (this->bytes() + bytes > maxBytes_) {
    auto oldest = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (entry->first == but) continue;
      if (oldest == entries_.end() || entry->second.lastUse < oldest->second.lastUse) oldest = entry;
    }
    if (oldest == entries_.end()) {
      throw EnvironmentError("a light field needs " + std::to_string((this->bytes() + bytes) >> 20U) +
                                 " MiB of textures, more than the " + std::to_string(maxBytes_ >> 20U) + " MiB allowed",
                             "GL", "bake it smaller, or set renderer = \"simd\" for it in the scene file");
    }
    entries_.erase(oldest);
  }
}

}  // namespace grove::objects::lightfield
