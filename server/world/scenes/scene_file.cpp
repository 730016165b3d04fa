#include "world/scenes/scene_file.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <set>
#include <span>
#include <sstream>
#include <utility>

#include "base/checksum.h"
#include "base/plain_file.h"
#include "world/scenes/scene_hills.h"
#include "world/scenes/scene_objects.h"
#include "world/scenes/toml_nesting.h"

namespace grove::world {

/// A parsed TOML table that tracks which keys have been read.
class Parameters::Table {
 public:
  /// `values` shares ownership of the whole file's tree, because copies of a table lose their lines.
  Table(std::shared_ptr<const toml::table> values, std::string fileName, std::string owner)
      : values_(std::move(values)), fileName_(std::move(fileName)), owner_(std::move(owner)) {}

  [[nodiscard]] const toml::node* find(std::string_view key) const {
    known_.emplace(key);
    const toml::node* const given = given_.get(key);
    return given != nullptr ? given : values_->get(key);
  }

  /// Stores whole numbers as integers, which getters of both kinds accept.
  void give(std::string_view key, double value) {
    if (value == std::floor(value)) {
      given_.insert_or_assign(key, static_cast<std::int64_t>(value));
    } else {
      given_.insert_or_assign(key, value);
    }
  }

  [[noreturn]] void fail(const toml::node* node, const std::string& reason) const {
    const auto line = (node != nullptr ? node->source() : values_->source()).begin.line;
    throw SceneError(fileName_ + ":" + std::to_string(line) + ": " + owner_ + reason);
  }

  [[nodiscard]] std::filesystem::path folder() const { return std::filesystem::path(fileName_).parent_path(); }

  /// A table inside this one.
  [[nodiscard]] std::shared_ptr<const Table> inner(const toml::table& table, const std::string& owner) const {
    return std::make_shared<Table>(std::shared_ptr<const toml::table>(values_, &table), fileName_, owner);
  }

  void refuseUnknown() const {
    for (const auto& [key, node] : *values_) {
      if (known_.find(key.str()) == known_.end()) fail(&node, "unknown key '" + std::string(key.str()) + "'");
    }
  }

 private:
  std::shared_ptr<const toml::table> values_;
  std::string fileName_;
  toml::table given_;  // override the values
  std::string owner_;  // "" or "object 'name': ", for messages
  mutable std::set<std::string, std::less<>> known_;
};

namespace {

constexpr std::size_t kMaxObjects = 4096;
constexpr int kMaxNested = 16;
constexpr std::uint64_t kMaxBytes = std::uint64_t{16} << 20U;

std::string inQuotes(std::string_view text) { return std::string("'").append(text).append("'"); }

/// Rounds integers that no double represents exactly.
std::optional<double> numberIn(const toml::node& node) {
  if (const auto whole = node.is_integer() ? node.value<std::int64_t>() : std::nullopt) {
    return static_cast<double>(*whole);
  }
  return node.is_number() ? node.value<double>() : std::nullopt;
}

}  // namespace

Parameters::Parameters(std::shared_ptr<const Table> table) : table_(std::move(table)) {}

double Parameters::number(std::string_view key, double fallback, double low, double high) const {
  const toml::node* node = table_->find(key);
  if (node == nullptr) return fallback;
  const auto value = numberIn(*node);
  if (!value) table_->fail(node, inQuotes(key) + " must be a number");
  if (!(*value >= low && *value <= high)) {
    std::ostringstream range;
    range << std::setprecision(10) << " must lie between " << low << " and " << high;
    table_->fail(node, inQuotes(key) + range.str());
  }
  return *value;
}

int Parameters::integer(std::string_view key, int fallback, int low, int high) const {
  const toml::node* node = table_->find(key);
  if (node != nullptr && !node->is_integer()) table_->fail(node, inQuotes(key) + " must be a whole number");
  return static_cast<int>(number(key, fallback, low, high));
}

std::string Parameters::text(std::string_view key, std::string_view fallback) const {
  const toml::node* node = table_->find(key);
  if (node == nullptr) return std::string(fallback);
  if (!node->is_string()) table_->fail(node, inQuotes(key) + " must be a text in quotes");
  return *node->value<std::string>();
}

std::string Parameters::choice(std::string_view key, const std::vector<std::string>& choices) const {
  std::string value = text(key, choices.front());
  if (std::ranges::find(choices, value) == choices.end()) {
    std::string list;
    for (const std::string& choice : choices) list += (list.empty() ? "" : ", ") + inQuotes(choice);
    fail(key, inQuotes(key) + " is " + inQuotes(value) + " but must be one of " + list);
  }
  return value;
}

Vec3 Parameters::vector(std::string_view key, Vec3 fallback) const {
  const toml::node* node = table_->find(key);
  if (node == nullptr) return fallback;
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != 3) table_->fail(node, inQuotes(key) + " must be three numbers, [x, y, z]");
  Vec3 result(0.0F);
  for (int i = 0; i < 3; ++i) {
    const toml::node& element = (*array)[static_cast<std::size_t>(i)];
    const auto value = numberIn(element);
    if (!value || !(std::abs(*value) <= kMaxMetres)) {
      table_->fail(node, inQuotes(key) + " must be three numbers within +-1000");
    }
    result[i] = static_cast<float>(*value);
  }
  return result;
}

std::vector<std::vector<double>> Parameters::rows(std::string_view key, std::size_t columns) const {
  const toml::node* const node = table_->find(key);
  if (node == nullptr) return {};
  const toml::array* const array = node->as_array();
  const auto refuse = [&](const toml::node* at) {
    table_->fail(at, inQuotes(key) + " must be a list of lists of " + std::to_string(columns) + " numbers");
  };
  if (array == nullptr || array->empty()) refuse(node);
  std::vector<std::vector<double>> rows;
  for (const toml::node& element : *array) {
    const toml::array* const numbers = element.as_array();
    if (numbers == nullptr || numbers->size() != columns) refuse(&element);
    std::vector<double> row;
    for (const toml::node& number : *numbers) {
      const auto value = numberIn(number);
      if (!value || !std::isfinite(*value)) refuse(&element);
      row.push_back(*value);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::filesystem::path Parameters::path(std::string_view key) const {
  const std::string given = text(key, "");
  return given.empty() ? std::filesystem::path() : table_->folder() / given;
}

Parameters Parameters::with(std::string_view key, double value) const {
  auto table = std::make_shared<Table>(*table_);
  table->give(key, value);
  return Parameters(std::move(table));
}

void Parameters::finish() const { table_->refuseUnknown(); }

void Parameters::fail(std::string_view key, const std::string& reason) const {
  table_->fail(table_->find(key), reason);
}

namespace {

/// The tables of an array such as `[[object]]`, in the file's order.
std::vector<const toml::table*> tablesOf(const Parameters::Table& root, std::string_view key) {
  std::vector<const toml::table*> tables;
  const toml::node* node = root.find(key);
  if (node == nullptr) return tables;
  const toml::array* array = node->as_array();
  if (array == nullptr) root.fail(node, inQuotes(key) + " must be written as [[" + std::string(key) + "]]");
  if (array->size() > kMaxObjects) root.fail(node, "more than " + std::to_string(kMaxObjects) + " entries");
  for (const toml::node& element : *array) {
    if (!element.is_table()) root.fail(&element, inQuotes(key) + " must hold tables");
    tables.push_back(element.as_table());
  }
  return tables;
}

LightDescription readLight(const Parameters& parameters) {
  LightDescription light;
  light.position = parameters.vector("position", light.position);
  light.colour = parameters.vector("colour", light.colour);
  light.flicker = static_cast<float>(parameters.number("flicker", 0.0, 0.0, 1.0));
  parameters.finish();
  return light;
}

std::vector<Hill> readHills(const Parameters::Table& root) {
  const std::vector<const toml::table*> tables = tablesOf(root, "hill");
  if (tables.size() > kMaxHills) {
    root.fail(tables[kMaxHills],
              "hill: a scene has " + std::to_string(kMaxHills) + " hills at most; remove this and those that follow");
  }
  std::vector<Hill> hills;
  hills.reserve(tables.size());
  for (const toml::table* table : tables) hills.push_back(readHill(Parameters(root.inner(*table, "hill: "))));
  if (const auto hill = tooHighHill(hills)) {
    root.fail(tables[*hill],
              "hill: together with others it is higher than 1.6 m, so that visitors cannot see over it; "
              "lower one of them, or move it away");
  }
  return hills;
}

std::map<std::string, Parameters, std::less<>> readTypeOptions(const Parameters::Table& root) {
  std::map<std::string, Parameters, std::less<>> options;
  const toml::node* const types = root.find("types");
  if (types == nullptr) return options;
  if (!types->is_table()) root.fail(types, "'types' must be written as [types.NAME]");
  for (const auto& [name, node] : *types->as_table()) {
    const std::string type(name.str());
    if (!node.is_table()) root.fail(&node, "options of types must be written as [types.NAME]");
    options.emplace(type, Parameters(root.inner(*node.as_table(), "options of type " + inQuotes(type) + ": ")));
  }
  return options;
}

std::shared_ptr<const toml::table> parseToml(std::string_view text, const std::string& fileName) {
  if (const auto line = lineNestedDeeper(text, kMaxNested)) {
    throw SceneError(fileName + ":" + std::to_string(*line) + ": nested more than " + std::to_string(kMaxNested) +
                     " deep; a scene needs two");
  }
  try {
    return std::make_shared<const toml::table>(toml::parse(text, fileName));
  } catch (const toml::parse_error& e) {
    throw SceneError(fileName + ":" + std::to_string(e.source().begin.line) + ": " + std::string(e.description()));
  }
}

}  // namespace

Scene parseScene(std::string_view text, const std::string& fileName) {
  const auto root = std::make_shared<Parameters::Table>(parseToml(text, fileName), fileName, "");
  const Parameters top(root);
  Scene scene;
  scene.hash = checksumOf(std::as_bytes(std::span(text)));
  scene.name = top.text("name", "a world");
  scene.spawn = top.vector("spawn", scene.spawn);
  scene.spawnYaw = glm::radians(static_cast<float>(top.number("spawn_yaw_degrees", 0.0, -360.0, 360.0)));
  scene.radius = static_cast<float>(top.number("radius", scene.radius, 1.0, 500.0));
  for (const toml::table* table : tablesOf(*root, "object")) {
    const auto name = (*table)["name"].value<std::string>();
    const std::string owner = name ? "object " + inQuotes(*name) + ": " : "object: ";
    for (ObjectDescription& object : readObjects(Parameters(root->inner(*table, owner)))) {
      if (scene.objects.size() == kMaxObjects)
        root->fail(table, "more than " + std::to_string(kMaxObjects) + " objects");
      scene.objects.push_back(std::move(object));
    }
  }
  for (const toml::table* table : tablesOf(*root, "light")) {
    scene.lights.push_back(readLight(Parameters(root->inner(*table, "light: "))));
  }
  scene.hills = readHills(*root);
  standOnGround(scene);
  if (const toml::node* visitor = root->find("visitor")) {
    if (!visitor->is_table()) root->fail(visitor, "'visitor' must be written as [visitor]");
    scene.visitor = readObject(Parameters(root->inner(*visitor->as_table(), "visitor: ")));
  }
  scene.typeOptions = readTypeOptions(*root);
  top.finish();
  return scene;
}

void setTypeOption(Scene& scene, std::string_view type, std::string_view key, double value) {
  const auto found = scene.typeOptions.find(type);
  if (found != scene.typeOptions.end()) {
    found->second = found->second.with(key, value);
    return;
  }
  const Parameters none(std::make_shared<Parameters::Table>(std::make_shared<const toml::table>(), "", ""));
  scene.typeOptions.emplace(type, none.with(key, value));
}

Scene loadScene(const std::filesystem::path& file) {
  return parseScene(PlainFile(file, "check the path given to --scene", kMaxBytes).readAll(), file.string());
}

}  // namespace grove::world
