#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "objects/lightfield/backend/light_field_source.h"
#include "objects/lightfield/bake/bake.h"
#include "objects/lightfield/format/light_field.h"
#include "world/scene_file.h"

/// The light fields of a scene that are made when they are first needed, and the cache folder where they are kept.
namespace grove::cli {

/// One that the scene wants.
struct WantedField {
  objects::lightfield::LightFieldSource source;
  /// Of the objects that show it: their scale and how far they are from where visitors arrive.
  struct Place {
    float scale = 1.0F;
    float distance = 0.0F;  ///< metres
  };
  std::vector<Place> places;
  const world::Parameters* parameters = nullptr;  ///< of the first of them; the scene's
};

/// All of them, each once. Throws world::SceneError.
[[nodiscard]] std::vector<WantedField> wantedFields(const world::Scene& scene);

/// Where light fields are kept; the folder need not be there.
[[nodiscard]] std::filesystem::path fieldFolder();

/// Throws EnvironmentError.
void makeFieldFolder(const std::filesystem::path& folder);

/// What is in a file, or why it cannot be taken from there: it is not there, or damaged, or of another version of the
/// format. One that is there and damaged is reported in the log.
[[nodiscard]] std::variant<objects::lightfield::LightField, std::string> openField(const std::filesystem::path& file);

/// For people: the plant, or the file of the model.
[[nodiscard]] std::string nameOf(const WantedField& wanted);

/// Bakes one as the scene wants it, into its file. False if it was stopped. Throws world::SceneError, EnvironmentError
/// or ImportError.
[[nodiscard]] bool bakeField(const WantedField& wanted, const std::function<void(const bake::BakeProgress&)>& progress,
                             const std::stop_token& stop);

/// Bakes it at once, in a second of a core: fewer and smaller views and rough light, into another file. As bakeField().
[[nodiscard]] bool bakeRoughly(const WantedField& wanted, const std::filesystem::path& file, int threads,
                               const std::function<void(const bake::BakeProgress&)>& progress,
                               const std::stop_token& stop);

/// The name of the file for that in a folder.
[[nodiscard]] std::filesystem::path roughFile(const WantedField& wanted, const std::filesystem::path& folder);

/// Held while light fields are made, so that of several servers one makes them and the others need not.
class FieldLock {
 public:
  /// Takes nothing yet. Throws EnvironmentError if the file cannot be written.
  explicit FieldLock(const std::filesystem::path& file);
  ~FieldLock();
  FieldLock(const FieldLock&) = delete;
  FieldLock& operator=(const FieldLock&) = delete;

  /// Takes it if it is free.
  [[nodiscard]] bool take() const noexcept;
  void give() const noexcept;
  /// Looks every 200 ms whether it is free, and calls `waiting` before. False if it was stopped.
  [[nodiscard]] bool wait(const std::function<void()>& waiting, const std::stop_token& stop) const;

 private:
  int file_;
};

}  // namespace grove::cli
