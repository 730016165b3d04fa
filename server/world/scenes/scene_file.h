#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "world/geometry.h"
#include "world/ground/hills.h"
#include "world/sky.h"

namespace grove::world {

/// An unusable scene file; what() reads `FILE:LINE: reason`.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Limit of coordinates, on either side of the origin.
inline constexpr double kMaxMetres = 1000.0;

/// The type-specific settings of one object. Each getter marks its key as known; finish() then rejects the others, so
/// that a misspelt key is an error with a line number and not a silent default.
class Parameters {
 public:
  class Table;  ///< hides the parser
  explicit Parameters(std::shared_ptr<const Table> table);

  [[nodiscard]] double number(std::string_view key, double fallback, double low, double high) const;
  [[nodiscard]] int integer(std::string_view key, int fallback, int low, int high) const;
  [[nodiscard]] std::string text(std::string_view key, std::string_view fallback) const;
  /// The value must be one of the choices; the first is the default.
  [[nodiscard]] std::string choice(std::string_view key, const std::vector<std::string>& choices) const;
  [[nodiscard]] Vec3 vector(std::string_view key, Vec3 fallback) const;
  /// A list of lists of `columns` numbers each; empty if the key is missing.
  [[nodiscard]] std::vector<std::vector<double>> rows(std::string_view key, std::size_t columns) const;
  /// A file, relative to the scene file's folder; empty if the key is missing.
  [[nodiscard]] std::filesystem::path path(std::string_view key) const;

  /// Throws SceneError if the file has a key that no getter has read.
  void finish() const;

  /// Returns a copy in which one key has this value, regardless of the file.
  [[nodiscard]] Parameters with(std::string_view key, double value) const;

  /// Throws SceneError with the key's line, or the object's if the key is missing.
  [[noreturn]] void fail(std::string_view key, const std::string& reason) const;

 private:
  std::shared_ptr<const Table> table_;
};

/// One `[[object]]` of a scene file, or one of its copies.
struct ObjectDescription {
  std::string type;
  std::string name;
  Transform transform;
  Parameters parameters;
};

/// A point light of the scene, `[[light]]`.
struct LightDescription {
  Vec3 position{0.0F};
  Vec3 colour{1.0F};
  float flicker = 0.0F;  ///< 0 steady to 1 wild, as a fire
};

struct Scene {
  std::string name;
  std::uint64_t hash = 0;         ///< of the text
  Vec3 spawn{0.0F, 0.0F, 10.0F};  ///< where visitors arrive, on the ground
  float spawnYaw = 0.0F;          ///< radians
  float radius = 30.0F;           ///< metres from the origin, limit of visitors' movement
  std::vector<ObjectDescription> objects;
  std::optional<ObjectDescription> visitor;  ///< `[visitor]`: the look of visitors to each other
  std::vector<LightDescription> lights;
  std::vector<Hill> hills;  ///< `[[hill]]`
  /// `[types.NAME]`: the options that all objects of a type share.
  std::map<std::string, Parameters, std::less<>> typeOptions;
  Sky sky;
};

/// Sets one of a type's options, regardless of the file.
void setTypeOption(Scene& scene, std::string_view type, std::string_view key, double value);

/// Reads a scene. Throws SceneError (bad file) or EnvironmentError (no such file, not a regular file, or more than 16
/// MiB).
[[nodiscard]] Scene loadScene(const std::filesystem::path& file);

/// The same from text; `fileName` is for messages.
[[nodiscard]] Scene parseScene(std::string_view text, const std::string& fileName);

}  // namespace grove::world
