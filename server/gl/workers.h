#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "gl/context.h"
#include "gl/shader_library.h"
#include "pipeline/executor.h"

namespace grove::gl {

/// A few threads, each with a GL context of its own that stays current there, which serve the offscreen drawing of all
/// sessions. Tasks run first in, first out.
class Workers final : public pipeline::Executor {
 public:
  /// The environment of a task, which depends on its thread.
  struct Local {
    Context& context;
    const Api& api;
    const ShaderLibrary& shaders;
    int index;  ///< 0 to width() - 1
  };

  /// `count` 0 lets the context decide: two, on software GL and on a GPU. `shaders` outlives the workers. Throws
  /// EnvironmentError if there is no GL. Unless LP_NUM_THREADS is set, makes llvmpipe rasterise on the drawing thread:
  /// then its CPU time is the task's.
  Workers(ContextKind kind, const ShaderLibrary& shaders, int count = 0);

  /// Runs the queued tasks, then joins.
  ~Workers() override;
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int width() const noexcept override { return static_cast<int>(threads_.size()); }

  /// Runs the task once on every worker and returns when all have ended. Must not be called from a worker.
  void runOnEach(const std::function<void(Local&)>& task);

  /// The environment of the calling thread, which must be one of the workers.
  [[nodiscard]] static Local& local();

  /// As of the first worker's context.
  [[nodiscard]] const std::string& description() const noexcept { return description_; }
  [[nodiscard]] bool softwareRendered() const noexcept { return software_; }

 private:
  void enqueue(std::function<void()> task, Place place) override;
  void run(ContextKind kind, const ShaderLibrary& shaders, std::size_t index, std::promise<void> started);
  void serve(std::deque<std::function<void()>>& own);
  void stop() noexcept;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  std::vector<std::deque<std::function<void()>>> ownTasks_;  // by worker, first
  bool stopping_ = false;
  std::string description_;
  bool software_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace grove::gl
