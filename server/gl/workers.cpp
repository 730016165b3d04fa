#include "gl/workers.h"

#include <pthread.h>

#include <cassert>
#include <cstdlib>
#include <latch>
#include <utility>

namespace grove::gl {
namespace {

constexpr int kDefaultCount = 2;

// Thread-local, because tasks have no arguments.
thread_local Workers::Local* current = nullptr;

}  // namespace

Workers::Workers(ContextKind kind, const ShaderLibrary& shaders, int count)
    : ownTasks_(static_cast<std::size_t>(count > 0 ? count : kDefaultCount)) {
  setenv("LP_NUM_THREADS", "0", 0);
  threads_.reserve(ownTasks_.size());
  try {
    // In order: drivers make a second context safely, but some fail when two are made at once.
    for (std::size_t index = 0; index < ownTasks_.size(); ++index) {
      std::promise<void> started;
      std::future<void> ready = started.get_future();
      threads_.emplace_back([this, kind, &shaders, index, promise = std::move(started)]() mutable {
        run(kind, shaders, index, std::move(promise));
      });
      pthread_setname_np(threads_.back().native_handle(), "grove-gl");
      ready.get();
    }
  } catch (...) {
    stop();
    throw;
  }
}

Workers::~Workers() { stop(); }

void Workers::stop() noexcept {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::enqueue(std::function<void()> task, Place place) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.insert(place == Place::kFirst ? tasks_.begin() : tasks_.end(), std::move(task));
  }
  // A worker's own tasks wait on the same condition.
  wake_.notify_all();
}

void Workers::runOnEach(const std::function<void(Local&)>& task) {
  assert(current == nullptr && "a worker would wait for itself");
  std::latch done(static_cast<std::ptrdiff_t>(ownTasks_.size()));
  {
    const std::lock_guard lock(mutex_);
    for (auto& own : ownTasks_) {
      own.push_back([&] {
        task(*current);
        done.count_down();
      });
    }
  }
  wake_.notify_all();
  done.wait();
}

Workers::Local& Workers::local() {
  assert(current != nullptr && "not on a GL worker");
  return *current;
}

void Workers::run(ContextKind kind, const ShaderLibrary& shaders, std::size_t index, std::promise<void> started) {
  std::optional<Context> context;
  try {
    context.emplace(kind, static_cast<int>(index));
  } catch (...) {
    started.set_exception(std::current_exception());
    return;
  }
  if (index == 0) {
    description_ = context->description();
    software_ = context->softwareRendered();
  }
  Local local{*context, context->api(), shaders, static_cast<int>(index)};
  current = &local;
  started.set_value();
  serve(ownTasks_[index]);
  current = nullptr;
}

void Workers::serve(std::deque<std::function<void()>>& own) {
  for (;;) {
    std::function<void()> task;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stopping_ || !own.empty() || !tasks_.empty(); });
      auto& from = own.empty() ? tasks_ : own;
      if (from.empty()) return;
      task = std::move(from.front());
      from.pop_front();
    }
    task();
  }
}

}  // namespace grove::gl
