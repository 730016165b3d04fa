#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cli/processes.h"
#include "cli/program.h"

namespace grove::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(JoinedServers, ShareOneWorldAndOutliveItsOwner) {
  const SmallScene scene;
  const Outcome outcome = shell(processesOf(scene) +
                                "owns_world 0; serves a --join 127.0.0.1:$at; serves b --join 127.0.0.1:$at\n"
                                "visit a 2 25 & visit_a=$!; visit b 1 25 & visit_b=$!\n"
                                "until_world a 'joined\",\"visitors\":3'; until_world b 'joined\",\"visitors\":3'\n"
                                "kills world; until_world a lost; until_world b lost\n"
                                "owns_world $at; until_world a 'joined\",\"visitors\":3'; "
                                "until_world b 'joined\",\"visitors\":3'\n"
                                "wait $visit_a $visit_b; cat a.out b.out >&2\n"
                                "grep -o 'the owner at 127.0.0.1:[0-9]* is [a-z]*' a.out | sed 's/.* is //'");
  EXPECT_EQ(outcome.output, "\"errors\":0\n\"errors\":0\nlost\nback\n") << "no visitor noticed";
}

TEST(JoinedServers, ServerMayOwnTheWorld) {
  const SmallScene scene;
  const Outcome outcome = shell(processesOf(scene) +
                                "serves a --share 127.0.0.1:0; at=$(port_of 'the world' a)\n"
                                "serves b --join 127.0.0.1:$at; visit a 1 6 & visit_a=$!\n"
                                "until_world b 'joined\",\"visitors\":1'; wait $visit_a; echo done");
  EXPECT_EQ(outcome.output, "\"errors\":0\ndone\n");
}

TEST(JoinedServers, ReportWhyTheyAreAlone) {
  const SmallScene scene;
  const Outcome outcome = shell(
      processesOf(scene) + "serves a --join 127.0.0.1:1; world_of a\n" GROVE_BINARY
                           " world --listen 127.0.0.1:0 >world.out 2>&1 &\n"
                           "until grep -qs '^listening' world.out; do sleep 0.1; done; at=$(port_of listening world)\n"
                           "serves b --join 127.0.0.1:$at; until_world b refused; world_of b; visit b 1 1");
  EXPECT_THAT(outcome.output, HasSubstr("connecting")) << "nobody is there";
  EXPECT_THAT(outcome.output, HasSubstr("the scenes differ"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("never")));
  EXPECT_THAT(outcome.output, HasSubstr("\"errors\":0")) << "its own visitors see it nevertheless";
}

}  // namespace
}  // namespace grove::cli
