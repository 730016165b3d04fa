#include "stream/web_server/pages/reuse_json.h"

#include <nlohmann/json.hpp>

namespace grove::stream {

nlohmann::ordered_json reuseJson(const pipeline::Reuse& reuse) {
  return {{"views_made", reuse.made},
          {"views_of_one", reuse.usedByOne()},
          {"views_of_several", reuse.shared},
          {"uses_again", reuse.usesAgain},
          {"uses_by_others", reuse.usesByOthers}};
}

}  // namespace grove::stream
