#include "gl/workers.h"

#include <gtest/gtest.h>

#include <future>
#include <mutex>
#include <set>

#include "gl/triangle.h"

namespace grove::gl {
namespace {

TEST(Workers, RunTasksInOrderOnTheirOwnThread) {
  const ShaderLibrary shaders;
  std::vector<int> order;
  std::set<std::thread::id> threads;
  {
    Workers workers(ContextKind::kAuto, shaders, 1);
    for (int i = 0; i < 20; ++i) {
      workers.post([&, i] {
        order.push_back(i);
        threads.insert(std::this_thread::get_id());
      });
    }
  }
  EXPECT_EQ(threads.size(), 1U);
  EXPECT_EQ(threads.count(std::this_thread::get_id()), 0U);
  ASSERT_EQ(order.size(), 20U);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
}

TEST(Workers, EachHasItsOwnContext) {
  const ShaderLibrary shaders;
  Workers workers(ContextKind::kAuto, shaders, 2);
  EXPECT_EQ(workers.width(), 2);
  std::mutex mutex;
  std::set<const Context*> contexts;
  std::set<int> indices;
  std::vector<TrianglePicture> pictures;
  workers.runOnEach([&](Workers::Local& local) {
    TrianglePicture picture = drawTriangles(local.api);
    const std::lock_guard lock(mutex);
    contexts.insert(&local.context);
    indices.insert(local.index);
    EXPECT_EQ(&Workers::local(), &local);
    pictures.push_back(std::move(picture));
  });
  EXPECT_EQ(contexts.size(), 2U);
  EXPECT_EQ(indices, (std::set<int>{0, 1}));
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[0].colour, pictures[1].colour);
}

TEST(Workers, DescribeTheirContext) {
  const ShaderLibrary shaders;
  const Workers workers(ContextKind::kOsmesa, shaders);
  EXPECT_TRUE(workers.description().starts_with("OSMesa")) << workers.description();
  EXPECT_TRUE(workers.softwareRendered());
}

}  // namespace
}  // namespace grove::gl
