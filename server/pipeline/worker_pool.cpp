#include "pipeline/worker_pool.h"

#include <pthread.h>

#include <cassert>
#include <utility>

#include "pipeline/clocks.h"

namespace grove::pipeline {

WorkerPool::WorkerPool(int threads, const std::string& name, IdleListener idleListener, Load load)
    : idleListener_(std::move(idleListener)), load_(load), busy_(threads) {
  assert(threads > 0);
  threads_.reserve(static_cast<std::size_t>(threads));
  try {
    for (int i = 0; i < threads; ++i) {
      threads_.emplace_back([this] { run(); });
      pthread_setname_np(threads_.back().native_handle(), name.substr(0, 15).c_str());
    }
  } catch (...) {
    stop();
    throw;
  }
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::stop() noexcept {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::enqueue(std::function<void()> task, Place place) {
  {
    const std::lock_guard lock(mutex_);
    (place == Place::kFirst ? first_ : tasks_).push_back(std::move(task));
  }
  wake_.notify_one();
}

double WorkerPool::busyShare() const {
  if (load_) return *load_;
  const std::lock_guard lock(mutex_);
  return busy_.at(wallSeconds());
}

void WorkerPool::run() {
  for (bool hadTask = false; const auto task = next(hadTask); hadTask = true) task();
}

std::function<void()> WorkerPool::next(bool hadTask) {
  std::unique_lock lock(mutex_);
  if (hadTask) busy_.end(wallSeconds());
  const bool sleeps = !hasTasks() && !stopping_ && idleListener_;
  if (sleeps) {
    lock.unlock();
    idleListener_(true);
    lock.lock();
  }
  wake_.wait(lock, [this] { return stopping_ || hasTasks(); });
  std::function<void()> task;
  if (auto& tasks = first_.empty() ? tasks_ : first_; !tasks.empty()) {
    task = std::move(tasks.front());
    tasks.pop_front();
    busy_.begin(wallSeconds());
  }
  lock.unlock();
  if (sleeps) idleListener_(false);
  return task;
}

}  // namespace grove::pipeline
