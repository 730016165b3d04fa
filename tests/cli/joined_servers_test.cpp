#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "cli/program.h"
#include "cli/small_scene.h"

namespace grove::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What the scripts share: `owns_world` and `serves NAME OPTIONS` start processes of the small scene, whose output is
/// in NAME.out, their number in $pid_NAME; `world_of NAME` prints what a server's report says of its world.
std::string processesOf(const SmallScene& scene) {
  return "folder=$(mktemp -d); cd $folder; trap 'kill -KILL $(jobs -p) 2>/dev/null; rm -r $folder' EXIT\n"
         "starts() { local name=$1; shift; " GROVE_BINARY " \"$@\" --scene " +
         scene.path() +
         " >$name.out 2>&1 & eval pid_$name=$!\n"
         "  until grep -qs '^listening' $name.out; do sleep 0.1; kill -0 $! || return; done; }\n"
         "port_of() { sed -n \"s/^$1.*:\\([0-9]*\\).*/\\1/p\" $2.out; }\n"
         "owns_world() { starts world world --listen 127.0.0.1:$1; at=$(port_of listening world); }\n"
         "serves() { local name=$1; shift; starts $name serve --listen 127.0.0.1:0 \"$@\"; }\n"
         "world_of() { exec 3<>/dev/tcp/127.0.0.1/$(port_of operator $1)\n"
         "  printf 'GET /statistics.json HTTP/1.1\\r\\nHost: 127.0.0.1\\r\\nConnection: close\\r\\n\\r\\n' >&3\n"
         "  grep -ao '\"world\":{[^}]*}' <&3; }\n"
         "until_world() { for try in {1..300}; do [[ $(world_of $1) == *$2* ]] && return; sleep 0.1; done; echo never: "
         "$2;"
         " world_of $1; }\n"
         "visit() { " GROVE_BINARY
         " load ws://127.0.0.1:$(port_of listening $1)/ --sessions $2 --seconds $3 --width 320 --height 180 --json"
         " 2>/dev/null | grep -o '\"errors\":[0-9]*'; }\n";
}

TEST(JoinedServers, ShowOneWorldAndOutliveItsOwner) {
  const SmallScene scene;
  const Outcome outcome = shell(processesOf(scene) +
                                "owns_world 0; serves a --join 127.0.0.1:$at; serves b --join 127.0.0.1:$at\n"
                                "visit a 2 25 & visit_a=$!; visit b 1 25 & visit_b=$!\n"
                                "until_world a 'joined\",\"visitors\":3'; until_world b 'joined\",\"visitors\":3'\n"
                                "kill -KILL $pid_world; until_world a lost; until_world b lost\n"
                                "owns_world $at; until_world a 'joined\",\"visitors\":3'; "
                                "until_world b 'joined\",\"visitors\":3'\n"
                                "wait $visit_a $visit_b; cat a.out b.out >&2; echo done");
  EXPECT_EQ(outcome.output, "\"errors\":0\n\"errors\":0\ndone\n") << "no visitor noticed";
}

TEST(JoinedServers, AServerSharesItsOwnWorld) {
  const SmallScene scene;
  const Outcome outcome = shell(processesOf(scene) +
                                "serves a --share 127.0.0.1:0; at=$(port_of 'the world' a)\n"
                                "serves b --join 127.0.0.1:$at; visit a 1 6 & visit_a=$!\n"
                                "until_world b 'joined\",\"visitors\":1'; wait $visit_a; echo done");
  EXPECT_EQ(outcome.output, "\"errors\":0\ndone\n");
}

TEST(JoinedServers, SayWhyTheyAreAlone) {
  const SmallScene scene;
  const Outcome outcome = shell(
      processesOf(scene) + "serves a --join 127.0.0.1:1; world_of a\n" GROVE_BINARY
                           " world --listen 127.0.0.1:0 >world.out 2>&1 &\n"
                           "until grep -qs '^listening' world.out; do sleep 0.1; done; at=$(port_of listening world)\n"
                           "serves b --join 127.0.0.1:$at; until_world b refused; world_of b; visit b 1 1");
  EXPECT_THAT(outcome.output, HasSubstr("connecting")) << "nobody is there";
  EXPECT_THAT(outcome.output, HasSubstr("it shows another scene"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("never")));
  EXPECT_THAT(outcome.output, HasSubstr("\"errors\":0")) << "its own visitors see it nevertheless";
}

}  // namespace
}  // namespace grove::cli
