#include "node/transport/packed_loopback.h"

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "node/registry.h"

namespace grove::node {
namespace {

using Data = std::shared_ptr<const SimulationData>;

Data unpack(const Registry& registry, const PackedData& packed) {
  const auto type = registry.find(packed.type);
  if (!type) throw PackingError("no object type is called " + std::string(packed.type));
  return registry.type(*type).unpack(packed.bytes);
}

}  // namespace

/// What one frontend node has unpacked lately. Any thread.
class PackedLoopback::Unpacked {
 public:
  Data get(const Registry& registry, const std::shared_ptr<const PackedData>& packed) {
    const std::lock_guard lock(mutex_);
    const auto known = std::ranges::find(entries_, packed, &Entry::packed);
    if (known != entries_.end()) return known->data;
    // What nobody else holds any more has been replaced by a newer tick.
    std::erase_if(entries_, [](const Entry& entry) { return entry.packed.use_count() == 1; });
    Data data = unpack(registry, *packed);
    entries_.push_back({packed, data});
    return data;
  }

 private:
  struct Entry {
    std::shared_ptr<const PackedData> packed;
    Data data;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;
};

/// Packed data on its way, and who unpacks it.
class PackedLoopback::Parcel final : public SimulationData {
 public:
  Parcel(std::shared_ptr<const PackedData> bytes, std::shared_ptr<Unpacked> receiver)
      : bytes_(std::move(bytes)), receiver_(std::move(receiver)) {}
  [[nodiscard]] const std::shared_ptr<const PackedData>& bytes() const noexcept { return bytes_; }
  [[nodiscard]] Unpacked* receiver() const noexcept { return receiver_.get(); }

  [[nodiscard]] static const Parcel* in(const Payload& payload) {
    const auto* data = std::get_if<Data>(&payload);
    return data == nullptr ? nullptr : dynamic_cast<const Parcel*>(data->get());
  }

 private:
  std::shared_ptr<const PackedData> bytes_;
  std::shared_ptr<Unpacked> receiver_;
};

void PackedLoopback::connectBackend(world::TypeIndex type, std::shared_ptr<pipeline::Inlet<Request>> receiver) {
  local_.connectBackend(type, std::move(receiver));
}

void PackedLoopback::connectFrontend(SessionId session, std::weak_ptr<pipeline::Inlet<Result>> receiver) {
  {
    const std::unique_lock lock(mutex_);
    frontends_[session] = std::make_shared<Unpacked>();
  }
  local_.connectFrontend(session, std::move(receiver));
}

void PackedLoopback::disconnectFrontend(SessionId session) {
  local_.disconnectFrontend(session);
  const std::unique_lock lock(mutex_);
  frontends_.erase(session);
}

pipeline::PushResult PackedLoopback::send(Request request) { return local_.send(std::move(request)); }

void PackedLoopback::send(Result result) {
  if (const Parcel* parcel = Parcel::in(result.payload)) {
    const std::shared_lock lock(mutex_);
    const auto it = frontends_.find(result.session);
    if (it == frontends_.end()) return;
    result.payload = Data(std::make_shared<const Parcel>(parcel->bytes(), it->second));
  }
  local_.send(std::move(result));
}

Payload PackedLoopback::compress(Payload payload) const {
  const auto* data = std::get_if<Data>(&payload);
  if (data == nullptr || *data == nullptr) return payload;
  std::shared_ptr<const PackedData> packed = (*data)->packed(timeline_);
  if (packed == nullptr) return payload;
  return Data(std::make_shared<const Parcel>(std::move(packed), nullptr));
}

Payload PackedLoopback::decompress(Payload payload) const {
  const Parcel* parcel = Parcel::in(payload);
  if (parcel == nullptr) return payload;
  try {
    if (Unpacked* receiver = parcel->receiver()) return receiver->get(registry_, parcel->bytes());
    return unpack(registry_, *parcel->bytes());
  } catch (const PackingError& e) {
    return Failure{e.what()};
  }
}

}  // namespace grove::node
