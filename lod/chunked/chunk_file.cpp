#include "lod/chunked/chunk_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "lod/chunked/chunk_mesh.h"
#include "terrain/error.h"

namespace terrabench::chunked {
namespace {

std::size_t samples_of(const PatchGrid::Patch& square) {
  return static_cast<std::size_t>(square.columns + 1) * static_cast<std::size_t>(square.rows + 1);
}

glm::vec3 normal(float slope_x, float slope_z) { return glm::normalize(glm::vec3(-slope_x, 1, -slope_z)); }

}  // namespace

Memory LoadedChunk::memory() const {
  Memory memory = payload_memory(positions, normals, own);
  memory.payload += heap_bytes(this);
  return memory;
}

ChunkFile::ChunkFile(const std::filesystem::path& path)
    : path_(path.string()), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw bad_input(std::strerror(errno), path_, "check the path");
  try {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) throw damaged(std::strerror(errno));
    read_entries(static_cast<std::uint64_t>(status.st_size));
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

ChunkFile::~ChunkFile() { close(descriptor_); }

Error ChunkFile::damaged(std::string_view what) const {
  return bad_input(what, path_, "the file of chunks is not whole: build it again");
}

void ChunkFile::read(std::uint64_t offset, std::span<std::byte> to) const {
  while (!to.empty()) {
    const ssize_t n = pread(descriptor_, to.data(), to.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw damaged(n < 0 ? std::strerror(errno) : "ends too early");
    offset += static_cast<std::uint64_t>(n);
    to = to.subspan(static_cast<std::size_t>(n));
  }
}

// Sizes are checked against the file's before anything is allocated.
void ChunkFile::read_entries(std::uint64_t size) {
  if (size < sizeof tail_) throw damaged("is no file of chunks");
  read(size - sizeof tail_, std::as_writable_bytes(std::span(&tail_, 1)));
  const auto& [magic, width, depth, side, levels, cell_x, cell_z, lowest, step, chunks, check] = tail_;
  const auto positive = [](float value) { return value > 0 && std::isfinite(value); };
  const bool sizes = width >= 2 && depth >= 2 && side >= 2 &&
                     std::has_single_bit(static_cast<unsigned>(side)) && levels >= 1 && levels <= 15 &&
                     side <= kLargestSide >> (levels - 1);
  if (magic != kMagic || !sizes || !positive(cell_x) || !positive(cell_z) || !positive(step) ||
      !std::isfinite(lowest)) {
    throw damaged("is no file of chunks");
  }
  if (chunks > (size - sizeof tail_) / sizeof(Entry) || PatchGrid{width, depth, side}.count() > chunks) {
    throw damaged("has fewer chunks than its ground");
  }
  tree_ = cdlod::NodeTree(width, depth, cell(), side, levels);
  if (tree_.count() != chunks) throw damaged("has not as many chunks as its ground");
  entries_.resize(chunks);
  const std::uint64_t end = size - sizeof tail_ - chunks * sizeof(Entry);
  read(end, std::as_writable_bytes(std::span(entries_)));
  if (check_of(entries_, tail_) != check) throw damaged("its list of chunks is damaged");
  for (std::size_t k = 0; k < chunks; ++k) {
    tree_.set_range(k, height(entries_[k].lowest), height(entries_[k].highest));
    if (entries_[k].bytes > end || entries_[k].offset > end - entries_[k].bytes ||
        2 * std::uint64_t{entries_[k].indices} > entries_[k].bytes)
      throw damaged("a chunk lies beyond its end");
  }
  for (const int z : {0, tree_.grid(0).down() - 1}) {
    for (const int x : {0, tree_.grid(0).across() - 1}) {
      const PatchGrid::Patch square = tree_.grid(0).patch(x, z);
      patterns_[static_cast<std::size_t>(tree_.grid(0).shape(square))] = make_pattern(square);
    }
  }
}

std::uint64_t ChunkFile::check_of(std::span<const Entry> entries, const Tail& tail) {
  return XXH3_64bits_withSeed(entries.data(), entries.size_bytes(),
                              XXH3_64bits(&tail, offsetof(Tail, check)));
}

std::uint32_t ChunkFile::vertices_of(const Entry& entry) {
  return (entry.bytes - entry.indices * static_cast<std::uint32_t>(sizeof(std::uint16_t))) / sizeof(Vertex);
}

ChunkFile::Pattern ChunkFile::make_pattern(const PatchGrid::Patch& square) {
  const std::vector<float> flat(static_cast<std::size_t>(square.columns + 1) *
                                static_cast<std::size_t>(square.rows + 1));
  const GroundGrid grid{.width = square.columns + 1, .depth = square.rows + 1, .heights = flat};
  Pattern pattern{exact_pattern(grid, {0, 0, square.columns, square.rows}, true).indices, {}};
  const auto vertices = static_cast<std::uint32_t>(flat.size());
  for (const std::uint32_t index : pattern.indices) {
    if (index >= vertices) pattern.border.push_back(index - vertices);
  }
  std::ranges::sort(pattern.border);
  const auto repeated = std::ranges::unique(pattern.border);
  pattern.border.erase(repeated.begin(), repeated.end());
  for (std::uint32_t& index : pattern.indices) {
    if (index < vertices) continue;
    index = vertices + static_cast<std::uint32_t>(std::ranges::lower_bound(pattern.border, index - vertices) -
                                                  pattern.border.begin());
  }
  return pattern;
}

const ChunkFile::Pattern& ChunkFile::pattern(const PatchGrid::Patch& square) const {
  return patterns_[static_cast<std::size_t>(tree_.grid(0).shape(square))];
}

std::size_t ChunkFile::heap_bytes_at_most(const ChunkPlace& at) const {
  constexpr std::size_t kRounding = 4 * 4096;  // of four blocks (terrain/memory.h)
  const PatchGrid::Patch square = tree_.grid(at.level).patch(at.x, at.z);
  const Entry& entry = entries_[number(at)];
  const std::size_t vertices =
      at.level > 0 ? vertices_of(entry) + kCorners : samples_of(square) + pattern(square).border.size();
  return sizeof(LoadedChunk) + vertices * 2 * sizeof(glm::vec3) + entry.indices * sizeof(std::uint32_t) +
         entry.bytes + kRounding;
}

std::unique_ptr<LoadedChunk> ChunkFile::load(const ChunkPlace& at) const {
  const Entry& entry = entries_[number(at)];
  std::vector<std::byte> bytes(entry.bytes);
  read(entry.offset, bytes);
  if (XXH3_64bits(bytes.data(), bytes.size()) != entry.check) throw damaged("a chunk is damaged");
  const PatchGrid::Patch square = tree_.grid(at.level).patch(at.x, at.z);
  auto chunk = std::make_unique<LoadedChunk>();
  if (at.level == 0) {
    decode_grid(ByteSource(bytes, path_), square, floor(at), *chunk);
  } else {
    decode_mesh(ByteSource(bytes, path_), entry, square, floor(at), *chunk);
  }
  return chunk;
}

glm::vec3 ChunkFile::position(const PatchGrid::Patch& square, int x, int z, float y) const {
  return {static_cast<float>(square.i0 + x) * tail_.cell_x, y,
          static_cast<float>(square.j0 + z) * tail_.cell_z};
}

// Samples by rows, with one more on each side, for normals.
void ChunkFile::decode_grid(ByteSource from, const PatchGrid::Patch& square, float floor,
                            LoadedChunk& to) const {
  const int width = square.columns + 3;
  const auto steps = from.get_array<std::uint16_t>(static_cast<std::uint64_t>(width) * (square.rows + 3));
  const Pattern& pattern = this->pattern(square);
  const std::size_t vertices = samples_of(square) + pattern.border.size();
  to.positions.reserve(vertices);
  to.normals.reserve(vertices);
  for (int z = 0; z <= square.rows; ++z) {
    for (int x = 0; x <= square.columns; ++x) {
      const std::uint16_t* const here = &steps[static_cast<std::size_t>((z + 1) * width + x + 1)];
      to.positions.push_back(position(square, x, z, height(*here)));
      to.normals.push_back(
          normal(tail_.step * static_cast<float>(here[1] - here[-1]) / (2 * tail_.cell_x),
                 tail_.step * static_cast<float>(here[width] - here[-width]) / (2 * tail_.cell_z)));
    }
  }
  for (const std::uint32_t top : pattern.border) {
    to.positions.push_back({to.positions[top].x, floor, to.positions[top].z});
    to.normals.push_back(to.normals[top]);
  }
  to.indices = pattern.indices;
}

// The vertices; then the corners on the floor, north-west, north-east, south-west, south-east; indices.
void ChunkFile::decode_mesh(ByteSource from, const Entry& entry, const PatchGrid::Patch& square, float floor,
                            LoadedChunk& to) const {
  to.positions.reserve(vertices_of(entry) + kCorners);
  to.normals.reserve(vertices_of(entry) + kCorners);
  for (std::uint32_t v = 0; v < vertices_of(entry); ++v) {
    const auto vertex = from.get<Vertex>();
    const float x = vertex.normal_x / 127.0F, z = vertex.normal_z / 127.0F;
    to.positions.push_back(position(square, vertex.x, vertex.z, height(vertex.height)));
    to.normals.push_back({x, std::sqrt(std::max(1 - x * x - z * z, 0.0F)), z});
  }
  for (int corner = 0; corner < static_cast<int>(kCorners); ++corner) {
    to.positions.push_back(position(square, corner % 2 * square.columns, corner / 2 * square.rows, floor));
    to.normals.push_back({0, 1, 0});
  }
  to.own.reserve(entry.indices);
  for (std::uint32_t k = 0; k < entry.indices; ++k) {
    to.own.push_back(from.get<std::uint16_t>());
    if (to.own.back() >= to.positions.size()) throw damaged("a chunk has an impossible index");
  }
  to.indices = to.own;
}

// A chunk beside this one lies no lower along this one's side than the ground less its error, and its error
// is at most that of the coarsest chunk that has a side on the same line.
float ChunkFile::floor(const ChunkPlace& at) const {
  float deepest = 0;
  const auto sink = [&](int level, int x, int z) {
    if (tree_.has(level, x, z)) deepest = std::max(deepest, error({level, x, z}));
  };
  // Levels up to the coarsest with a side on a line.
  const auto up = [&](int line) {
    return std::min(std::countr_zero(static_cast<unsigned>(line)), tree_.levels() - 1 - at.level);
  };
  for (const int off : {0, 1}) {  // of the line: the chunk beyond is before it or at it
    const int x_up = up(at.x + off), z_up = up(at.z + off);
    sink(at.level + x_up, ((at.x + off) >> x_up) + off - 1, at.z >> x_up);
    sink(at.level + z_up, at.x >> z_up, ((at.z + off) >> z_up) + off - 1);
  }
  return height(entries_[number(at)].lowest) - deepest;
}

Memory ChunkFile::memory() const {
  Memory memory = tree_.memory();
  memory += index_memory(entries_);
  for (const Pattern& pattern : patterns_) memory += index_memory(pattern.indices, pattern.border);
  if (path_.capacity() > std::string().capacity()) memory.index += heap_bytes(path_.data());
  return memory;
}

}  // namespace terrabench::chunked
