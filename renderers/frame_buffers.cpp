#include "renderers/frame_buffers.h"

#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "terrain/error.h"

namespace terrabench {
namespace {

// Laid out as the block Ground of shaders/ground_block.glsl.
struct GroundBlock {
  glm::ivec2 samples;
  glm::vec2 cell;
  glm::ivec2 first, last, origin;
  std::int32_t side, patch_side;
  glm::vec3 eye;
  std::int32_t morph_ranges;
};
static_assert(sizeof(GroundBlock) == 64);
static_assert(sizeof(PatchMorph) == 5 * sizeof(float));

constexpr GLuint kGroundBinding = 1;
constexpr GLuint kFirstTriangle = 2;  // location of the vertex attribute

#ifdef NDEBUG
constexpr bool kChecked = false;
#else
constexpr bool kChecked = true;  // reads every frame's arrays back
#endif

std::size_t heights_of(const Frame& frame) {  // bytes
  std::size_t bytes = frame.grid.heights.size_bytes();
  for (const ClipLevel& level : frame.clip_levels) bytes += level.heights.size_bytes();
  return bytes;
}

// None if the GPU's tessellator makes the triangles.
std::span<const std::uint32_t> sent_indices(const Frame& frame) {
  return frame.patches.empty() ? frame.indices : std::span<const std::uint32_t>();
}

void check_room(std::size_t bytes) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  if (bytes > static_cast<std::size_t>(most)) {
    throw environment_error(
        fmt::format("heights need {} MiB, but this OpenGL's storage blocks hold at most {} MiB", bytes >> 20,
                    most >> 20),
        "", "draw a smaller terrain, or use a method that stores only a part of it (clipmap)");
  }
}

}  // namespace

bool GrowingBuffer::reserve(std::size_t bytes) {
  if (bytes <= capacity_) return false;
  const std::size_t capacity = bytes + static_cast<std::size_t>(static_cast<double>(bytes) * slack_);
  buffer_ = Buffer();
  glNamedBufferStorage(buffer_.id(), static_cast<GLsizeiptr>(capacity), nullptr, GL_DYNAMIC_STORAGE_BIT);
  check_gl("reserving memory for the terrain");
  capacity_ = capacity;
  return true;
}

void GrowingBuffer::write(std::size_t at, const void* data, std::size_t bytes) {
  if (bytes == 0) return;
  glNamedBufferSubData(buffer_.id(), static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes), data);
  written_ += bytes;
}

FrameBuffers::FrameBuffers() {
  static_assert(sizeof(BatchRecord) + sizeof(DrawCommand) == kBytesPerBatch);
  static_assert(sizeof(LevelRecord) == kBytesPerClipLevel);
  // The batch's number reaches the vertices as a per-instance attribute, read from base_instance of the
  // command.
  glVertexArrayAttribIFormat(heights_array_.id(), 0, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(heights_array_.id(), 0, 0);
  glVertexArrayBindingDivisor(heights_array_.id(), 0, 1);
  glEnableVertexArrayAttrib(heights_array_.id(), 0);
  static_assert(sizeof(TessellatedPatch) == 2 * sizeof(std::uint32_t));
  glVertexArrayAttribIFormat(patches_array_.id(), 0, 2, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(patches_array_.id(), 0, 0);
  glEnableVertexArrayAttrib(patches_array_.id(), 0);
  for (const GLuint attribute : {0U, 1U}) {
    glVertexArrayAttribFormat(mesh_array_.id(), attribute, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(mesh_array_.id(), attribute, attribute);
    glEnableVertexArrayAttrib(mesh_array_.id(), attribute);
  }
  // Bound in every frame, even without clip levels or morphs, so they must not be empty.
  levels_.reserve(sizeof(LevelRecord));
  morphs_.reserve(sizeof(PatchMorph));
  chunk_vertices_.reserve(sizeof(ChunkVertex));
  ground_.reserve(sizeof(GroundBlock));
}

void FrameBuffers::upload_indices(const Frame& frame) {
  const std::span<const std::uint32_t> indices = sent_indices(frame);
  indices_.write(0, indices.data(), indices.size_bytes());
}

void FrameBuffers::upload_heights(const Frame& frame) {
  heights_.write(0, frame.grid.heights.data(), frame.grid.heights.size_bytes());
  std::size_t at = 0;
  for (const ClipLevel& level : frame.clip_levels) {
    heights_.write(at, level.heights.data(), level.heights.size_bytes());
    at += level.heights.size_bytes();
  }
}

void FrameBuffers::upload_morphs(const Frame& frame) {
  morphs_.write(0, frame.morphs.data(), frame.morphs.size_bytes());
}

void FrameBuffers::upload_chunk_vertices(const Frame& frame) {
  chunk_vertices_.write(0, frame.chunk_vertices.data(), frame.chunk_vertices.size_bytes());
}

void FrameBuffers::upload(const Frame& frame, const DirtyRange& range) {
  constexpr std::size_t kWord = 4;
  switch (range.target) {
    case DirtyRange::Target::kIndices:
      indices_.write(range.first * kWord, &frame.indices[range.first], range.count * kWord);
      break;
    case DirtyRange::Target::kHeights:
      heights_.write(range.first * kWord, &frame.grid.heights[range.first], range.count * kWord);
      break;
    case DirtyRange::Target::kMorphs:
      morphs_.write(range.first * sizeof(PatchMorph), &frame.morphs[range.first], range.bytes());
      break;
    case DirtyRange::Target::kChunkVertices:
      chunk_vertices_.write(range.first * sizeof(ChunkVertex), &frame.chunk_vertices[range.first],
                            range.bytes());
      break;
    case DirtyRange::Target::kMesh:
      break;
    case DirtyRange::Target::kClipLevel:
      const ClipLevel& level = frame.clip_levels[range.level];
      for (std::size_t row = range.z; row < std::size_t{range.z} + range.depth; ++row) {
        const std::size_t at = row * level.side + range.x;
        const std::size_t before = std::size_t{range.level} * level.heights.size();
        heights_.write((before + at) * kWord, &level.heights[at], range.width * kWord);
      }
  }
}

void FrameBuffers::upload(const Frame& frame) {
  const std::size_t height_bytes = heights_of(frame);
  check_room(height_bytes);
  // In a later frame, a buffer that grew is sent whole, and its dirty ranges with it.
  const bool first = frames_++ == 0;
  const bool indices = indices_.reserve(sent_indices(frame).size_bytes()) || first;
  const bool heights = heights_.reserve(height_bytes) || first;
  const bool morphs = morphs_.reserve(frame.morphs.size_bytes()) || first;
  const bool vertices = chunk_vertices_.reserve(frame.chunk_vertices.size_bytes()) || first;
  const std::size_t before = bytes_uploaded();
  if (indices) upload_indices(frame);
  if (heights) upload_heights(frame);
  if (morphs) upload_morphs(frame);
  if (vertices) upload_chunk_vertices(frame);
  std::size_t named = 0;  // bytes
  for (const DirtyRange& range : frame.uploads) {
    if (range.target == DirtyRange::Target::kMesh) continue;  // upload_meshes() sends it
    const bool whole = range.target == DirtyRange::Target::kIndices         ? indices
                       : range.target == DirtyRange::Target::kMorphs        ? morphs
                       : range.target == DirtyRange::Target::kChunkVertices ? vertices
                                                                            : heights;
    if (!whole) upload(frame, range);
    named += range.bytes();
  }
  const std::size_t sent = bytes_uploaded() - before;
  if (!first && sent > named) bytes_resent_ += sent - named;
  upload_meshes(frame, describe(frame));
  if constexpr (kChecked) check_contents(frame);
}

// That the GPU's arrays are the frame's. A driver may run commands in another order than given, or a dirty
// range may be missing.
void FrameBuffers::check_contents(const Frame& frame) const {
  const auto compare = [](const GrowingBuffer& buffer, std::size_t at, auto content, std::string_view what) {
    std::vector<std::byte> kept(content.size_bytes());
    if (kept.empty()) return;
    glGetNamedBufferSubData(buffer.id(), static_cast<GLintptr>(at), static_cast<GLsizeiptr>(kept.size()),
                            kept.data());
    check_gl("reading the terrain back");
    if (std::memcmp(kept.data(), content.data(), kept.size()) == 0) return;
    throw environment_error(
        fmt::format("the GPU's {} are not the frame's", what), "renderer",
        "either the level-of-detail method changed them without naming the range in Frame::uploads, or the "
        "driver changed the order of commands: report the method, and the renderer's name and version");
  };
  for (const Batch& batch : frame.patches.empty() ? frame.batches : std::span<const Batch>()) {
    compare(indices_, batch.first_index * sizeof(std::uint32_t),
            frame.indices.subspan(batch.first_index, batch.index_count), "indices");
  }
  compare(patches_, 0, frame.patches, "patches");
  compare(heights_, 0, frame.grid.heights, "heights");
  compare(morphs_, 0, frame.morphs, "morphs");
  compare(chunk_vertices_, 0, frame.chunk_vertices, "chunk vertices");
  // Of clip levels what this frame named: beyond its window a level's array holds anything.
  for (const DirtyRange& range : frame.uploads) {
    if (range.target != DirtyRange::Target::kClipLevel) continue;
    const ClipLevel& level = frame.clip_levels[range.level];
    for (std::size_t row = range.z; row < std::size_t{range.z} + range.depth; ++row) {
      const std::size_t first = row * level.side + range.x;
      compare(heights_, range.level * level.heights.size_bytes() + first * sizeof(float),
              level.heights.subspan(first, range.width), "heights");
    }
  }
}

// Returns the number of triangles in the batches.
std::uint32_t FrameBuffers::describe(const Frame& frame) {
  batch_records_.clear();
  draw_commands_.clear();
  std::uint32_t triangle = 0;
  for (const Batch& batch : frame.batches) {
    const auto number = static_cast<std::uint32_t>(draw_commands_.size());
    if (frame.patches.empty()) {
      const std::uint32_t corner =
          frame.chunk_vertices.empty() ? batch.base_vertex : std::bit_cast<std::uint32_t>(batch.share);
      batch_records_.push_back({batch.level, triangle, corner, batch.morph});
      draw_commands_.push_back(
          {batch.index_count, 1, batch.first_index, static_cast<std::int32_t>(batch.base_vertex), number});
    }
    triangle += batch.index_count / 3;
  }
  level_records_.clear();
  for (const ClipLevel& level : frame.clip_levels) {
    level_records_.push_back({level.corner, level.eye, level.from, level.to, level.spacing, 0});
  }
  for (const MorphRange& range : frame.morph_ranges) {
    level_records_.push_back({{}, {}, range.from, range.to, 1, 0});
  }
  batches_.replace(std::span<const BatchRecord>(batch_records_));
  levels_.replace(std::span<const LevelRecord>(level_records_));
  commands_.replace(std::span<const DrawCommand>(draw_commands_));
  patches_.replace(frame.patches);
  patch_count_ = static_cast<GLsizei>(frame.patches.size());
  const GroundBlock block{{frame.grid.width, frame.grid.depth},
                          {frame.cell_x, frame.cell_z},
                          frame.first,
                          frame.last,
                          frame.origin,
                          frame.clip_levels.empty() ? 0 : frame.clip_levels.front().side,
                          frame.patch_side,
                          frame.eye,
                          static_cast<std::int32_t>(frame.morph_ranges.size())};
  ground_.write(0, &block, sizeof block);
  return triangle;
}

void FrameBuffers::upload_meshes(const Frame& frame, std::uint32_t first_triangle) {
  drawn_meshes_.clear();
  for (const FrameMesh& mesh : frame.meshes) {
    if (mesh.indices.empty()) continue;
    auto at = meshes_.find(mesh.id);
    if (at == meshes_.end()) {
      at = meshes_
               .emplace(mesh.id,
                        Mesh{make_buffer(mesh.positions), make_buffer(mesh.normals),
                             make_buffer(mesh.indices), static_cast<GLsizei>(mesh.indices.size()), 0, 0})
               .first;
      check_gl("reserving memory for a mesh of the terrain");
      mesh_bytes_ += mesh.positions.size_bytes() + mesh.normals.size_bytes() + mesh.indices.size_bytes();
    }
    at->second.listed = frames_;
    if (!mesh.drawn) continue;
    at->second.first_triangle = first_triangle;
    drawn_meshes_.push_back(mesh.id);
    first_triangle += static_cast<std::uint32_t>(mesh.indices.size() / 3);
  }
  std::erase_if(meshes_, [&](const auto& entry) { return entry.second.listed != frames_; });
}

void FrameBuffers::draw_heights() {
  if (draw_commands_.empty()) return;
  glVertexArrayElementBuffer(heights_array_.id(), indices_.id());
  glVertexArrayVertexBuffer(heights_array_.id(), 0, commands_.id(), offsetof(DrawCommand, base_instance),
                            sizeof(DrawCommand));
  glBindVertexArray(heights_array_.id());
  glBindBufferBase(GL_UNIFORM_BUFFER, kGroundBinding, ground_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, heights_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, batches_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, levels_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, morphs_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, chunk_vertices_.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                              static_cast<GLsizei>(draw_commands_.size()), 0);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  glBindVertexArray(0);
  check_gl("drawing the terrain");
}

void FrameBuffers::draw_patches() {
  if (patch_count_ == 0) return;
  glVertexArrayVertexBuffer(patches_array_.id(), 0, patches_.id(), 0, sizeof(TessellatedPatch));
  glBindVertexArray(patches_array_.id());
  glBindBufferBase(GL_UNIFORM_BUFFER, kGroundBinding, ground_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, heights_.id());
  glPatchParameteri(GL_PATCH_VERTICES, 1);
  glDrawArrays(GL_PATCHES, 0, patch_count_);
  glBindVertexArray(0);
  check_gl("drawing the terrain's patches");
}

void FrameBuffers::draw_meshes() {
  if (drawn_meshes_.empty()) return;
  glBindVertexArray(mesh_array_.id());
  for (const std::uint64_t id : drawn_meshes_) {
    const Mesh& mesh = meshes_.at(id);
    glVertexArrayVertexBuffer(mesh_array_.id(), 0, mesh.positions.id(), 0, sizeof(glm::vec3));
    glVertexArrayVertexBuffer(mesh_array_.id(), 1, mesh.normals.id(), 0, sizeof(glm::vec3));
    glVertexArrayElementBuffer(mesh_array_.id(), mesh.indices.id());
    glVertexAttribI1ui(kFirstTriangle, mesh.first_triangle);
    glDrawElements(GL_TRIANGLES, mesh.index_count, GL_UNSIGNED_INT, nullptr);
  }
  glBindVertexArray(0);
  check_gl("drawing the terrain's meshes");
}

std::size_t FrameBuffers::bytes_uploaded() const {
  std::size_t bytes = mesh_bytes_;
  for (const GrowingBuffer* buffer :
       {&indices_, &heights_, &morphs_, &patches_, &chunk_vertices_, &batches_, &levels_, &commands_}) {
    bytes += buffer->written();
  }
  return bytes;
}

}  // namespace terrabench
