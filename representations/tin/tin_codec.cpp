#include "representations/tin/tin_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "representations/coding/range_coder.h"
#include "terrain/memory.h"
#include "terrain/tin/triangle_plane.h"

namespace terrabench::tin {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::int32_t kMostSteps = 1 << 30;  // differences fit 32 bits

// Which samples of a row are vertices, with a margin of samples that are not.
class Occupied {
 public:
  explicit Occupied(int width) : bits_(static_cast<std::size_t>(width) + 2 * kMargin) {}
  std::uint8_t& operator[](int i) { return bits_[static_cast<std::size_t>(i + kMargin)]; }
  int count(int first, int last) {
    int sum = 0;
    for (int i = first; i <= last; ++i) sum += (*this)[i];
    return sum;
  }

 private:
  static constexpr int kMargin = 4;
  std::vector<std::uint8_t> bits_;
};

// The statistics of all parts, and the coding with them, alike in both directions.
template <class Coder>
class TinCoder {
 public:
  TinCoder(Coder& coder, int width, int depth, double lowest, double step)
      : coder_(coder), width_(width), depth_(depth), lowest_(lowest), step_(step) {}

  // Calls is_vertex(sample) where an encoder knows; returns all vertices in rows. `source`: of a decoder.
  template <class IsVertex>
  std::vector<Sample> vertices(const IsVertex& is_vertex, const ByteSource* source = nullptr) {
    std::vector<Sample> all;
    const std::size_t most = available_memory() / kBytesPerVertex;
    std::array<Occupied, 3> rows{Occupied(width_), Occupied(width_), Occupied(width_)};
    for (int j = 0; j < depth_; ++j) {
      auto& [here, north, beyond] = rows;
      for (int i = 0; i < width_; ++i) {
        const Sample s{static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j)};
        const int near = here.count(i - 4, i - 1) + north.count(i - 3, i + 3) + beyond.count(i - 2, i + 2);
        auto& model =
            occupied_[static_cast<std::size_t>(std::min(near, 7) << 2 | here[i - 1] << 1 | north[i])];
        const bool corner = (i == 0 || i == width_ - 1) && (j == 0 || j == depth_ - 1);
        here[i] = corner || code_bit(coder_, model, is_vertex(s)) ? 1 : 0;
        if (here[i] != 0) all.push_back(s);
      }
      if (source != nullptr && all.size() > most) source->fail("more vertices than fit the memory");
      std::rotate(rows.begin(), rows.end() - 1, rows.end());
      rows[0] = Occupied(width_);
    }
    return all;
  }

  // Calls steps_of(sample), with -1 for no data, where an encoder knows. In order.
  template <class StepsOf>
  Approximation heights(const std::vector<Sample>& vertices, const StepsOf& steps_of) {
    Approximation built{Delaunay(width_, depth_), {}, {}};
    built.surface.reserve(vertices.size());
    std::vector<int> sizes;  // of each vertex's difference, in binary digits
    std::int32_t last = 0;
    for (const Sample corner : std::vector(built.surface.vertices())) {
      const std::int32_t steps = steps_of(corner);
      const bool absent = code_bit(coder_, absent_, steps < 0);
      if (!absent) last = plus(last, corner_.code(coder_, steps - last));
      built.heights.push_back(absent ? kNone : metres(last));
      sizes.push_back(kSizes - 1);
    }
    std::uint32_t near = 0;
    std::vector<std::uint32_t> changed;
    coarse_to_fine(vertices.size(), [&](std::size_t k) {
      const Sample at = vertices[k];
      near = built.surface.locate(at, near);
      const Triangle t = built.surface.triangles()[near];
      const std::int32_t predicted = guess(built, t, at);
      int size = 0;
      for (const std::uint32_t v : t.vertex) size = std::max(size, sizes[v]);
      changed.clear();
      if (built.surface.insert(at, near, changed) < built.heights.size()) return;  // a corner
      const std::int32_t difference =
          number_[static_cast<std::size_t>(size)].code(coder_, steps_of(at) - predicted);
      built.heights.push_back(metres(plus(predicted, difference)));
      sizes.push_back(std::min(NumberModel::size(difference), kSizes - 2));
    });
    put_in_order(built);
    return built;
  }

  // Whether each triangle is a hole, which its neighbours to the north and west mostly tell.
  void holes(const Delaunay& surface, std::vector<std::uint8_t>& holes) {
    for (std::uint32_t t = 0; t < holes.size(); ++t) {
      std::size_t known = 0, are = 0;
      for (const std::uint32_t n : surface.triangles()[t].neighbour) {
        if (n >= t) continue;  // also skips kNone
        ++known;
        are += holes[n];
      }
      holes[t] = code_bit(coder_, hole_[4 * known + are], holes[t] != 0) ? 1 : 0;
    }
  }

 private:
  float metres(std::int32_t steps) const { return static_cast<float>(lowest_ + steps * step_); }

  // Damaged files hold differences of any size.
  static std::int32_t plus(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(std::int64_t{a} + b, 0, kMostSteps));
  }

  // The surface's height at a sample, in steps; that of any corner with data where it has none.
  std::int32_t guess(const Approximation& built, const Triangle& t, Sample at) const {
    std::array<float, 3> h;
    for (std::size_t k = 0; k < 3; ++k) h[k] = built.heights[t.vertex[k]];
    const Plane plane({built.surface.vertex(t, 0), built.surface.vertex(t, 1), built.surface.vertex(t, 2)},
                      h);
    double height = plane(at.i, at.j);
    for (const float corner : h) {
      if (std::isnan(height)) height = corner;
    }
    if (std::isnan(height)) return 0;
    return static_cast<std::int32_t>(
        std::clamp<double>(std::round((height - lowest_) / step_), 0, kMostSteps));
  }

  static constexpr int kSizes = 16;
  static constexpr std::size_t kBytesPerVertex = 100;  // of a triangulation while it is built

  Coder& coder_;
  int width_, depth_;
  double lowest_, step_;
  std::array<BitModel, 32> occupied_;
  std::array<BitModel, 16> hole_;
  std::array<NumberModel, kSizes> number_;
  BitModel absent_;
  NumberModel corner_;
};

}  // namespace

void encode(const Approximation& surface, int width, int depth, double step, ByteSink& out) {
  const std::vector<Sample>& vertices = surface.surface.vertices();
  double lowest = 0, highest = 0;
  bool any = false;
  for (const float h : surface.heights) {
    if (std::isnan(h)) continue;
    lowest = any ? std::min<double>(lowest, h) : h;
    highest = any ? std::max<double>(highest, h) : h;
    any = true;
  }
  step = std::max(step, (highest - lowest) / kMostSteps);
  RangeEncoder coder;
  TinCoder<RangeEncoder> code(coder, width, depth, lowest, step);
  auto next = vertices.begin();
  const std::vector<Sample> coded = code.vertices([&](Sample s) {
    while (next != vertices.end() && before(*next, s)) ++next;
    return next != vertices.end() && *next == s;
  });
  const auto steps_of = [&](Sample s) {
    const auto v = std::ranges::lower_bound(vertices, s, before) - vertices.begin();
    const float h = surface.heights[static_cast<std::size_t>(v)];
    return std::isnan(h) ? -1 : static_cast<std::int32_t>(std::lround((h - lowest) / step));
  };
  Approximation again = code.heights(coded, steps_of);
  std::vector<std::uint8_t> holes = surface.holes;
  code.holes(again.surface, holes);
  const std::vector<std::byte> bytes = coder.finish();
  out.put(step);
  out.put(lowest);
  out.put(static_cast<std::uint8_t>(holes.empty() ? 0 : 1));
  out.put(static_cast<std::uint64_t>(bytes.size()));
  out.put_array(std::span<const std::byte>(bytes));
}

Approximation decode(ByteSource& in, int width, int depth) {
  const auto step = in.get<double>(), lowest = in.get<double>();
  const auto with_holes = in.get<std::uint8_t>();
  if (!(step > 0) || !std::isfinite(step) || !std::isfinite(lowest) || with_holes > 1) {
    in.fail("the heights' step or lowest value is impossible");
  }
  const std::vector<std::byte> bytes = in.get_array<std::byte>(in.get<std::uint64_t>());
  RangeDecoder coder(bytes, in);
  TinCoder<RangeDecoder> code(coder, width, depth, lowest, step);
  const std::vector<Sample> vertices = code.vertices([](Sample) { return false; }, &in);
  Approximation built = code.heights(vertices, [](Sample) { return 0; });
  if (with_holes == 1) {
    built.holes.resize(built.surface.triangles().size());
    code.holes(built.surface, built.holes);
  }
  if (!coder.at_end()) in.fail("bytes follow the last height");
  return built;
}

}  // namespace terrabench::tin
