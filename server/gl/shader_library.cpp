#include "gl/shader_library.h"

#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "pipeline/embedded.h"

namespace grove::gl {
namespace {

std::optional<std::string> includedPath(const std::string& line) {
  constexpr std::string_view kDirective = "#include \"";
  if (!line.starts_with(kDirective)) return std::nullopt;
  const std::size_t end = line.find('"', kDirective.size());
  if (end == std::string::npos) return std::nullopt;
  return line.substr(kDirective.size(), end - kDirective.size());
}

}  // namespace

ShaderLibrary::ShaderLibrary(std::optional<std::filesystem::path> directory) : directory_(std::move(directory)) {
  if (directory_ && !std::filesystem::is_directory(*directory_)) {
    throw EnvironmentError("no such directory", directory_->string(), "--shader-dir names a copy of shaders/");
  }
}

ShaderSource ShaderLibrary::load(const std::string& path) const {
  ShaderSource source;
  std::set<std::string> seen;
  expand(path, "", seen, source);
  return source;
}

std::string ShaderLibrary::read(const std::string& path, const std::string& wantedBy) const {
  const std::string where = wantedBy.empty() ? "shader " + path : wantedBy;
  if (directory_) {
    std::ifstream file(*directory_ / path, std::ios::binary);
    if (!file)
      throw EnvironmentError("cannot read " + (*directory_ / path).string(), where, "--shader-dir is incomplete");
    return {std::istreambuf_iterator<char>(file), {}};
  }
  for (const embedded::File& file : embedded::shaders()) {
    if (path == file.path) return std::string(file.text());
  }
  throw EnvironmentError("no shader " + path + " in this build", where, "list it in server/gl/CMakeLists.txt");
}

void ShaderLibrary::expand(const std::string& path, const std::string& wantedBy, std::set<std::string>& seen,
                           ShaderSource& into) const {
  if (!seen.insert(path).second) return;
  std::istringstream lines(read(path, wantedBy));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string place = path + ":" + std::to_string(number);
    if (const auto included = includedPath(line)) {
      expand(*included, place, seen, into);
    } else {
      into.text += line + "\n";
      into.places.push_back(place);
    }
  }
}

}  // namespace grove::gl
