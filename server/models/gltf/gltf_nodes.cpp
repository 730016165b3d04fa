#include "models/gltf/gltf_nodes.h"

#include <array>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>

namespace grove::models {
namespace {

using world::Mat4;
using world::Vec3;

/// A node's numeric property, or the default if it is missing.
template <std::size_t N>
std::array<float, N> numbersOr(const GltfFile& file, const std::vector<double>& given, std::array<float, N> otherwise) {
  if (given.empty()) return otherwise;
  if (given.size() != N) file.fail("a node's transform has " + std::to_string(given.size()) + " numbers");
  for (std::size_t i = 0; i < N; ++i) otherwise[i] = static_cast<float>(given[i]);
  return otherwise;
}

Mat4 matrixOf(const GltfFile& file, const tinygltf::Node& node) {
  if (!node.matrix.empty()) {
    const auto m = numbersOr<16>(file, node.matrix, {});
    Mat4 matrix(1.0F);
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
    return matrix;
  }
  const auto t = numbersOr<3>(file, node.translation, {0, 0, 0});
  const auto r = numbersOr<4>(file, node.rotation, {0, 0, 0, 1});
  const auto s = numbersOr<3>(file, node.scale, {1, 1, 1});
  const Mat4 rotation = glm::mat4_cast(glm::normalize(glm::quat(r[3], r[0], r[1], r[2])));
  return glm::scale(glm::translate(Mat4(1.0F), Vec3(t[0], t[1], t[2])) * rotation, Vec3(s[0], s[1], s[2]));
}

std::vector<int> rootNodes(const GltfFile& file) {
  const tinygltf::Model& document = file.document;
  if (!document.scenes.empty()) {
    return file.at(document.scenes, document.defaultScene < 0 ? 0 : document.defaultScene, "scene").nodes;
  }
  std::vector<bool> isChild(document.nodes.size(), false);
  for (const tinygltf::Node& node : document.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < isChild.size())
        isChild[static_cast<std::size_t>(child)] = true;
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < isChild.size(); ++i) {
    if (!isChild[i]) roots.push_back(static_cast<int>(i));
  }
  if (roots.empty() && !isChild.empty()) file.fail("the nodes form a cycle");
  return roots;
}

}  // namespace

std::vector<MeshInstance> meshInstances(const GltfFile& file) {
  struct Pending {
    int node = 0;
    Mat4 parent{1.0F};
  };
  std::vector<Pending> pending;  // no recursion: a hostile chain of nodes may be longer than the stack
  for (const int root : rootNodes(file)) pending.push_back({root, Mat4(1.0F)});
  std::vector<bool> seen(file.document.nodes.size(), false);
  std::vector<MeshInstance> instances;
  while (!pending.empty()) {
    const Pending now = pending.back();
    pending.pop_back();
    const tinygltf::Node& node = file.at(file.document.nodes, now.node, "node");
    if (seen[static_cast<std::size_t>(now.node)]) {
      file.fail("node " + std::to_string(now.node) + " is reached twice: nodes form a cycle or share a child");
    }
    seen[static_cast<std::size_t>(now.node)] = true;
    const Mat4 matrix = now.parent * matrixOf(file, node);
    if (node.mesh >= 0) instances.push_back({node.mesh, matrix});
    for (const int child : node.children) pending.push_back({child, matrix});
  }
  return instances;
}

}  // namespace grove::models
