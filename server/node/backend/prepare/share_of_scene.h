#pragma once

#include <optional>
#include <span>
#include <string>

#include "node/backend/backend_services.h"
#include "node/messages/served_objects.h"

namespace grove::node {

/// What these names of objects and types mean in a scene: an object by its name, or all of a type, which may be that of
/// the visitors. Nothing, and `unknown` is the name, if one means nothing.
[[nodiscard]] std::optional<ServedObjects> namedObjects(const LoadedScene& scene, std::span<const std::string> names,
                                                        std::string& unknown);

/// A scene for a node that owns these objects only; the layout stays whole.
[[nodiscard]] LoadedScene shareOf(const LoadedScene& scene, const ServedObjects& own);

}  // namespace grove::node
