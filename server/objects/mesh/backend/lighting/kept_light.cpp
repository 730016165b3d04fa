#include "objects/mesh/backend/lighting/kept_light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "base/atomic_file.h"
#include "base/cache_folder.h"
#include "base/checksum.h"
#include "base/error.h"
#include "base/plain_file.h"

namespace grove::objects::mesh {
namespace {

using world::Vec4;

static_assert(std::endian::native == std::endian::little, "files hold what memory does");
static_assert(sizeof(Vec4) == 4 * sizeof(float));

constexpr std::array<char, 8> kMagic{'G', 'r', 'o', 'v', 'e', 'M', 'L', '\n'};
constexpr std::uint32_t kFormatVersion = 1;
constexpr const char* kMend = "set GROVE_CACHE to a folder that can be written";

/// Followed by the numbers of vertices, 64 bits each, and the light, four floats per vertex.
struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kFormatVersion;
  std::uint32_t meshes = 0;
  std::uint64_t key = 0;
  std::uint64_t checksum = 0;  ///< of everything after the header
};
static_assert(sizeof(Header) == 32);

constexpr std::size_t kMaxKept = 8;
constexpr std::chrono::hours kOldest{1};  // age of a partial file that may still be in progress

/// Light has a new name whenever an object moves, and a process that dies while it writes leaves a partial file. Keeps
/// `newest` and the most recently used files; ignores errors.
void removeFormer(const std::filesystem::path& newest) {
  using Time = std::filesystem::file_time_type;
  const Time now = Time::clock::now();
  std::vector<std::pair<Time, std::filesystem::path>> kept;
  std::error_code error;
  std::error_code ignored;
  for (std::filesystem::directory_iterator at(newest.parent_path(), error), end; !error && at != end;
       at.increment(error)) {
    const std::filesystem::path& path = at->path();
    const Time used = at->last_write_time(ignored);
    if (ignored) continue;
    if (path.extension() == ".gml" && path != newest) kept.emplace_back(used, path);
    const bool partial = path.filename().string().find(".gml.partial-") != std::string::npos;
    if (partial && now - used > kOldest) std::filesystem::remove(path, ignored);
  }
  std::ranges::sort(kept, std::greater());
  for (std::size_t i = kMaxKept - 1; i < kept.size(); ++i) std::filesystem::remove(kept[i].second, ignored);
}

}  // namespace

std::filesystem::path keptLightFile(std::uint64_t key) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%016llx.gml", static_cast<unsigned long long>(key));
  return cacheFolder() / "mesh-light" / name.data();
}

std::vector<std::vector<Vec4>> readKeptLight(const std::filesystem::path& file, std::uint64_t key,
                                             std::span<const std::size_t> vertices) {
  PlainFile opened(file, kMend, std::numeric_limits<std::uint64_t>::max());
  const auto require = [&](bool good, const char* reason) {
    if (!good) throw KeptLightError(file.string() + ": " + reason);
  };
  const auto read = [&](auto& values) {
    const auto bytes = std::as_writable_bytes(std::span(values));
    require(opened.read({reinterpret_cast<char*>(bytes.data()), bytes.size()}) == bytes.size(), "is truncated");
  };
  std::array<Header, 1> start;
  read(start);
  const Header& header = start.front();
  require(header.magic == kMagic, "is not a file of mesh light");
  require(header.version == kFormatVersion, "is of another format version");
  require(header.key == key && header.meshes == vertices.size(), "is the light of other meshes");
  std::uint64_t expected = sizeof(Header) + vertices.size() * sizeof(std::uint64_t);
  for (const std::size_t count : vertices) expected += count * sizeof(Vec4);
  require(opened.bytes() >= expected, "is truncated");
  require(opened.bytes() == expected, "has bytes after its end");
  std::vector<std::uint64_t> counts(vertices.size());
  read(counts);
  require(std::ranges::equal(counts, vertices), "is the light of other meshes");
  Checksum checksum;
  checksum.add(std::as_bytes(std::span(counts)));
  std::vector<std::vector<Vec4>> light;
  light.reserve(vertices.size());
  for (const std::size_t count : vertices) {
    read(light.emplace_back(count));
    checksum.add(std::as_bytes(std::span(light.back())));
  }
  require(checksum.value() == header.checksum, "is damaged (its checksum is wrong)");
  const auto sane = [](const Vec4& v) { return std::isfinite(v.x + v.y + v.z + v.w); };
  for (const auto& mesh : light) require(std::ranges::all_of(mesh, sane), "has light that is not a number");
  // Marks the file as used.
  std::error_code ignored;
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), ignored);
  return light;
}

void writeKeptLight(const std::filesystem::path& file, std::uint64_t key, const std::vector<std::vector<Vec4>>& light) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) {
    throw EnvironmentError("cannot make the folder: " + error.message(), file.parent_path().string(), kMend);
  }
  std::vector<std::uint64_t> counts;
  counts.reserve(light.size());
  for (const auto& mesh : light) counts.push_back(mesh.size());
  AtomicFile target(file);
  Checksum checksum;
  std::uint64_t end = sizeof(Header);
  const auto add = [&](std::span<const std::byte> bytes) {
    target.write(end, bytes);
    checksum.add(bytes);
    end += bytes.size();
  };
  add(std::as_bytes(std::span(counts)));
  for (const auto& mesh : light) add(std::as_bytes(std::span(mesh)));
  const std::array<Header, 1> header{
      {{.meshes = static_cast<std::uint32_t>(light.size()), .key = key, .checksum = checksum.value()}}};
  target.write(0, std::as_bytes(std::span(header)));
  target.commit();
  removeFormer(file);
}

}  // namespace grove::objects::mesh
