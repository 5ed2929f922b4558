// Chunked level of detail over ground that stays on disk (Ulrich 2002): draws what Chunked draws, from a file
// of chunks (chunk_file.h), within a budget of memory.
//
// update() never waits for the disk. It takes the chunks that have come, marks those that it wants, most
// urgent first and as far as the budget reaches, asks a thread for those that are missing (pager.h), and
// draws a chunk in place of its children until all of these are there. It wants what would be drawn if the
// eye turned around, at an error smaller by kAhead, so that children come before they are needed; a chunk is
// wanted before its children. For room, it frees the chunk that has not been wanted for longest. The coarsest
// chunks are always there.
//
// Of a frame that is not late, the error is bounded by the knob as that of Chunked is; late_frames() and
// late_chunks() count what came too late. Chunks are meshes of the frame, all that are there, drawn or not:
// a renderer has what the method has. Their four skirts are part of them. Chunks do not morph.
//
// Which chunks have come depends on the disk; once settled() after an update, further updates from there draw
// the same in every run, if the budget has room for all that is wanted. update(): O(chunks wanted · log +
// chunks there). Memory: the budget; 64 bytes per chunk of the file, half of them entries; and the lists of a
// frame.
#pragma once

#include "lod/chunked/chunk_file.h"
#include "lod/chunked/pager.h"
#include "lod/lod.h"
#include "lod/screen_bound.h"
#include "terrain/frustum.h"

namespace terrabench {

class PagedChunked : public Lod {
 public:
  static Knob knob() { return {"error", "px", 0.05, 200, 2}; }
  static constexpr double kAhead = 1.5;

  // `budget`: bytes of chunks that are there or being loaded. Loads the coarsest chunks. Throws bad_input as
  // ChunkFile does, and usage_error for a budget that the coarsest chunks alone exceed.
  PagedChunked(const std::filesystem::path&, std::size_t budget);

  // Throws bad_input when a chunk cannot be loaded.
  const Frame& update(const View&) override;
  void tune(double pixels) override { pixels_ = setting(knob(), pixels); }
  // Throws usage_error: the file of an edited ground must be built again.
  void edited(const SampleRect&) override;
  Memory memory() const override;

  // Whether the last update() found all chunks that it wanted and for which the budget has room.
  bool settled() const { return settled_; }
  // Waits for the chunks that are being loaded; the next update() takes them.
  void finish() const { pager_.finish(); }

  const chunked::ChunkFile& file() const { return file_; }
  bool is_there(const chunked::ChunkPlace& at) const { return slots_[file_.number(at)].chunk != nullptr; }
  // Of chunks that are there or being loaded; at most the budget.
  std::size_t held_bytes() const { return held_; }
  std::uint64_t late_frames() const { return late_frames_; }
  std::uint64_t late_chunks() const { return late_chunks_; }  // drawn in place of finer ones, over all frames
  std::uint64_t bytes_read() const { return bytes_read_; }
  std::uint64_t chunks_read() const { return chunks_read_; }

 private:
  struct Slot {
    std::unique_ptr<chunked::LoadedChunk> chunk;
    std::uint32_t wanted_in = 0, drawn_in = 0;  // numbers of frames
    bool asked = false, listed = false;         // listed: in the last frame
  };
  struct Wanted {
    float urgency;  // the error of the chunk above as a multiple of what is allowed
    chunked::ChunkPlace at;
  };
  struct Sights;

  Slot& slot(const chunked::ChunkPlace& at) { return slots_[file_.number(at)]; }
  template <class Use>
  void for_roots(const Use&) const;
  template <class Use>
  void for_children(const chunked::ChunkPlace&, const Use&) const;
  void take_loaded();
  void keep(const chunked::ChunkPlace&, std::unique_ptr<chunked::LoadedChunk>);
  void want(const Wanted&, bool seen, unsigned planes, const Sights&);
  void ask_for_wanted();
  bool make_room(std::size_t bytes);
  void select(const chunked::ChunkPlace&, unsigned planes, const Sights&);
  void make_frame();

  chunked::ChunkFile file_;
  std::size_t budget_, held_ = 0, asked_ = 0;  // asked_: chunks
  double pixels_ = knob().fallback;
  std::vector<Slot> slots_;                 // by number
  std::vector<chunked::ChunkPlace> there_;  // by number
  std::vector<Wanted> wanted_;
  std::vector<chunked::Pager::Page> loaded_;
  std::uint32_t frame_number_ = 1;  // of the last frame; 1: none yet
  bool settled_ = false;
  std::uint64_t late_frames_ = 0, late_chunks_ = 0, bytes_read_ = 0, chunks_read_ = 0;
  std::size_t changes_ = 0;
  std::vector<FrameMesh> meshes_;
  std::vector<DirtyRange> uploads_;
  Frame frame_;
  chunked::Pager pager_;  // last: its thread ends first
};

}  // namespace terrabench
