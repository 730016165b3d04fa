#pragma once

#include <memory>

#include "node/frontend/frontend_half.h"

namespace grove::node {

/// Base for types that draw an object from its own shared data only, under the empty key, in its newest version.
class SharedDataFrontend : public FrontendHalf {
 public:
  [[nodiscard]] Plan plan(const VisibleObject& object, const View& view, const SharedOf& shared,
                          const Reply* reply) final;
  [[nodiscard]] std::unique_ptr<Layer> layer(const VisibleObject& object, const Payload& payload,
                                             const View& view) final;

 private:
  /// The layer may refer to the object and the view.
  [[nodiscard]] virtual std::unique_ptr<Layer> layerOf(const VisibleObject& object,
                                                       std::shared_ptr<const SharedData> data, const View& view) = 0;
};

}  // namespace grove::node
