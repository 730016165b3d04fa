#pragma once

#include <optional>

#include "cli/serve/serve.h"
#include "stream/web_server/access/entrance.h"
#include "stream/web_server/listen_address.h"

namespace grove::cli {

/// Options of `grove serve` that are more than one value.
struct CheckedOptions {
  stream::HostPort visitors;         ///< address of the page
  stream::HostPort operatorAddress;  ///< address of the operator's page
  stream::EntranceRules rules;
};

/// Returns nothing, with one line on stderr, if an option is invalid.
[[nodiscard]] std::optional<CheckedOptions> checkedOptions(const ServeOptions& options);

}  // namespace grove::cli
