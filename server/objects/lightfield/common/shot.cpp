#include "objects/lightfield/common/shot.h"

#include <cmath>

#include "objects/lightfield/common/object_view.h"

namespace grove::objects::lightfield {

Shot Shot::coarser(float times) const {
  const auto down = [&](int at) { return static_cast<int>(std::floor(static_cast<float>(at) / times)); };
  return {lightfield::coarser(camera, times),
          {down(rect.left) - 1, down(rect.top) - 1, down(rect.right) + 2, down(rect.bottom) + 2}};
}

}  // namespace grove::objects::lightfield
