#include "cli/bench/link_report.h"

#include <cmath>

namespace grove::cli {

nlohmann::ordered_json linkJson(const node::LinkTraffic& traffic, double seconds, int users) {
  const auto rate = [&](std::uint64_t bytes) {
    const double megabits = static_cast<double>(bytes) * 8e-6 / seconds / users;
    return std::round(megabits * 1e3) / 1e3;
  };
  return {{"shared_data_mbit_per_visitor", rate(traffic.sharedData)},
          {"pictures_mbit_per_visitor", rate(traffic.pictures)},
          {"headers_mbit_per_visitor", rate(traffic.headers)},
          {"to_backend_mbit_per_visitor", rate(traffic.toBackend)}};
}

}  // namespace grove::cli
