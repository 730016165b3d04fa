#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace grove::node {

struct BackendServices;

/// Does the similar parts of a preparation, such as one per object, and reports progress as `label`. The parts run on
/// the workers in parallel, so it must not be called from one of them. Exceptions of `work` or of progress stop it
/// after the parts that have begun, and are rethrown here.
void prepareEach(const BackendServices& services, std::string_view label, std::size_t count,
                 const std::function<void(std::size_t)>& work);

}  // namespace grove::node
