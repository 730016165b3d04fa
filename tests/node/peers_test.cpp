#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "eventually.h"
#include "node/one_node.h"

namespace grove::node {
namespace {

using testing::BoxAsks;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using tests::eventually;

/// Two frontend processes at one node, over every mix of links.
class TwoPeers : public ::testing::TestWithParam<std::tuple<TransportKind, TransportKind>> {
 protected:
  [[nodiscard]] static TransportKind first() { return std::get<0>(GetParam()); }
  [[nodiscard]] static TransportKind second() { return std::get<1>(GetParam()); }
  OneNode node;
};

TEST_P(TwoPeers, BothGetTheirPictures) {
  Process a(node, first(), 1);
  Process b(node, second(), 2);
  for (int frame = 0; frame < 5; ++frame) {
    EXPECT_EQ(a.red(), 90U);
    EXPECT_EQ(b.red(), 90U);
  }
}

TEST_P(TwoPeers, BothGetSharedDataAndHearOfItsChanges) {
  Process a(node, first(), 1, BoxAsks::kShared);
  Process b(node, second(), 2, BoxAsks::kShared);
  for (Process* process : {&a, &b, &a, &b}) EXPECT_EQ(process->red(), 90U);
  node.controls->version = 11;
  node.controls->announce({{node.scene.objects[0].id, {}}, 11});
  EXPECT_TRUE(eventually([&] { return a.red() == 100U; }));
  EXPECT_TRUE(eventually([&] { return b.red() == 100U; }));
}

TEST_P(TwoPeers, RefusedPeerDoesNotDisturbTheOther) {
  Process a(node, first(), 1);
  EXPECT_EQ(a.red(), 90U);
  RawPeer b(node, second());
  EXPECT_EQ(b.hello(2, node.scene.layout.hash + 1), "the scenes differ");
  EXPECT_EQ(a.red(), 90U);
  EXPECT_EQ(b.hello(1), "another frontend process has the number 1");
  EXPECT_EQ(a.red(), 90U);
  node.controls->announce({{node.scene.objects[0].id, {}}, 2});
  b.settle();
  EXPECT_THAT(b.messages(), IsEmpty()) << "it is none of its business";
  EXPECT_EQ(b.hello(2), "") << "with better words it is welcome";
}

TEST_P(TwoPeers, LeavingPeerCostsTheOtherNothing) {
  Process a(node, first(), 1);
  EXPECT_EQ(a.red(), 90U);
  std::weak_ptr<Transport> link;
  {
    Process b(node, second(), 2);
    link = b.link();
    node.controls->hold = true;
    ASSERT_TRUE(b.ask());
    ASSERT_TRUE(eventually([&] { return node.controls->held > 0; }));
  }
  EXPECT_EQ(node.controls->forgotten, makeId(2, 1)) << "what is kept for its visitor may go";
  ASSERT_TRUE(a.ask());
  node.controls->hold = false;
  node.controls->hold.notify_all();
  EXPECT_TRUE(eventually([&] { return link.expired(); })) << "with the last answer";
  EXPECT_TRUE(eventually([&] { return a.red() == 90U; }));
  Process again(node, second(), 2);
  EXPECT_EQ(again.red(), 90U) << "its number is free";
}

TEST_P(TwoPeers, PeersCannotUseForeignSessions) {
  Process a(node, first(), 1);
  EXPECT_EQ(a.red(), 90U);
  RawPeer b(node, second());
  ASSERT_EQ(b.hello(2), "");
  (void)b.send(Cancel{makeId(1, 1), 1000});
  (void)b.send(Forget{makeId(1, 1)});
  (void)b.send(viewOf(makeId(1, 1)));
  (void)b.send(pictureOf(node, viewOf(makeId(1, 1))));
  Request data = pictureOf(node, nullptr);
  data.shared = true;
  data.process = 1;
  (void)b.send(data);
  b.settle();
  EXPECT_EQ(node.refused(), 5);
  EXPECT_EQ(node.controls->answered, 1);
  EXPECT_EQ(node.controls->forgotten, 0U);
  EXPECT_EQ(a.red(), 90U) << "its frames have not ended";
  (void)b.send(Forget{makeId(2, 1)});
  b.settle();
  EXPECT_EQ(node.controls->forgotten, makeId(2, 1)) << "of its own it may";
}

TEST_P(TwoPeers, OnlyHelloIsAcceptedBeforeWelcome) {
  Process a(node, first(), 1);
  RawPeer b(node, second());
  const auto saysAll = [&] {
    const std::int64_t before = node.refused();
    (void)b.send(updateOf(1, makeId(2, 1)));
    (void)b.send(Quality{2});
    (void)b.send(Cancel{makeId(2, 1), 1});
    (void)b.send(Forget{makeId(2, 1)});
    (void)b.send(viewOf(makeId(2, 1)));
    (void)b.send(pictureOf(node, viewOf(makeId(2, 1))));
    b.settle();
    EXPECT_EQ(node.refused(), before + 6);
    EXPECT_THAT(node.controls->world->players(), IsEmpty());
    EXPECT_EQ(node.controls->quality, 0);
    EXPECT_EQ(node.controls->forgotten, 0U);
    EXPECT_EQ(node.controls->answered, 0);
  };
  saysAll();
  EXPECT_NE(b.hello(2, node.scene.layout.hash + 1), "");
  saysAll();
  ASSERT_EQ(b.hello(2), "");
  (void)b.send(viewOf(makeId(2, 1)));
  (void)b.send(pictureOf(node, viewOf(makeId(2, 1))));
  b.settle();
  EXPECT_EQ(node.controls->answered, 1) << "nor had it ended the frame";
}

TEST_P(TwoPeers, FirstReporterOwnsTheWorldUntilItLeaves) {
  const auto players = [&] {
    std::vector<world::PlayerId> ids;
    for (const world::Player& player : node.controls->world->players()) ids.push_back(player.id);
    return ids;
  };
  RawPeer a(node, first());
  ASSERT_EQ(a.hello(1), "");
  {
    RawPeer b(node, second());
    ASSERT_EQ(b.hello(2), "");
    (void)b.send(updateOf(~std::uint64_t{0} / 2, makeId(2, 1)));
    b.settle();
    (void)a.send(updateOf(1, makeId(1, 1)));
    a.settle();
    EXPECT_THAT(players(), ElementsAre(makeId(2, 1)));
  }
  EXPECT_THAT(players(), IsEmpty());
  (void)a.send(updateOf(2, makeId(1, 1)));
  a.settle();
  EXPECT_THAT(players(), ElementsAre(makeId(1, 1)));
}

/// Or a process on a machine that began earlier would see its neighbours' frames given up.
TEST_P(TwoPeers, ClocksArePerPeer) {
  RawPeer a(node, first());
  ASSERT_EQ(a.hello(1), "");
  Process b(node, second(), 2);
  auto update = std::make_shared<WorldUpdate>();
  update->number = 1;
  update->clock = 1.0e8;
  (void)a.send(std::shared_ptr<const WorldUpdate>(std::move(update)));
  a.settle();
  EXPECT_GE(node.controls->world->now().value_or(0.0), 1.0e8);
  EXPECT_EQ(b.red(), 90U);
  EXPECT_EQ(node.timeline.counters()["requests of ended frames"], 0);
}

TEST_P(TwoPeers, HighestRequestedQualityCounts) {
  Process a(node, first(), 1);
  {
    Process b(node, second(), 2);
    b.send(Quality{2});
    EXPECT_TRUE(eventually([&] { return node.controls->quality == 2; }));
    a.send(Quality{1});
    EXPECT_EQ(a.red(), 90U) << "so it has been heard";
    EXPECT_EQ(node.controls->quality, 2);
  }
  EXPECT_EQ(node.controls->quality, 1);
}

std::string mixName(const ::testing::TestParamInfo<std::tuple<TransportKind, TransportKind>>& info) {
  return testing::nameOf(std::get<0>(info.param)) + "And" + testing::nameOf(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(OverAllMixes, TwoPeers, ::testing::Combine(testing::kBothInMemory, testing::kBothInMemory),
                         mixName);

}  // namespace
}  // namespace grove::node
