#include "node/messages/result.h"

#include <utility>

namespace grove::node {

Result resultOf(const Request& request, Payload payload) {
  Result result;
  result.session = request.view ? request.view->session : makeId(request.process, 0);
  result.frame = request.view ? request.view->frame : 0;
  result.slot = request.slot;
  result.what = {request.object, request.key};
  result.shared = request.shared;
  const auto* const data = std::get_if<std::shared_ptr<const SharedData>>(&payload);
  if (data != nullptr && *data != nullptr) result.version = (*data)->version();
  result.payload = std::move(payload);
  return result;
}

}  // namespace grove::node
