#include "models/gltf/gltf_names.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>

#include "base/plain_file.h"
#include "models/gltf/gltf_import.h"

namespace grove::models {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

using Json = nlohmann::json;

/// A .gltf file is JSON; a .glb file begins with two headers, which end with the JSON's length and type.
std::string jsonOf(const std::filesystem::path& file) {
  PlainFile plain(file, "name a glTF file", kMaxBytes);
  std::array<char, 20> start{};
  const std::string_view read(start.data(), plain.read(start));
  if (!read.starts_with("glTF")) return std::string(read) + plain.readAll();
  std::uint32_t length = 0;
  std::memcpy(&length, &start[12], sizeof length);
  std::string json(static_cast<std::size_t>(std::min<std::uint64_t>(length, plain.bytes())), '\0');
  json.resize(plain.read(json));
  return json;
}

/// Parses only the lists that reference other files; the rest may be large.
Json referencesOf(const std::filesystem::path& file) {
  const auto keep = [](int depth, Json::parse_event_t event, const Json& parsed) {
    return event != Json::parse_event_t::key || depth != 1 || parsed == "buffers" || parsed == "images";
  };
  return Json::parse(jsonOf(file), keep, false);
}

unsigned hexDigit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a') + 10U;
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A') + 10U;
  return 0;
}

/// Decodes like the parser: "my%20bark.png" is "my bark.png".
std::string decoded(std::string_view uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size()) {
      name += static_cast<char>(hexDigit(uri[i + 1]) << 4U | hexDigit(uri[i + 2]));
      i += 2;
    } else {
      name += uri[i] == '+' ? ' ' : uri[i];
    }
  }
  return name;
}

}  // namespace

std::set<std::filesystem::path> filesNamedBy(const std::filesystem::path& gltf) {
  std::set<std::filesystem::path> files;
  const Json document = referencesOf(gltf);
  const auto add = [&](const std::string& uri) {
    if (uri.empty() || uri.starts_with("data:")) return;
    // The parser's search order: beside the file, then in the working directory.
    for (std::string file : {gltf.parent_path().string(), std::string(".")}) {
      if (!file.empty()) file += '/';
      file += decoded(uri);
      std::error_code failed;
      if (!std::filesystem::is_regular_file(file, failed)) continue;
      files.insert(file);
      return;
    }
  };
  for (const char* const list : {"buffers", "images"}) {
    const auto found = document.find(list);
    if (found == document.end() || !found->is_array()) continue;
    for (const Json& item : *found) {
      const auto uri = item.find("uri");
      if (uri != item.end() && uri->is_string()) add(uri->get_ref<const std::string&>());
    }
  }
  return files;
}

}  // namespace grove::models
