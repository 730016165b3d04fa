#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "base/lru_table.h"
#include "node/messages/envelope.h"

namespace grove::node {

/// What a frontend process keeps of the data that serves every visitor: at most `maxBytes` of it, the least recently
/// used given up first; but an object's own data, under the empty key, stays, for there is one of each. What was given
/// up lives on as long as somebody draws it. Any thread.
///
/// However many want the same at once, it is requested once. A change that a backend node announces is fetched as soon
/// as somebody has used what is there; until it comes, that is what is there. What comes takes its place, whatever its
/// version: a version is what a backend node says, and a wrong one must not stay for ever.
///
/// What a clock changes is subscribed to when it is fetched for the second time: from then on the node pushes each
/// version. The store unsubscribes when nobody has used the last kMaxUnused versions. If one cannot be unpacked, a
/// version before it was lost, and the store subscribes again.
class SharedStore {
 public:
  static constexpr std::size_t kMaxUnused = 30;

  /// Sends a message to the object's backend node; false, or a throw, if it is refused.
  using Send = std::function<bool(ToBackend)>;
  /// Gets what was wanted, or a failure: once, on the thread that brings it, or at once; or when somebody else asks
  /// again for what has not come before the deadline of the waiter's frame. Must not block.
  using Waiter = std::function<void(const Payload&)>;

  SharedStore(std::size_t maxBytes, Send send) : maxBytes_(maxBytes), send_(std::move(send)) {}

  /// Null if it is not there.
  [[nodiscard]] std::shared_ptr<const SharedData> find(const SharedKey& what);

  /// The same, without using it; null also if it is of an earlier life of its node.
  [[nodiscard]] std::shared_ptr<const SharedData> known(const SharedKey& what);

  /// Gives `waiter` what the request, which has a view, names. It is requested unless it is there or under way; who
  /// finds it under way for longer than a frame's deadline requests it again.
  void get(const Request& request, Waiter waiter);

  /// Whether a backend node may send it: it is requested and has not come, or it is pushed and subscribed to.
  [[nodiscard]] bool awaits(const Result& result);

  /// Stores a result of a backend node. Returns false and stores nothing if the store does not expect it. If such a
  /// result was pushed, unsubscribes from its key.
  [[nodiscard]] bool put(const Result& result);

  /// A link to a backend node is restored, and announcements may have been lost: marks the data of its objects as
  /// stale. The next use fetches it again; until it arrives, frames show the stale data. If the node has `restarted`,
  /// its versions start again, so the fetch requests full data instead of a difference.
  void renew(const std::function<bool(world::ObjectId)>& isOfNode, bool restarted);

  /// A backend node has another version.
  void announced(const Announcement& announcement);

  struct Statistics {
    std::size_t bytes = 0;
    std::size_t entries = 0;
  };
  [[nodiscard]] Statistics statistics() const;

 private:
  struct Entry {
    std::shared_ptr<const SharedData> data;
    std::size_t bytes = 0;
    bool isStale = false;    ///< another version was announced
    bool used = false;       ///< since it came
    bool isForeign = false;  ///< its version is of an earlier life of its node
    bool isSubscribed = false;
    std::size_t pushed = 0;  ///< versions since it was subscribed to
    std::size_t unused = 0;  ///< of them, the last ones that nobody has used
    /// For the node, to which no version of an earlier life means anything.
    [[nodiscard]] Version known() const { return isForeign ? 0 : data->version(); }
  };
  struct Waiting {
    double deadline = 0.0;  ///< of its frame
    Waiter waiter;
  };
  struct Pending {
    double deadline = 0.0;
    Version announced = 0;  ///< meanwhile: what comes may have been made before that
    bool subscribes = false;
    std::vector<Waiting> waiting;
  };
  struct Found {
    std::shared_ptr<const SharedData> data;
    std::optional<Request> newer = {};  ///< to be sent by who found it
  };
  // These with mutex_ held.
  [[nodiscard]] Found use(const SharedKey& what);
  [[nodiscard]] Entry* entryOf(const SharedKey& what);
  /// Returns a request for a newer version and marks it as pending. Returns nothing if none is to be fetched now.
  [[nodiscard]] std::optional<Request> newerThan(const SharedKey& what, const Entry& entry);
  /// Stores a pushed version that follows the last one. Returns the message to send to the node, if any.
  [[nodiscard]] std::optional<ToBackend> keepPushed(const SharedKey& what, std::shared_ptr<const SharedData> data,
                                                    std::vector<Entry>& discarded);
  /// `discarded` gets what it replaces.
  void keep(const SharedKey& what, Entry entry, std::vector<Entry>& discarded);
  void makeRoom(std::vector<Entry>& discarded);
  /// Those whose frames are over.
  [[nodiscard]] static std::vector<Waiting> takeOverdue(Pending& pending, double now);

  /// Takes what is subscribed to.
  [[nodiscard]] bool putPushed(const Result& result);
  /// Who waits for it gets a failure if it is refused.
  void fetch(Request request);
  [[nodiscard]] std::vector<Waiting> takeWaiting(const SharedKey& what);

  const std::size_t maxBytes_;
  const Send send_;
  mutable std::mutex mutex_;
  LruTable<SharedKey, Entry> entries_;        ///< under keys that are not empty
  std::map<world::ObjectId, Entry> objects_;  ///< their own data
  std::map<SharedKey, Pending> pending_;
  std::size_t bytes_ = 0;  ///< of entries_
};

}  // namespace grove::node
