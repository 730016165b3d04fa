#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

namespace grove::node {

/// Something slow that objects of a scene show, kept as a file in the cache folder, such as a light field. Until it
/// exists in the scene's quality, the objects can show a coarse version. The scene and its object type outlive it. One
/// thread at a time.
class Preparation {
 public:
  /// The current step, and the share of all work that is done.
  using Progress = std::function<void(std::string_view step, float share)>;

  Preparation() = default;
  virtual ~Preparation() = default;
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// For log lines: the kind ("light field"), and which one it is.
  [[nodiscard]] virtual std::string_view kind() const = 0;
  [[nodiscard]] virtual std::string name() const = 0;

  /// Effort to make it, relative to others of its kind.
  [[nodiscard]] virtual float cost() const = 0;
  /// The share of the view from the spawn point that its objects cover as they are shown now.
  [[nodiscard]] virtual float weight() const = 0;

  /// If it exists in the scene's quality, shows it from now on, also in living worlds. Returns false if it is missing,
  /// or damaged, which is logged.
  [[nodiscard]] virtual bool show() = 0;
  /// Makes it, so that show() finds it. Returns false if it was stopped; the next call continues from there. Throws
  /// world::SceneError, EnvironmentError or ImportError.
  [[nodiscard]] virtual bool make(const Progress& progress, const std::stop_token& stop) = 0;
  /// Makes a coarse version unless one exists, in about a second of a core. Objects of future worlds show it until
  /// there is a finer one. Kept in the cache folder, or in `elsewhere`. Errors as make().
  [[nodiscard]] virtual bool showRoughly(const std::optional<std::filesystem::path>& elsewhere, int threads,
                                         const Progress& progress, const std::stop_token& stop) = 0;
};

}  // namespace grove::node
