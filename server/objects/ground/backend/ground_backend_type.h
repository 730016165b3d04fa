#pragma once

#include "node/backend/backend_half.h"

namespace grove::objects::ground {

/// Texels per side of the baked maps; smaller maps bake faster.
struct MapSizes {
  int clearing = 2048;
  int meadow = 1024;
};

/// The ground, y = 0 and the scene's hills: a meadow to the horizon, with trodden earth around the fire at the origin
/// and a path.
///
/// Scene file: `type = "ground"`, `hearth` (radius of the trodden earth, metres, 0 to 20), `path` (a point on the worn
/// path, metres), `seed` (integer, 0 to 1,000,000).
class GroundBackendType final : public node::BackendType {
 public:
  explicit GroundBackendType(MapSizes sizes = {}) : sizes_(sizes) {}

  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex self) const override;

 private:
  const MapSizes sizes_;
};

}  // namespace grove::objects::ground
