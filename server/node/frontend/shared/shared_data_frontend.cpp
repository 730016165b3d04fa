#include "node/frontend/shared/shared_data_frontend.h"

namespace grove::node {

Plan SharedDataFrontend::plan(const VisibleObject&, const View&, const SharedOf& shared, const Reply* reply) {
  if (reply != nullptr) return reply->payload;
  if (auto data = shared.find({})) return Payload(std::move(data));
  return Ask{.shared = true, .key = {}, .rect = {}};
}

std::unique_ptr<Layer> SharedDataFrontend::layer(const VisibleObject& object, const Payload& payload,
                                                 const View& view) {
  const auto* const data = std::get_if<std::shared_ptr<const SharedData>>(&payload);
  return data == nullptr || *data == nullptr ? nullptr : layerOf(object, *data, view);
}

}  // namespace grove::node
