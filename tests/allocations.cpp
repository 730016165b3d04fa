#include "allocations.h"

#include <cstdlib>
#include <new>

namespace grove::tests {
namespace {

thread_local std::size_t allocated = 0;

}  // namespace

Allocations::Allocations() : before_(allocated) {}

std::size_t Allocations::bytes() const { return allocated - before_; }

}  // namespace grove::tests

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

void* operator new(std::size_t bytes) {
  grove::tests::allocated += bytes;
  void* const memory = std::malloc(bytes == 0 ? 1 : bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

#endif
