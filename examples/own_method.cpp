// A method added from outside, measured beside the built-in ones: own_method [TERRAIN], a height field.
#include <fmt/core.h>

#include <cmath>

#include "experiments/fidelity.h"
#include "representations/heightmap/heightmap.h"

using namespace terrabench;
Progress progress;  // silent

// One byte per sample: 0 for no data, 255 for the highest point. A query reads the nearest sample, O(1).
struct ByteHeights final : Representation {
  ByteHeights(const Heightfield& field, const Bounds& box)
      : grid_{field.width, field.depth, 0, 0, field.cell_x, field.cell_z, box}, bytes_(field.heights.size()) {
    for (std::size_t k = 0; k < bytes_.size(); ++k) {
      const float scaled = 255 * (field.heights[k] - box.low.y) / box.size().y;
      if (!std::isnan(scaled)) bytes_[k] = static_cast<std::uint8_t>(std::lround(scaled));
    }
  }
  void spans(Columns where, SpanSink& out) const override {
    for (std::size_t c = 0; c < where.size(); ++c, out.end_column()) {
      const long i = std::lround(where.x[c] / grid_.cell_x), j = std::lround(where.z[c] / grid_.cell_z);
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

void measure(std::string_view name, std::unique_ptr<Representation> built, const TerrainSource& source) {
  fmt::print("{:14} {:9.3f} {:>10} {:10} ", name, measure_fidelity(*built, source, progress).rmse,
             check_edges(built->mesh({})).watertight(), built->memory().total());
  fmt::print("{:10}\n", destroy_and_count(std::move(built)));
}

int main(int argc, char** argv) {
  const TerrainSource source = open_terrain(argc > 1 ? argv[1] : "jacksboro");
  if (!source.heights) return fmt::print(stderr, "{} is a solid, not a height field\n", source.name), 2;
  fmt::print("{:14} {:>9} {:>10} {:>10} {:>10}\n", "method", "RMSE, m", "closed", "memory()", "counted");
  for (const RepresentationType& type : representations())
    measure(type.name, type.build(source, Parameters(type.parameters), progress), source);
  measure("byte_heights", std::make_unique<ByteHeights>(*source.heights, source.bounds()), source);
}
