#include "objects/lightfield/light_field_frontend.h"

#include "objects/lightfield/cache/reprojection.h"
#include "objects/lightfield/relight.h"
#include "objects/lightfield/shared_view.h"

namespace grove::objects::lightfield {

std::shared_ptr<const node::Image> LightFieldFrontend::image(const node::VisibleObject& object,
                                                             const node::Payload& payload, const node::View&,
                                                             node::ImagePool& images) {
  const auto* data = std::get_if<std::shared_ptr<const node::SimulationData>>(&payload);
  if (data == nullptr) return nullptr;
  const auto& [picture, camera, haze, lamps] = static_cast<const SharedView&>(**data).parts();
  if (picture->empty()) return nullptr;
  std::shared_ptr<node::Image> image = images.acquire(object.rect);
  reproject(*picture, camera, haze, *image);
  addLamps(lamps, camera, *image);
  return image;
}

}  // namespace grove::objects::lightfield
