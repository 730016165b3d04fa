#include "node/transport/packets/pack_result.h"

#include <memory>

#include "node/messages/packing/picture_packing.h"

namespace grove::node {

void packResult(Result& result, pipeline::Timeline& timeline, std::string_view subject) {
  if (const auto* data = std::get_if<std::shared_ptr<const SharedData>>(&result.payload)) {
    if (*data) result.packed = (*data)->packed(timeline, subject);
  } else if (const auto* picture = std::get_if<std::shared_ptr<const raster::Image>>(&result.payload)) {
    if (*picture) result.packed = std::make_shared<const PackedBytes>(packPicture(**picture));
  }
  if (result.packed) result.payload = std::shared_ptr<const raster::Image>();
}

}  // namespace grove::node
