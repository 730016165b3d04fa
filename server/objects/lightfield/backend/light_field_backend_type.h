#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "models/model_source.h"
#include "node/backend/backend_half.h"
#include "objects/lightfield/backend/light_field_model.h"

namespace grove::objects::lightfield {

/// `type = "lightfield"`: pictures of an object from all directions, made by `grove bake` (section 5.1). For keys see
/// LightFieldSource and SamplerKind, for options LightFieldOptions. Any thread.
class LightFieldBackendType final : public node::BackendType {
 public:
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] std::shared_ptr<const node::TypeOptions> options(const world::Parameters& parameters) const override;
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex self) const override;
  [[nodiscard]] std::vector<std::unique_ptr<node::Preparation>> preparations(const world::Scene& scene) const override;

  /// Objects with this file show `field` from now on, also in running worlds: the final one, or a rough one until that
  /// is made.
  void show(const std::filesystem::path& file, const LightField& field) const;
  /// Objects with this file show what `other` shows when they are opened, until show() has something better. The other
  /// is a plant of the same kind.
  void showLike(const std::filesystem::path& file, const std::filesystem::path& other) const;
  /// The light field that this file currently shows; nothing if the file has not been opened.
  [[nodiscard]] std::optional<LightField> shown(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] LightField open(const std::filesystem::path& file) const;
  [[nodiscard]] std::optional<LightField> found(const std::filesystem::path& file) const;

  mutable std::mutex mutex_;
  /// Open light fields by file: the final one, or a rough one until that is made.
  mutable std::map<std::filesystem::path, LightField> known_;
  /// See showLike().
  mutable std::map<std::filesystem::path, std::filesystem::path> likes_;
  mutable models::FileNames names_;
  /// Shares models, so that a forest of one tree is one copy in memory.
  mutable std::map<std::pair<std::string, SamplerKind>, std::weak_ptr<LightFieldModel>> models_;
};

}  // namespace grove::objects::lightfield
