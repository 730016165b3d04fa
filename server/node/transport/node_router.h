#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <string>
#include <vector>

#include "base/log.h"
#include "node/messages/served_objects.h"
#include "node/transport/connection.h"
#include "node/transport/transport.h"

namespace grove::node {

/// A frontend process's end of links to several backend nodes, each of which serves some of the objects. Sends messages
/// about an object to the node that serves it, all others to all nodes. The nodes' last welcomes define which node
/// serves which object; a node's messages about another node's object are dropped. Any thread, except for add().
class NodeRouter final : public FrontendEnd {
 public:
  NodeRouter();
  ~NodeRouter() override;
  NodeRouter(const NodeRouter&) = delete;
  NodeRouter& operator=(const NodeRouter&) = delete;

  /// `name` is for log lines and the operator's page. Must not be called while anything is sent.
  void add(std::string name, std::shared_ptr<FrontendEnd> end);

  void connect(FrontendPort& frontend) override { frontend_.connect(frontend); }
  void leaveFrontend() override { frontend_.leave(); }
  /// Returns kClosed for a message about an object that no node serves. Accepts other messages if any node does, so a
  /// node whose link is down does not block the others.
  pipeline::PushResult send(ToBackend message) override;
  [[nodiscard]] LinkTraffic traffic() const override;

  /// One node and its link, for the operator's page.
  struct NodeLink {
    std::string name;
    std::size_t objects = 0;  ///< that it serves, without its visitors
    LinkStatus status;
    LinkTraffic traffic;
    LinkPace pace = {};
    std::optional<std::uint64_t> epoch = {};  ///< of its last welcome
    std::optional<NodeReport> report = {};    ///< the newest; empty if the node is in this process or its link is down
  };
  [[nodiscard]] std::vector<NodeLink> links() const;

  /// The newest events of one node.
  struct NodeEvents {
    std::string name;
    std::shared_ptr<const NodeTrace> trace;
    std::int64_t aheadNanoseconds = 0;  ///< the node's clock minus this process's, accurate to half a round trip
  };
  /// Requests traces from the nodes in other processes, and returns those that arrive within `max`. One thread at a
  /// time.
  [[nodiscard]] std::vector<NodeEvents> traces(std::chrono::milliseconds max);

  /// The last welcome of each node.
  [[nodiscard]] std::vector<NodeWelcome> welcomes() const;
  /// The objects of all nodes.
  [[nodiscard]] ServedObjects served() const;
  /// Describes in one line that two nodes serve one object; empty if none do. The node with the first welcome serves
  /// it.
  [[nodiscard]] std::optional<std::string> conflict() const;

 private:
  class Branch;

  void receive(Branch& from, ToFrontend message);
  [[nodiscard]] bool serves(const Branch& branch, world::ObjectId object) const;
  void welcomed(Branch& from, const NodeWelcome& welcome);
  /// With the lock held.
  void own(const Branch& branch, world::ObjectId id, const std::string& name);

  Connection<FrontendPort> frontend_;
  std::vector<std::unique_ptr<Branch>> branches_;
  mutable std::shared_mutex mutex_;
  /// All objects that show visitors are under kFirstPlayerObject.
  std::map<world::ObjectId, const Branch*> owners_;
  std::map<const Branch*, NodeWelcome> welcomes_;
  std::optional<std::string> conflict_;
  log::Limited foreign_;
};

}  // namespace grove::node
