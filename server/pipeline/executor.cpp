#include "pipeline/executor.h"

#include <barrier>
#include <memory>

namespace grove::pipeline {

void drain(Executor& executor) {
  // Each thread takes one of these and waits for the others, so all earlier tasks have ended.
  const auto barrier = std::make_shared<std::barrier<>>(executor.width() + 1);
  for (int i = 0; i < executor.width(); ++i) {
    executor.post([barrier] { barrier->arrive_and_wait(); });
  }
  barrier->arrive_and_wait();
}

}  // namespace grove::pipeline
