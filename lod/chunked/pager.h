// Loads chunks on a thread of its own, in the order in which they are asked for. The thread ends when nothing
// is left to load and is started again when something is; it shares nothing but what the mutex guards, and
// the file, which does not change.
#pragma once

#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "lod/chunked/chunk_file.h"

namespace terrabench::chunked {

class Pager {
 public:
  struct Page {
    ChunkPlace at;
    std::unique_ptr<LoadedChunk> chunk;
  };

  // Takes at most `most` chunks that are asked for and not yet taken. The file must outlive it.
  Pager(const ChunkFile&, std::size_t most);
  ~Pager();
  Pager(const Pager&) = delete;
  Pager& operator=(const Pager&) = delete;

  void ask(const ChunkPlace&);
  // Appends the chunks that have come. Throws what loading one threw.
  void take(std::vector<Page>& to);
  // Waits until all have come.
  void finish() const;
  Memory memory() const;  // after finish(); without the object itself

 private:
  void load();

  const ChunkFile& file_;
  std::mutex mutex_;
  std::vector<ChunkPlace> asked_;  // first in, first out; few
  std::vector<Page> come_;
  std::exception_ptr failure_;
  bool loading_ = false;
  mutable std::thread thread_;
};

}  // namespace terrabench::chunked
