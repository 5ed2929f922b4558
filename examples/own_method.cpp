// A representation and a level-of-detail method from outside: terrabench's whole command line, with two more
// methods in it. They take part in every comparison, ray, edit, picture, claim and table:
//   own_method run 'cross.lod-*' --out out && own_method check out && own_method report out
#include <algorithm>
#include <cmath>

#include "experiments/commands/command_line.h"
#include "own_lod.h"
#include "representations/column_grid.h"
#include "representations/heightmap/heightmap.h"

using namespace terrabench;

// One byte per sample: 0 for no data, 1 to 255 for heights from the lowest point to the highest. A query
// reads the nearest sample, O(1).
struct ByteHeights final : Representation {
  static std::unique_ptr<Representation> build(const TerrainSource& source, const Parameters& parameters,
                                               Progress& progress) {
    const auto heights = Heightmap::build(source, parameters, progress);
    return std::make_unique<ByteHeights>(static_cast<const Heightmap&>(*heights));
  }
  static std::unique_ptr<Representation> load(ByteSource& in) {
    auto loaded = std::make_unique<ByteHeights>();
    loaded->grid_ = HeightGrid::load(in);
    loaded->bytes_ = in.get_array<std::uint8_t>(std::uint64_t(loaded->grid_.width) * loaded->grid_.depth);
    return loaded;
  }
  ByteHeights() = default;
  explicit ByteHeights(const Heightmap& map) : grid_(map.grid()), bytes_(map.heights().size()) {
    for (std::size_t k = 0; k < bytes_.size(); ++k) {
      const float scaled = 255 * (map.heights()[k] - grid_.bounds.low.y) / grid_.bounds.size().y;
      if (!std::isnan(scaled)) bytes_[k] = static_cast<std::uint8_t>(std::max(1L, std::lround(scaled)));
    }
  }
  void spans(Columns where, SpanSink& out) const override {
    for (std::size_t c = 0; c < where.size(); ++c, out.end_column()) {
      const long i = std::lround((where.x[c] - grid_.origin_x) / grid_.cell_x),
                 j = std::lround((where.z[c] - grid_.origin_z) / grid_.cell_z);
      if (i < 0 || i >= grid_.width || j < 0 || j >= grid_.depth) continue;
      const std::uint8_t byte = bytes_[static_cast<std::size_t>(j * grid_.width + i)];
      if (byte > 0) out.add({grid_.bounds.low.y, height(byte), Material::kBedrock});
    }
  }
  TriangleMesh mesh(MeshDetail detail) const override {
    std::vector<float> heights;
    for (const std::uint8_t byte : bytes_) heights.push_back(height(byte));
    return Heightmap(grid_, std::move(heights)).mesh(detail);
  }
  Memory memory() const override { return payload_memory(bytes_) += {.index = heap_bytes(this)}; }
  void save(ByteSink& out) const override { grid_.save(out), out.put_array(std::span(bytes_)); }
  Bounds bounds() const override { return grid_.bounds; }

 private:
  float height(std::uint8_t byte) const {
    return byte == 0 ? Heightfield::kNoData : grid_.bounds.low.y + grid_.bounds.size().y * byte / 255;
  }
  HeightGrid grid_;
  std::vector<std::uint8_t> bytes_;
};

int main(int argc, char** argv) {
  add_representation({"byte_heights",
                      "byte heights",
                      "one byte per grid point",
                      "this program",
                      {},
                      column_parameters(),
                      ByteHeights::build,
                      ByteHeights::load});
  add_lod({"right_triangles",
           "right triangles",
           "bisected where a bound of the error asks for it",
           "Lindstrom & Pascucci 2001",
           {},
           own::RightTriangles::knob(),
           {},
           "",
           own::RightTriangles::build});
  return command_line(argc, argv);
}
