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

/// `type = "lightfield"`: pictures of an object from all around, made by `grove bake` (section 5.1). Keys as in
/// LightFieldSource and SamplerKind, options as in LightFieldOptions. Any thread.
class LightFieldBackendType final : public node::BackendType {
 public:
  [[nodiscard]] std::string_view name() const override;
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters& parameters) const override;
  [[nodiscard]] std::shared_ptr<const node::TypeOptions> options(const world::Parameters& parameters) const override;
  [[nodiscard]] std::unique_ptr<node::BackendHalf> makeHalf(const node::BackendServices& services,
                                                            world::TypeIndex self) const override;
  [[nodiscard]] std::vector<std::unique_ptr<node::Preparation>> preparations(const world::Scene& scene) const override;

  /// Of this file, objects show that from now on, in worlds that live, too: it, or something rough until it is made.
  void show(const std::filesystem::path& file, const LightField& field) const;
  /// What is shown of a file so far; nothing if nobody has opened it.
  [[nodiscard]] std::optional<LightField> shown(const std::filesystem::path& file) const;

 private:
  [[nodiscard]] LightField open(const std::filesystem::path& file) const;

  mutable std::mutex mutex_;
  /// That are open already, by the file: that one, or something to show until it is made.
  mutable std::map<std::filesystem::path, LightField> known_;
  mutable models::FileNames names_;
  /// So that a forest of one tree is one copy in memory.
  mutable std::map<std::pair<std::string, SamplerKind>, std::weak_ptr<LightFieldModel>> models_;
};

}  // namespace grove::objects::lightfield
