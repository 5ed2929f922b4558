#include "representations/drill/drill_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "representations/coding/range_coder.h"
#include "representations/drill/quantum.h"
#include "terrain/hydrology/flow.h"
#include "terrain/memory.h"

namespace terrabench {
namespace {

constexpr float kMostHeight = 1e9F;
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;
constexpr std::size_t kBytesPerDrill =
    2 * (4 * sizeof(float) + 2) + sizeof(std::uint32_t);  // while being sorted

// A drill's numbers in quanta, and how they differ from those downstream.
struct Numbers {
  std::int32_t elevation = 0, slope = 0, curvature = 0, influence = 0;
  std::int32_t rise = 0, turn = 0;
};

// Which of the numbers that are often all alike the file has for each drill.
struct Stored {
  bool influence = false;
  bool slope = false;  // not for shapes with their vertex at the pixel
  static constexpr std::uint8_t kInfluence = 1, kNoSlope = 2;

  explicit Stored(const Drills& drills)
      : influence(!drills.influence.empty()),
        slope(std::ranges::any_of(drills.slope, [](float slope) { return slope != 0; })) {}
  explicit Stored(std::uint8_t flags)
      : influence((flags & kInfluence) != 0), slope((flags & kNoSlope) == 0) {}
  int flags() const { return (influence ? kInfluence : 0) | (slope ? 0 : kNoSlope); }
};

// A drill's place in the tree: its pixel, the direction in which it drains, and what is known downstream.
struct Place {
  std::uint32_t pixel;
  std::uint8_t direction;
  std::uint8_t bend;  // of the channel at the pixel downstream, 0 … 7; kAtOutlet beside the outlet and there
  Numbers downstream;
};
constexpr std::uint8_t kAtOutlet = 8;

// The adaptive statistics of all parts, and the coding of one drill with them, for both directions.
template <class Coder>
class DrillCoder {
 public:
  explicit DrillCoder(Coder& coder) : coder_(coder) {}

  std::int32_t count(std::int32_t value) { return count_.code(coder_, value); }
  std::int32_t root_gap(std::int32_t value) { return root_gap_.code(coder_, value); }
  std::int32_t hole_gap(std::int32_t value) { return hole_gap_.code(coder_, value); }
  std::int32_t hole_count(std::int32_t value) { return hole_count_.code(coder_, value); }

  // Bit e: the neighbour in direction (own direction + e) mod 8 drains into this pixel. Bit 0 is set only at
  // outlets.
  std::uint32_t children(const Place& place, std::uint32_t mask) {
    if (place.direction == FlowNetwork::kOutlet) return outlet_children_.code(coder_, mask);
    return children_[place.bend].code(coder_, mask >> 1) << 1;
  }

  Numbers numbers(const Place& place, const Numbers& own, Stored stored) {
    const Numbers& down = place.downstream;
    const auto context = [](std::int32_t number) {
      return std::min(NumberModel::size(number), kContexts - 1);
    };
    Numbers coded;
    coded.rise = rise_[context(down.rise)].code(coder_, own.elevation - down.elevation);
    if (stored.slope) coded.turn = turn_[context(down.turn)].code(coder_, own.slope - down.slope);
    coded.elevation = sum(down.elevation, coded.rise);
    coded.slope = sum(down.slope, coded.turn);
    const int level = (down.curvature == 0 ? 1 : 0) + (coded.slope == 0 ? 2 : 0);
    coded.curvature = sum(down.curvature, curvature_[level].code(coder_, own.curvature - down.curvature));
    if (stored.influence)
      coded.influence = sum(down.influence, influence_.code(coder_, own.influence - down.influence));
    return coded;
  }

 private:
  // Damaged files hold differences of any size; the sum is checked afterwards.
  static std::int32_t sum(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
  }

  static constexpr int kContexts = 12;
  Coder& coder_;
  SymbolModel<8> outlet_children_;
  SymbolModel<7> children_[9];
  NumberModel count_, root_gap_, hole_gap_, hole_count_;
  NumberModel rise_[kContexts], turn_[kContexts], curvature_[4], influence_;
};

// The place upstream of `place` for child bit `e`; nothing beyond the grid.
std::optional<Place> upstream(const Drills& grid, const Place& place, std::uint32_t e,
                              const Numbers& numbers) {
  const bool outlet = place.direction == FlowNetwork::kOutlet;
  const std::uint32_t towards = ((outlet ? 0U : place.direction) + e) % 8;
  const FlowStep step = kFlowSteps[towards];
  const int x = static_cast<int>(place.pixel) % grid.width + step.x,
            z = static_cast<int>(place.pixel) / grid.width + step.z;
  if (x < 0 || z < 0 || x >= grid.width || z >= grid.depth) return std::nullopt;
  return Place{
      static_cast<std::uint32_t>(z) * static_cast<std::uint32_t>(grid.width) + static_cast<std::uint32_t>(x),
      static_cast<std::uint8_t>(towards ^ 4U), outlet ? kAtOutlet : static_cast<std::uint8_t>(e), numbers};
}

class Encoder {
 public:
  explicit Encoder(const Drills& drills)
      : drills_(drills), stored_(drills), quanta_(drills.quantum, drills.w), code_(coder_) {
    const auto width = static_cast<std::uint32_t>(drills.width);
    row_.resize(static_cast<std::size_t>(drills.depth) + 1);
    for (const std::uint32_t pixel : drills.pixel) ++row_[pixel / width + 1];
    std::partial_sum(row_.begin(), row_.end(), row_.begin());
  }

  std::vector<std::byte> run() {
    put_holes();
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < drills_.count(); ++i) {
      if (!has_receiver(i)) roots.push_back(i);
    }
    code_.count(static_cast<std::int32_t>(roots.size()));
    std::uint32_t last = 0;
    Numbers numbers;
    for (const std::size_t root : roots) {
      code_.root_gap(static_cast<std::int32_t>(drills_.pixel[root] - last));
      last = drills_.pixel[root];
      numbers = put_tree({last, FlowNetwork::kOutlet, kAtOutlet, numbers});
    }
    return coder_.finish();
  }

 private:
  void put_holes() {
    code_.count(static_cast<std::int32_t>(drills_.holes.size()));
    std::uint32_t last = 0;
    for (const HoleRun& hole : drills_.holes) {
      code_.hole_gap(static_cast<std::int32_t>(hole.first - last));
      code_.hole_count(static_cast<std::int32_t>(hole.count));
      last = hole.first + hole.count;
    }
  }

  std::size_t find(std::uint32_t pixel) const {  // count() when there is none
    const std::uint32_t row = pixel / static_cast<std::uint32_t>(drills_.width);
    const auto begin = drills_.pixel.begin() + row_[row], end = drills_.pixel.begin() + row_[row + 1];
    const auto at = std::lower_bound(begin, end, pixel);
    return at != end && *at == pixel ? static_cast<std::size_t>(at - drills_.pixel.begin()) : drills_.count();
  }

  bool has_receiver(std::size_t drill) const {
    if (drills_.direction[drill] >= FlowNetwork::kOutlet) return false;
    const FlowStep step = kFlowSteps[drills_.direction[drill]];
    const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(drills_.pixel[drill]) +
                              static_cast<std::ptrdiff_t>(step.z) * drills_.width + step.x;
    return find(static_cast<std::uint32_t>(to)) != drills_.count();
  }

  Numbers numbers_of(std::size_t drill) const {
    Numbers own;
    own.elevation = in_quanta(drills_.elevation[drill], quanta_.elevation);
    own.slope = in_quanta(drills_.slope[drill], quanta_.slope);
    own.curvature = in_quanta(drills_.curvature[drill], quanta_.curvature);
    own.influence = drills_.influence_of(drill);
    return own;
  }

  // Returns the root's numbers.
  Numbers put_tree(const Place& root) {
    const Numbers first = put_drill(root);
    while (!stack_.empty()) {
      const Place place = stack_.back();
      stack_.pop_back();
      put_drill(place);
    }
    return first;
  }

  Numbers put_drill(const Place& place) {
    const Numbers coded = code_.numbers(place, numbers_of(find(place.pixel)), stored_);
    std::uint32_t mask = 0;
    for (std::uint32_t e = place.direction == FlowNetwork::kOutlet ? 0 : 1; e < 8; ++e) {
      const auto child = upstream(drills_, place, e, coded);
      if (!child) continue;
      const std::size_t drill = find(child->pixel);
      if (drill == drills_.count() || drills_.direction[drill] != child->direction) continue;
      mask |= 1U << e;
      stack_.push_back(*child);
    }
    code_.children(place, mask);
    return coded;
  }

  const Drills& drills_;
  Stored stored_;
  Quanta quanta_;
  RangeEncoder coder_;
  DrillCoder<RangeEncoder> code_;
  std::vector<std::uint32_t> row_;  // the first drill of each row
  std::vector<Place> stack_;
};

class Decoder {
 public:
  Decoder(Drills& drills, Stored stored, std::span<const std::byte> bytes, const ByteSource& source)
      : drills_(drills),
        stored_(stored),
        source_(source),
        quanta_(drills.quantum, drills.w),
        coder_(bytes, source),
        code_(coder_),
        taken_(drills.pixels()) {}

  void run() {
    get_holes();
    const std::int32_t roots = code_.count(0);
    if (roots < 0) source_.fail("the number of outlets is impossible");
    std::uint64_t last = 0;
    Numbers numbers;
    for (std::int32_t i = 0; i < roots; ++i) {
      const std::int32_t gap = code_.root_gap(0);
      last += static_cast<std::uint32_t>(gap);
      if (gap < 0 || last >= drills_.pixels()) source_.fail("an outlet lies outside the terrain");
      numbers = get_tree({static_cast<std::uint32_t>(last), FlowNetwork::kOutlet, kAtOutlet, numbers});
    }
    if (!coder_.at_end()) source_.fail("bytes follow the last drill");
    sort();
  }

 private:
  void get_holes() {
    const std::int32_t holes = code_.count(0);
    if (holes < 0) source_.fail("the number of holes is impossible");
    std::uint64_t last = 0;
    for (std::int32_t i = 0; i < holes; ++i) {
      const std::int32_t gap = code_.hole_gap(0), count = code_.hole_count(0);
      const std::uint64_t first = last + static_cast<std::uint32_t>(gap);
      last = first + static_cast<std::uint32_t>(count);
      if (gap < (i == 0 ? 0 : 1) || count < 1 || last > drills_.pixels()) {
        source_.fail("a hole lies outside the terrain or touches another");
      }
      before_growth(drills_.holes.size(), sizeof(HoleRun));
      drills_.holes.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
      std::fill_n(taken_.begin() + static_cast<std::ptrdiff_t>(first), count, true);
    }
  }

  Numbers get_tree(const Place& root) {
    take(root.pixel);
    const Numbers first = get_drill(root);
    while (!stack_.empty()) {
      const Place place = stack_.back();
      stack_.pop_back();
      get_drill(place);
    }
    return first;
  }

  // Checked before each doubling: a few bytes of a damaged file can stand for millions of drills.
  void before_growth(std::size_t count, std::size_t size) const {
    constexpr std::size_t kUnchecked = 1 << 20;
    if (count >= kUnchecked && std::has_single_bit(count)) {
      require_memory(2 * count * size, "drills of " + source_.origin());
    }
  }

  // Each pixel at most once: no channel may close on itself.
  void take(std::uint32_t pixel) {
    if (taken_[pixel]) source_.fail("a drill lies on another, or in a hole");
    taken_[pixel] = true;
  }

  Numbers get_drill(const Place& place) {
    before_growth(drills_.count(), kBytesPerDrill);
    const Numbers own = code_.numbers(place, {}, stored_);
    const auto fits = [](std::int32_t number) { return number >= -kMostQuanta && number <= kMostQuanta; };
    if (!fits(own.elevation) || !fits(own.slope) || !fits(own.curvature) || own.influence < 0 ||
        own.influence > drills_.k) {
      source_.fail("a drill's shape is impossible");
    }
    drills_.pixel.push_back(place.pixel);
    drills_.direction.push_back(place.direction);
    drills_.elevation.push_back(in_metres(own.elevation, quanta_.elevation));
    drills_.slope.push_back(in_metres(own.slope, quanta_.slope));
    drills_.curvature.push_back(in_metres(own.curvature, quanta_.curvature));
    if (stored_.influence) drills_.influence.push_back(static_cast<std::uint8_t>(own.influence));
    const std::uint32_t mask = code_.children(place, 0);
    for (std::uint32_t e = 0; e < 8; ++e) {
      if ((mask >> e & 1U) == 0) continue;
      const auto child = upstream(drills_, place, e, own);
      if (!child) source_.fail("a channel leaves the terrain");
      take(child->pixel);
      before_growth(stack_.size(), sizeof(Place));
      stack_.push_back(*child);
    }
    return own;
  }

  // Into row-major order.
  void sort() {
    std::vector<std::uint32_t> order(drills_.count());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return drills_.pixel[a] < drills_.pixel[b]; });
    const auto permute = [&](auto& values) {
      auto sorted = values;
      for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = values[order[i]];
      values = std::move(sorted);
    };
    permute(drills_.pixel);
    permute(drills_.direction);
    permute(drills_.elevation);
    permute(drills_.slope);
    permute(drills_.curvature);
    permute(drills_.influence);
  }

  Drills& drills_;
  Stored stored_;
  const ByteSource& source_;
  Quanta quanta_;
  RangeDecoder coder_;
  DrillCoder<RangeDecoder> code_;
  std::vector<bool> taken_;
  std::vector<Place> stack_;
};

void check_frame(const Drills& drills, const ByteSource& in) {
  if (drills.width < 1 || drills.depth < 1 || drills.pixels() > kMostPixels) {
    in.fail("the terrain's size is impossible");
  }
  const auto positive = [](float metres) { return std::isfinite(metres) && metres > 0; };
  if (!positive(drills.cell_x) || !positive(drills.cell_z) || !(std::abs(drills.plateau) <= kMostHeight) ||
      !(drills.quantum >= kLeastQuantum && drills.quantum <= kMostQuantum) || drills.w < 1) {
    in.fail("the drills' cell sizes, plateau, quantum or w are impossible");
  }
}

}  // namespace

void encode_drills(const Drills& drills, ByteSink& out) {
  out.put(drills.width);
  out.put(drills.depth);
  for (const float metres : {drills.cell_x, drills.cell_z, drills.plateau, drills.quantum}) out.put(metres);
  for (const int small : {drills.w, drills.k, Stored(drills).flags(), drills.interpolated ? 1 : 0}) {
    out.put(static_cast<std::uint8_t>(small));
  }
  const std::vector<std::byte> coded = Encoder(drills).run();
  out.put(static_cast<std::uint64_t>(coded.size()));
  out.put_array(std::span<const std::byte>(coded));
}

Drills decode_drills(ByteSource& in) {
  Drills drills;
  drills.width = in.get<std::int32_t>();
  drills.depth = in.get<std::int32_t>();
  for (float* metres : {&drills.cell_x, &drills.cell_z, &drills.plateau, &drills.quantum})
    *metres = in.get<float>();
  drills.w = in.get<std::uint8_t>();
  drills.k = in.get<std::uint8_t>();
  const auto flags = in.get<std::uint8_t>(), interpolated = in.get<std::uint8_t>();
  if (flags > (Stored::kInfluence | Stored::kNoSlope) || interpolated > 1)
    in.fail("the drills' flags are impossible");
  drills.interpolated = interpolated == 1;
  check_frame(drills, in);
  const std::vector<std::byte> coded = in.get_array<std::byte>(in.get<std::uint64_t>());
  Decoder(drills, Stored(flags), coded, in).run();
  return drills;
}

}  // namespace terrabench
