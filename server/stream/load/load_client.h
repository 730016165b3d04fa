#pragma once

#include <optional>
#include <string>

#include "stream/load/load_plan.h"
#include "stream/load/load_report.h"

namespace grove::stream {

/// Where a load test goes.
struct LoadTarget {
  std::string host;
  int port = 80;
  bool isSecure = false;             ///< by TLS; its certificate is checked
  bool takesAnyCertificate = false;  ///< it is not
};

/// Reads `ws[s]://HOST[:PORT][/]`; nothing if it is something else.
[[nodiscard]] std::optional<LoadTarget> parseLoadUrl(const std::string& url);

/// Runs the plan's sessions as real websocket clients on the calling thread until all that are let in have been counted
/// for its seconds. Those that are not let in or are thrown out are errors in the report.
[[nodiscard]] LoadReport runLoadClients(const LoadTarget& target, const LoadPlan& plan);

}  // namespace grove::stream
