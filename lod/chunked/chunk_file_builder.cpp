// Writes files of chunks (chunk_file.h).
#include <tbb/parallel_for.h>
#include <xxhash.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "lod/chunked/chunk_file.h"
#include "lod/chunked/chunk_mesh.h"

namespace terrabench::chunked {

class ChunkFileBuilder {
 public:
  ChunkFileBuilder(HeightSource& source, const ChunkFileOptions& options, const std::filesystem::path& path)
      : source_(source),
        options_(options),
        file_(path),
        width_(source.last().x + 1),
        depth_(source.last().y + 1),
        tree_(width_, depth_, {source.cell_x(), source.cell_z()}, options.side,
              cdlod::levels_of(width_, depth_, options.side, options.largest)),
        entries_(tree_.count()) {}

  void run(Progress& progress) {
    const PatchGrid& roots = tree_.grid(tree_.levels() - 1);
    progress.begin("measuring heights", roots.count());
    for_roots([&](int x, int z) {
      read_root(x, z);
      const auto [low, high] = std::ranges::minmax(samples_.heights);
      lowest_ = std::min(lowest_, low);
      highest_ = std::max(highest_, high);
      progress.advance();
    });
    choose_step();
    progress.begin("triangulating chunks", roots.count() * static_cast<std::size_t>(tree_.levels()));
    for_roots([&](int x, int z) {
      read_root(x, z);
      round_heights();
      for (int level = 0; level < tree_.levels(); ++level) {
        add_chunks(level, x, z);
        progress.advance();
      }
    });
    raise_errors();
    file_.append(std::as_bytes(std::span(entries_)));
    ChunkFile::Tail tail{ChunkFile::kMagic,
                         width_,
                         depth_,
                         options_.side,
                         tree_.levels(),
                         source_.cell_x(),
                         source_.cell_z(),
                         lowest_,
                         step_,
                         entries_.size(),
                         0};
    tail.check = ChunkFile::check_of(entries_, tail);
    file_.append(std::as_bytes(std::span(&tail, 1)));
    file_.keep();
    progress.end();
  }

 private:
  using Entry = ChunkFile::Entry;

  template <class Use>
  void for_roots(const Use& use) const {
    const PatchGrid& roots = tree_.grid(tree_.levels() - 1);
    for (int z = 0; z < roots.down(); ++z) {
      for (int x = 0; x < roots.across(); ++x) use(x, z);
    }
  }

  // With one more sample on each side, beyond the ground its border again.
  void read_root(int x, int z) {
    root_ = tree_.grid(tree_.levels() - 1).patch(x, z);
    samples_.width = root_.columns + 3;
    samples_.depth = root_.rows + 3;
    samples_.heights.resize(static_cast<std::size_t>(samples_.width) *
                            static_cast<std::size_t>(samples_.depth));
    source_.read(0, root_.i0 - 1, root_.j0 - 1, samples_.width, samples_.depth, samples_.heights.data(),
                 samples_.width);
    if (std::ranges::any_of(samples_.heights, Heightfield::is_no_data)) {
      throw usage_error("the ground has samples without a height", "", "fill them first");
    }
  }

  // So fine that the relief takes 16 bits, and that floats hold every multiple up to the farthest from 0.
  void choose_step() {
    const auto power = [](double least) { return least > 0 ? std::exp2(std::ceil(std::log2(least))) : 0; };
    const double farthest = std::max(std::abs(lowest_), std::abs(highest_));
    // One step is lost to rounding the lowest height down.
    const double step = std::max(power((double{highest_} - lowest_) / 65534), power(farthest / (1 << 23)));
    step_ = step > 0 ? static_cast<float>(step) : 1;
    lowest_ = std::floor(lowest_ / step_) * step_;
  }

  int steps(float height) const { return static_cast<int>(std::lround((height - lowest_) / step_)); }

  void round_heights() {
    for (float& height : samples_.heights) {
      const float rounded = lowest_ + step_ * static_cast<float>(steps(height));
      rounding_ = std::max(rounding_, std::abs(rounded - height));
      height = rounded;
    }
  }

  struct Encoded {
    ByteSink bytes;
    Entry entry;
  };

  void add_chunks(int level, int root_x, int root_z) {
    const PatchGrid& grid = tree_.grid(level);
    const int ratio = 1 << (tree_.levels() - 1 - level), x0 = root_x * ratio, z0 = root_z * ratio;
    const int x1 = std::min(x0 + ratio, grid.across()), z1 = std::min(z0 + ratio, grid.down());
    std::vector<Encoded> row(static_cast<std::size_t>(x1 - x0));
    for (int z = z0; z < z1; ++z) {
      tbb::parallel_for(
          x0, x1, [&](int x) { row[static_cast<std::size_t>(x - x0)] = encode(level, grid.patch(x, z)); });
      for (int x = x0; x < x1; ++x) {
        const auto& [bytes, entry] = row[static_cast<std::size_t>(x - x0)];
        Entry& kept = entries_[tree_.number(level, x, z)];
        kept = entry;
        kept.offset = end_;
        kept.bytes = static_cast<std::uint32_t>(bytes.bytes().size());
        kept.check = XXH3_64bits(bytes.bytes().data(), bytes.bytes().size());
        file_.append(bytes.bytes());
        end_ += bytes.bytes().size();
      }
    }
  }

  Encoded encode(int level, PatchGrid::Patch square) const {
    square.i0 += 1 - root_.i0;
    square.j0 += 1 - root_.j0;
    Encoded chunk;
    float low = samples_.at(square.i0, square.j0), high = low;
    for (int j = square.j0; j <= square.j0 + square.rows; ++j) {
      const float* const row = &samples_.heights[static_cast<std::size_t>(j) * samples_.width + square.i0];
      const auto [least, most] = std::minmax_element(row, row + square.columns + 1);
      low = std::min(low, *least);
      high = std::max(high, *most);
    }
    chunk.entry.lowest = static_cast<std::uint16_t>(steps(low));
    chunk.entry.highest = static_cast<std::uint16_t>(steps(high));
    if (level == 0) {
      encode_grid(square, chunk);
    } else {
      encode_mesh(level, square, chunk);
    }
    return chunk;
  }

  void encode_grid(const PatchGrid::Patch& square, Encoded& to) const {
    for (int j = square.j0 - 1; j <= square.j0 + square.rows + 1; ++j) {
      for (int i = square.i0 - 1; i <= square.i0 + square.columns + 1; ++i) {
        to.bytes.put(static_cast<std::uint16_t>(steps(samples_.at(i, j))));
      }
    }
  }

  void encode_mesh(int level, const PatchGrid::Patch& square, Encoded& to) const {
    const GroundGrid grid{samples_.width, samples_.depth, source_.cell_x(), source_.cell_z(),
                          samples_.heights};
    const double side =
        static_cast<double>(tree_.grid(level).side) * static_cast<double>(std::max(grid.cell_x, grid.cell_z));
    const ChunkMesh mesh = triangulate(grid, square, static_cast<float>(options_.error * side), true);
    const auto samples = static_cast<std::uint32_t>(samples_.heights.size()),
               width = static_cast<std::uint32_t>(grid.width);
    std::vector<std::uint32_t> used = mesh.indices;
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), std::ranges::lower_bound(used, samples)), used.end());
    if (used.size() + ChunkFile::kCorners > 65536) {
      throw usage_error("a chunk has more vertices than 16 bits can number", "",
                        "allow a larger error, or choose smaller chunks");
    }
    for (const std::uint32_t v : used) {
      to.bytes.put(vertex(static_cast<int>(v % width), static_cast<int>(v / width), square));
    }
    for (const std::uint32_t v : mesh.indices) {
      const std::uint32_t at = v % samples;
      const bool east = static_cast<int>(at % width) > square.i0,
                 south = static_cast<int>(at / width) > square.j0;
      const std::size_t number =
          v < samples ? static_cast<std::size_t>(std::ranges::lower_bound(used, v) - used.begin())
                      : used.size() + (east ? 1 : 0) + (south ? 2 : 0);
      to.bytes.put(static_cast<std::uint16_t>(number));
    }
    to.entry.indices = static_cast<std::uint32_t>(mesh.indices.size());
    to.entry.error = mesh.error;
  }

  ChunkFile::Vertex vertex(int i, int j, const PatchGrid::Patch& square) const {
    const float slope_x = (samples_.at(i + 1, j) - samples_.at(i - 1, j)) / (2 * source_.cell_x());
    const float slope_z = (samples_.at(i, j + 1) - samples_.at(i, j - 1)) / (2 * source_.cell_z());
    const float length = std::sqrt(slope_x * slope_x + 1 + slope_z * slope_z);
    const auto packed = [&](float slope) {
      return static_cast<std::int8_t>(std::lround(-127 * slope / length));
    };
    return {static_cast<std::uint16_t>(i - square.i0), static_cast<std::uint16_t>(j - square.j0),
            static_cast<std::uint16_t>(steps(samples_.at(i, j))), packed(slope_x), packed(slope_z)};
  }

  // From every chunk's own to no less than those below.
  void raise_errors() {
    for (int level = 0; level < tree_.levels(); ++level) {
      for (int z = 0; z < tree_.grid(level).down(); ++z) {
        for (int x = 0; x < tree_.grid(level).across(); ++x) {
          float& error = entries_[tree_.number(level, x, z)].error;
          error += rounding_;
          for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
            if (level == 0 || !tree_.has(level - 1, 2 * x + dx, 2 * z + dz)) continue;
            error = std::max(error, entries_[tree_.number(level - 1, 2 * x + dx, 2 * z + dz)].error);
          }
        }
      }
    }
  }

  HeightSource& source_;
  ChunkFileOptions options_;
  NewFile file_;
  int width_, depth_;
  cdlod::NodeTree tree_;  // without heights
  std::vector<Entry> entries_;
  std::uint64_t end_ = 0;  // of the chunks written
  float lowest_ = std::numeric_limits<float>::max(), highest_ = -lowest_, step_ = 1, rounding_ = 0;
  PatchGrid::Patch root_{};
  Heightfield samples_;  // of the root
};

void ChunkFile::build(HeightSource& source, const ChunkFileOptions& options,
                      const std::filesystem::path& path, Progress& progress) {
  if (!source.bounded() || source.first() != glm::ivec2(0) || source.last().x < 1 || source.last().y < 1) {
    throw usage_error("chunks need bounded ground of at least 2 × 2 samples", "", "choose a larger terrain");
  }
  const auto fits = [](int side) {
    return side >= 2 && side <= kLargestSide && std::has_single_bit(static_cast<unsigned>(side));
  };
  if (!fits(options.side) || !fits(options.largest) || options.largest < options.side ||
      !(options.error > 0)) {
    throw usage_error("sides of chunks must be powers of two from 2 to 32768, and their error positive", "",
                      "choose others");
  }
  ChunkFileBuilder(source, options, path).run(progress);
}

}  // namespace terrabench::chunked
