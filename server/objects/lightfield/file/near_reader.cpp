#include "objects/lightfield/file/near_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/format/layout.h"

namespace grove::objects::lightfield {
namespace {

/// Reads arrays, one after the other.
class Arrays {
 public:
  explicit Arrays(std::span<const std::byte> bytes) : rest_(bytes) {}

  /// The next `count` values; they are there.
  template <class T>
  [[nodiscard]] std::span<const T> take(std::size_t count) {
    const std::span<const T> values(reinterpret_cast<const T*>(rest_.data()), count);
    rest_ = rest_.subspan(values.size_bytes());
    return values;
  }

 private:
  std::span<const std::byte> rest_;
};

std::uint64_t bytesOf(const NearHeader& header, std::size_t lightings) {
  return sizeof header + std::uint64_t{header.clusters} * sizeof(NearCluster) +
         std::uint64_t{header.vertices} * 3 * sizeof(float) + std::uint64_t{header.faces} * sizeof(NearFace) +
         std::uint64_t{header.colours} * 2 * lightings * sizeof(std::uint32_t);
}

bool isLength(float value) { return std::abs(value) <= kLongest; }

/// Whether `count` values from `first` on are among `all`.
bool isWithin(std::uint64_t first, std::uint64_t count, std::uint64_t all) { return first + count <= all; }

bool isValid(const NearCluster& cluster, const NearHeader& header, std::span<const NearFace> faces) {
  const std::uint64_t padded = (std::uint64_t{cluster.vertices} + kClusterAlignment - 1) & ~(kClusterAlignment - 1);
  const bool inArrays = cluster.vertices <= kMaxClusterVertices && cluster.faces <= kMaxClusterFaces &&
                        cluster.firstVertex % kClusterAlignment == 0 && cluster.smooth <= 1 &&
                        isWithin(cluster.firstVertex, padded, header.vertices) &&
                        isWithin(cluster.firstFace, cluster.faces, header.faces) &&
                        isWithin(cluster.firstColour, cluster.colours(), header.colours);
  if (!inArrays || !std::ranges::all_of(cluster.low, isLength) || !std::ranges::all_of(cluster.high, isLength)) {
    return false;
  }
  return std::ranges::all_of(faces.subspan(cluster.firstFace, cluster.faces), [&](const NearFace& face) {
    return std::ranges::all_of(face, [&](std::uint8_t corner) { return corner < cluster.vertices; });
  });
}

}  // namespace

std::shared_ptr<const std::vector<NearCluster>> readNear(std::span<const std::byte> section, std::size_t lightings,
                                                         const std::string& name, LightField& field) {
  if (section.empty()) return nullptr;
  const auto require = [&](bool good, const char* reason) {
    if (!good) throw LightFieldError(name + ": " + reason);
  };
  NearHeader header;
  require(section.size() >= sizeof header, "has a near model of the wrong length");
  std::memcpy(&header, section.data(), sizeof header);
  require(section.size() == bytesOf(header, lightings), "has a near model of the wrong length");
  Arrays arrays(section.subspan(sizeof header));
  const auto mapped = arrays.take<NearCluster>(header.clusters);
  auto clusters = std::make_shared<const std::vector<NearCluster>>(mapped.begin(), mapped.end());
  NearModel& near = field.near;
  near.clusters = *clusters;
  for (std::span<const float>& axis : near.positions) axis = arrays.take<float>(header.vertices);
  near.faces = arrays.take<NearFace>(header.faces);
  for (std::size_t k = 0; k < lightings; ++k) {
    near.colours.push_back(arrays.take<std::uint32_t>(std::size_t{header.colours} * 2));
  }
  for (const std::span<const float> axis : near.positions) {
    require(std::ranges::all_of(axis, isLength), "has a near model with a vertex out of range");
  }
  for (const NearCluster& cluster : near.clusters) {
    require(isValid(cluster, header, near.faces), "has a near model with an invalid cluster");
  }
  field.bytes += section.size();
  return clusters;
}

}  // namespace grove::objects::lightfield
