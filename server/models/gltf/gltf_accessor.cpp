#include "models/gltf/gltf_accessor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "models/gltf/gltf_import.h"

namespace grove::models {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

std::size_t bytesOf(const GltfFile& file, int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      file.fail("an accessor has the unknown component type " + std::to_string(componentType));
  }
}

template <class T>
float number(const unsigned char* bytes, bool normalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  if constexpr (!std::is_floating_point_v<T>) {
    if (normalized)
      return std::max(-1.0F, static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()));
  }
  return static_cast<float>(value);
}

float numberOf(int componentType, const unsigned char* bytes, bool normalized) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return number<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return number<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return number<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return number<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return number<std::uint32_t>(bytes, normalized);
    default:
      return number<float>(bytes, normalized);
  }
}

/// A run of equally spaced elements, validated to lie inside a buffer view.
struct Run {
  const unsigned char* first = nullptr;
  std::size_t stride = 0;
};

Run runIn(const GltfFile& file, int view, std::size_t offset, std::size_t count, std::size_t elementBytes) {
  const auto bytes = viewBytes(file, view);
  const std::size_t given = file.document.bufferViews[static_cast<std::size_t>(view)].byteStride;
  const std::size_t stride = given == 0 ? elementBytes : given;
  const bool fits = offset <= bytes.size() && elementBytes <= bytes.size() - offset &&
                    (count - 1) <= (bytes.size() - offset - elementBytes) / stride;
  if (count > 0 && !fits) file.fail("an accessor reaches beyond buffer view " + std::to_string(view));
  return {bytes.data() + offset, stride};
}

std::vector<std::uint32_t> integersIn(const GltfFile& file, const Run& run, int componentType, std::size_t count) {
  if (componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
      componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    file.fail("indices are not unsigned integers");
  }
  const std::size_t bytes = bytesOf(file, componentType);
  std::vector<std::uint32_t> values(count, 0);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(&values[i], run.first + i * run.stride, bytes);
  return values;
}

/// Replaces the elements that a sparse accessor lists.
void replaceSparse(const GltfFile& file, const tinygltf::Accessor& accessor, Elements& elements) {
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    file.fail("a sparse accessor has a negative count or offset");
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  if (count > elements.size()) file.fail("a sparse accessor replaces more elements than it has");
  const std::size_t component = bytesOf(file, accessor.componentType);
  const Run where = runIn(file, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                          bytesOf(file, sparse.indices.componentType));
  const Run values = runIn(file, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                           component * elements.width);
  const auto indices = integersIn(file, where, sparse.indices.componentType, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (indices[i] >= elements.size()) file.fail("a sparse accessor replaces an element that is not there");
    for (std::size_t k = 0; k < elements.width; ++k) {
      elements.values[indices[i] * elements.width + k] =
          numberOf(accessor.componentType, values.first + i * values.stride + k * component, accessor.normalized);
    }
  }
}

const tinygltf::Accessor& checked(const GltfFile& file, int index) {
  const tinygltf::Accessor& accessor = file.at(file.document.accessors, index, "accessor");
  if (accessor.count > 3 * kMaxTriangles) file.fail("accessor " + std::to_string(index) + " has too many elements");
  return accessor;
}

}  // namespace

std::span<const unsigned char> viewBytes(const GltfFile& file, int view) {
  const tinygltf::BufferView& place = file.at(file.document.bufferViews, view, "buffer view");
  const auto& data = file.at(file.document.buffers, place.buffer, "buffer").data;
  if (place.byteOffset > data.size() || place.byteLength > data.size() - place.byteOffset) {
    file.fail("buffer view " + std::to_string(view) + " reaches beyond its buffer");
  }
  return std::span(data).subspan(place.byteOffset, place.byteLength);
}

Elements readElements(const GltfFile& file, int index) {
  const tinygltf::Accessor& accessor = checked(file, index);
  const int width = accessor.type == TINYGLTF_TYPE_SCALAR ? 1 : accessor.type;
  if (width < 1 || width > 4) file.fail("accessor " + std::to_string(index) + " is not a list of scalars or vectors");
  Elements elements{{}, static_cast<std::size_t>(width)};
  elements.values.resize(accessor.count * elements.width, 0.0F);
  if (accessor.bufferView >= 0) {
    const std::size_t component = bytesOf(file, accessor.componentType);
    const Run run = runIn(file, accessor.bufferView, accessor.byteOffset, accessor.count, component * elements.width);
    for (std::size_t i = 0; i < elements.values.size(); ++i) {
      const unsigned char* const bytes =
          run.first + (i / elements.width) * run.stride + (i % elements.width) * component;
      elements.values[i] = numberOf(accessor.componentType, bytes, accessor.normalized);
    }
  }
  if (accessor.sparse.isSparse) replaceSparse(file, accessor, elements);
  if (!std::ranges::all_of(elements.values, [](float value) { return std::isfinite(value); })) {
    file.fail("accessor " + std::to_string(index) + " holds numbers that are not finite");
  }
  return elements;
}

std::vector<std::uint32_t> readIndices(const GltfFile& file, int index) {
  const tinygltf::Accessor& accessor = checked(file, index);
  if (accessor.type != TINYGLTF_TYPE_SCALAR) file.fail("indices are not scalars");
  const Run run =
      runIn(file, accessor.bufferView, accessor.byteOffset, accessor.count, bytesOf(file, accessor.componentType));
  return integersIn(file, run, accessor.componentType, accessor.count);
}

}  // namespace grove::models
