#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

namespace grove::node {

/// What objects of a scene show and what takes long to make, kept as a file of the cache folder: a light field. Until
/// it is there as fine as the scene wants it, they can show something rough. The scene and the type of object that gave
/// it outlive it. One thread at a time.
class Preparation {
 public:
  /// What is being done, and the share of all of it.
  using Progress = std::function<void(std::string_view step, float share)>;

  Preparation() = default;
  virtual ~Preparation() = default;
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// For people: what such a thing is called ("light field"), and which one it is.
  [[nodiscard]] virtual std::string_view kind() const = 0;
  [[nodiscard]] virtual std::string name() const = 0;

  /// What it takes to make it, against others of its kind.
  [[nodiscard]] virtual float cost() const = 0;
  /// How much of the view from where visitors arrive its objects take, as they are shown now.
  [[nodiscard]] virtual float weight() const = 0;

  /// If it is there as fine as the scene wants it, objects show it from now on, in worlds that live, too. False if it
  /// is not there, or damaged, which the log reports.
  [[nodiscard]] virtual bool show() = 0;
  /// Makes it so that show() finds it. False if it was stopped; then the next one goes on from there. Throws
  /// world::SceneError, EnvironmentError or ImportError.
  [[nodiscard]] virtual bool make(const Progress& progress, const std::stop_token& stop) = 0;
  /// Makes something rough unless it is there, in about a second of a core, which objects of worlds that are still to
  /// be made show until there is something finer; kept in the cache folder, or in `elsewhere`. As make().
  [[nodiscard]] virtual bool showRoughly(const std::optional<std::filesystem::path>& elsewhere, int threads,
                                         const Progress& progress, const std::stop_token& stop) = 0;
};

}  // namespace grove::node
