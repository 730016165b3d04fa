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

/// Keeps a frontend process's shared data: at most `maxBytes`, least recently used dropped first. An object's own data,
/// under the empty key, is never dropped, because there is one of each. Dropped data lives until its last use ends.
/// Thread-safe.
///
/// Sends one request however many visitors want the same data at once. Fetches an announced change as soon as the
/// present data has been used; until it arrives, the present data remains. Arriving data replaces it whatever its
/// version, because a wrong version of a backend node must not stay for ever.
///
/// Subscribes to clocked data at its second fetch: then the node pushes each version. The store unsubscribes when the
/// last kMaxUnused versions were not used. If a version cannot be unpacked, an earlier one was lost, and the store
/// subscribes again.
class SharedStore {
 public:
  static constexpr std::size_t kMaxUnused = 30;

  /// Sends a message to the object's backend node; returns false, or throws, if it is refused.
  using Send = std::function<bool(ToBackend)>;
  /// Receives the data or a failure, once: at once, or on the thread that receives it, or when the data is requested
  /// again after the deadline of the waiter's frame. Must not block.
  using Waiter = std::function<void(const Payload&)>;

  SharedStore(std::size_t maxBytes, Send send) : maxBytes_(maxBytes), send_(std::move(send)) {}

  /// Returns the data; null if it is missing.
  [[nodiscard]] std::shared_ptr<const SharedData> find(const SharedKey& what);

  /// The same, without marking it as used; null also if it is of an earlier epoch of its node.
  [[nodiscard]] std::shared_ptr<const SharedData> known(const SharedKey& what);

  /// Passes the requested data to `waiter`. The request has a view. The store sends the request unless it has the data
  /// or has already requested it, and sends it again after a frame's deadline.
  void get(const Request& request, Waiter waiter);

  /// Returns whether the store expects it: it is requested, or it is pushed and subscribed to.
  [[nodiscard]] bool awaits(const Result& result);

  /// Stores a result of a backend node. Returns false and stores nothing if the store does not expect it. If such a
  /// result was pushed, unsubscribes from its key.
  [[nodiscard]] bool put(const Result& result);

  /// A link to a backend node is restored, and announcements may have been lost: marks the data of its objects as
  /// stale. The next use fetches it again; until it arrives, frames show the stale data. If the node has `restarted`,
  /// its versions start again, so the fetch requests full data instead of a difference.
  void renew(const std::function<bool(world::ObjectId)>& isOfNode, bool restarted);

  /// A backend node announces another version.
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
    bool used = false;       ///< since it arrived
    bool isForeign = false;  ///< its version is of an earlier epoch of its node
    bool isSubscribed = false;
    std::size_t pushed = 0;  ///< versions since the subscription
    std::size_t unused = 0;  ///< of these, the newest that were not used
    /// The version to name to the node, which does not know versions of an earlier epoch.
    [[nodiscard]] Version known() const { return isForeign ? 0 : data->version(); }
  };
  struct Waiting {
    double deadline = 0.0;  ///< of its frame
    Waiter waiter;
  };
  struct Pending {
    double deadline = 0.0;
    Version announced = 0;  ///< meanwhile; the arriving data may be older
    bool subscribes = false;
    std::vector<Waiting> waiting;
  };
  struct Found {
    std::shared_ptr<const SharedData> data;
    std::optional<Request> newer = {};  ///< to be sent by the caller
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
  /// Removes and returns those whose frames have ended.
  [[nodiscard]] static std::vector<Waiting> takeOverdue(Pending& pending, double now);

  /// Handles pushed data.
  [[nodiscard]] bool putPushed(const Result& result);
  /// If it is refused, its waiters get a failure.
  void fetch(Request request);
  [[nodiscard]] std::vector<Waiting> takeWaiting(const SharedKey& what);

  const std::size_t maxBytes_;
  const Send send_;
  mutable std::mutex mutex_;
  LruTable<SharedKey, Entry> entries_;        ///< under non-empty keys
  std::map<world::ObjectId, Entry> objects_;  ///< own data of objects
  std::map<SharedKey, Pending> pending_;
  std::size_t bytes_ = 0;  ///< of entries_
};

}  // namespace grove::node
