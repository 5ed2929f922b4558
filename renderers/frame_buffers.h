// The GPU's copy of the frames of one level-of-detail method (terrain/frame.h): heights, indices and batches
// as buffers that grow, updated by the frames' dirty ranges, and meshes by their id. What draws them chooses
// the program: vertex shaders for heights include frame_heights.glsl; those for meshes take position, normal
// and first triangle at locations 0, 1 and 2; link_patches() makes those for tessellated patches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "renderers/gl.h"
#include "terrain/frame.h"

namespace terrabench {

// A buffer that is written in parts and grows to (1 + slack) times the needed size. A buffer that grew is
// empty: its owner sends the whole array again. To copy the old contents on the GPU would send less, but
// NVIDIA's driver 580 has been seen to run such a copy after the writes that follow it.
class GrowingBuffer {
 public:
  explicit GrowingBuffer(double slack = 0.5) : slack_(slack) {}
  GLuint id() const { return buffer_.id(); }
  std::size_t written() const { return written_; }  // bytes in total
  bool reserve(std::size_t bytes);                  // true: it grew and is empty
  void write(std::size_t at, const void* data, std::size_t bytes);
  template <class T>
  void replace(std::span<const T> content) {
    reserve(content.size_bytes());
    write(0, content.data(), content.size_bytes());
  }

 private:
  Buffer buffer_;
  double slack_;
  std::size_t capacity_ = 0, written_ = 0;
};

// A context must be current in all functions.
class FrameBuffers {
 public:
  FrameBuffers();

  // Takes over each frame of the method, once and in order; the first is uploaded whole. Meshes are uploaded
  // when their id is first listed and freed when it is not. Throws environment_error when the heights do not
  // fit into OpenGL's buffers. O(dirty ranges + batches + meshes).
  void upload(const Frame&);

  // Draw what was uploaded with the program in use; depth test, culling and uniforms are the caller's.
  void draw_heights();
  void draw_patches();
  void draw_meshes();
  bool has_heights() const { return !draw_commands_.empty(); }
  bool has_patches() const { return patch_count_ > 0; }
  bool has_meshes() const { return !drawn_meshes_.empty(); }

  // All bytes written to the GPU's buffers, without a few hundred bytes of uniforms per frame.
  std::size_t bytes_uploaded() const;
  // Of these, the bytes that no dirty range named: of arrays sent again because their buffer grew.
  std::size_t bytes_resent() const { return bytes_resent_; }

 private:
  // Laid out as in shaders/frame_heights.glsl.
  struct BatchRecord {
    std::int32_t level;
    std::uint32_t first_triangle;
    std::uint32_t corner;
    std::uint32_t morph;
  };
  struct LevelRecord {
    glm::ivec2 corner;
    glm::vec2 eye;
    float from, to;
    std::int32_t spacing, unused;
  };
  struct DrawCommand {
    std::uint32_t count, instances, first_index;
    std::int32_t base_vertex;
    std::uint32_t base_instance;
  };
  struct Mesh {
    Buffer positions, normals, indices;
    GLsizei index_count;
    std::uint32_t first_triangle;
    std::uint64_t listed;  // number of the last frame that listed it
  };

  void upload_indices(const Frame&);
  void upload_heights(const Frame&);
  void upload_morphs(const Frame&);
  void upload_chunk_vertices(const Frame&);
  void upload(const Frame&, const DirtyRange&);
  void check_contents(const Frame&) const;
  void upload_meshes(const Frame&, std::uint32_t first_triangle);
  std::uint32_t describe(const Frame&);

  VertexArray heights_array_, patches_array_, mesh_array_;
  GrowingBuffer indices_, batches_, levels_, commands_, morphs_, patches_, chunk_vertices_;
  GrowingBuffer heights_{0};  // grows only when a clipmap adds levels
  GrowingBuffer ground_;      // the uniform block
  GLsizei patch_count_ = 0;   // in the last frame
  std::uint64_t frames_ = 0;
  std::size_t mesh_bytes_ = 0, bytes_resent_ = 0;  // in total
  std::vector<BatchRecord> batch_records_;
  std::vector<LevelRecord> level_records_;
  std::vector<DrawCommand> draw_commands_;
  std::unordered_map<std::uint64_t, Mesh> meshes_;
  std::vector<std::uint64_t> drawn_meshes_;  // ids, in the frame's order
};

}  // namespace terrabench
