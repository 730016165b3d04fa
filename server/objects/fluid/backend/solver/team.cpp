#include "objects/fluid/backend/solver/team.h"

#include <cassert>

namespace grove::objects::fluid {

Team::Team(int width) : width_(width), begin_(width), end_(width) {
  assert(width >= 1);
  try {
    for (int part = 1; part < width; ++part) threads_.emplace_back([this, part] { serve(part); });
  } catch (...) {
    for (auto missing = static_cast<std::size_t>(width - 1) - threads_.size(); missing > 0; --missing) {
      begin_.arrive_and_drop();
    }
    stop();
    throw;
  }
}

Team::~Team() { stop(); }

void Team::stop() noexcept {
  work_ = nullptr;
  if (threads_.empty()) return;
  begin_.arrive_and_wait();
  for (std::thread& thread : threads_) thread.join();
}

void Team::run(const std::function<void(int)>& work) {
  if (threads_.empty()) {
    work(0);
    return;
  }
  work_ = &work;
  begin_.arrive_and_wait();
  work(0);
  end_.arrive_and_wait();
}

void Team::serve(int part) {
  while (true) {
    begin_.arrive_and_wait();
    if (work_ == nullptr) return;
    (*work_)(part);
    end_.arrive_and_wait();
  }
}

}  // namespace grove::objects::fluid
