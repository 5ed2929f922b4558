#include "lod/chunked/pager.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace terrabench::chunked {

Pager::Pager(const ChunkFile& file, std::size_t most) : file_(file) {
  asked_.reserve(most);
  come_.reserve(most);
}

Pager::~Pager() {
  {
    const std::lock_guard lock(mutex_);
    asked_.clear();
  }
  finish();
}

void Pager::ask(const ChunkPlace& at) {
  const std::lock_guard lock(mutex_);
  asked_.push_back(at);
  if (loading_) return;
  finish();                                   // the thread needs the mutex no more
  thread_ = std::thread([this] { load(); });  // waits for the mutex
  loading_ = true;
}

void Pager::load() {
  for (;;) {
    Page page;
    {
      const std::lock_guard lock(mutex_);
      loading_ = !asked_.empty();
      if (!loading_) return;
      page.at = asked_.front();
      asked_.erase(asked_.begin());
    }
    std::exception_ptr failure;
    try {
      page.chunk = file_.load(page.at);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    if (failure) {
      failure_ = failure;
      asked_.clear();
    } else {
      come_.push_back(std::move(page));
    }
  }
}

void Pager::take(std::vector<Page>& to) {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  std::ranges::move(come_, std::back_inserter(to));
  come_.clear();
}

void Pager::finish() const {
  if (thread_.joinable()) thread_.join();
}

Memory Pager::memory() const {
  Memory memory = index_memory(asked_);
  memory.index += heap_bytes(come_.data());
  for (const Page& page : come_) memory += page.chunk->memory();
  return memory;
}

}  // namespace terrabench::chunked
