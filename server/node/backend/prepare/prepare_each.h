#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace grove::node {

struct BackendServices;

/// Does the many like parts of a preparation, such as its objects', and reports progress as `label`. With helpers, on
/// their threads and at once, so not called from one of them; without, one after the other on this thread. What `work`
/// or progress throws ends it after the parts that have begun, and is rethrown here.
void prepareEach(const BackendServices& services, std::string_view label, std::size_t count,
                 const std::function<void(std::size_t)>& work);

}  // namespace grove::node
