#include "node/frontend/shared/shared_receiver.h"

#include "node/frontend/frontend_process.h"
#include "node/limits.h"

namespace grove::node {
namespace {

constexpr const char* kReceiver = "Shared Receiver";

}  // namespace

SharedReceiver::SharedReceiver(FrontendProcess& frontend, pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = kReceiver,
             .work = pipeline::Work::kAcrossUser,
             .capacity = kBackendQueue,
             .maxBatch = kBackendBatch,
             .finishes = true},
            executor, timeline),
      frontend_(frontend),
      timeline_(timeline) {}

void SharedReceiver::process(std::span<SharedInput> inputs, pipeline::Run&) {
  pipeline::TimedParts times(timeline_, kReceiver, pipeline::Work::kAcrossUser, {});
  for (SharedInput& input : inputs) {
    if (const auto* const renewal = std::get_if<Renewal>(&input)) {
      frontend_.shared().renew([&](world::ObjectId id) { return renewal->of.contains(id); }, renewal->isRestarted);
      continue;
    }
    auto& result = std::get<Result>(input);
    const FrontendType* const type = frontend_.typeOf(result.what.object);
    times.turnTo(type == nullptr ? std::string_view() : type->name());
    if (!take(result)) timeline_.count("unrequested shared data");
  }
}

bool SharedReceiver::take(Result& result) {
  if (frontend_.shared().awaits(result)) {
    attempt([&] { frontend_.unpack(result); }, [&](const std::string& reason) { result.payload = Failure{reason}; });
  } else if (!result.pushed) {
    return false;
  }
  beginUses(result);
  return frontend_.shared().put(result);
}

void SharedReceiver::beginUses(const Result& result) {
  const auto* const data = std::get_if<std::shared_ptr<const SharedData>>(&result.payload);
  const FrontendType* const type = frontend_.typeOf(result.what.object);
  if (result.what.key.empty() || data == nullptr || *data == nullptr || type == nullptr) return;
  timeline_.countReuse(type->name(), {.made = 1, .madeBytes = (*data)->bytes()});
  (*data)->uses().begin();
}

}  // namespace grove::node
