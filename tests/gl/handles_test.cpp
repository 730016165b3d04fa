#include "gl/handles.h"

#include <gtest/gtest.h>

#include <type_traits>

#include "gl/context.h"

namespace grove::gl {
namespace {

static_assert(std::is_nothrow_move_constructible_v<Buffer> && std::is_nothrow_move_assignable_v<Buffer>);
static_assert(!std::is_copy_constructible_v<Buffer> && !std::is_copy_assignable_v<Buffer>);

template <class T>
class Handles : public testing::Test {
 protected:
  Context context{ContextKind::kAuto};
};

using Kinds = testing::Types<Buffer, Texture, VertexArray, FramebufferName, Handle<ProgramTraits>>;
TYPED_TEST_SUITE(Handles, Kinds);

TYPED_TEST(Handles, MoveEmptiesTheSource) {
  TypeParam first(this->context.api());
  const GLuint name = first.name();
  ASSERT_NE(name, 0U);
  TypeParam second(std::move(first));
  EXPECT_EQ(first.name(), 0U);
  EXPECT_EQ(second.name(), name);
  TypeParam third(this->context.api());
  third = std::move(second);
  EXPECT_EQ(second.name(), 0U);
  EXPECT_EQ(third.name(), name);
  EXPECT_EQ(this->context.api().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace grove::gl
