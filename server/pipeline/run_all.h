#pragma once

#include <cstddef>
#include <functional>

namespace grove::pipeline {

class Executor;

/// Calls body(i) for each i below `count` on an executor's threads, the lower ones first, and waits for all. If calls
/// throw, no new ones are started and the first exception is rethrown here. Not on one of the executor's threads.
void runAll(Executor& executor, std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace grove::pipeline
