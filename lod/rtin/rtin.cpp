#include "lod/rtin/rtin.h"

#include "lod/screen_bound.h"
#include "terrain/frustum.h"
#include "terrain/memory.h"

namespace terrabench {

using rtin::Nested, rtin::Next, rtin::Triangle;

namespace {

constexpr std::string_view kErrors[] = {"exact", "midpoint"};

}  // namespace

std::span<const ParameterSpec> Rtin::parameters() {
  static const ParameterSpec kSpecs[] = {
      choice("error", kErrors,
             "of a triangle: the largest of all samples under it, or as published that of the middle one"),
      {"metres", 0.0, "m", "one mesh for all views, of triangles with at most this error; 0: by the view", 0,
       1e6},
  };
  return kSpecs;
}

std::unique_ptr<Lod> Rtin::build(const LodGround& from, const Parameters& parameters, Progress& progress) {
  check_ground(from.heights);
  const Options options{parameters.choice("error") == 0, parameters.number("metres")};
  return std::make_unique<Rtin>(from.heights, options, progress);
}

Rtin::Rtin(const Heightfield& ground, const Options& options, Progress& progress)
    : options_(options), errors_(grid_of(ground), options.exact, progress), frame_(ground) {}

void Rtin::edited(const SampleRect& rect) {
  frame_.edited(rect);
  errors_.update(rect.low, rect.high);
}

const Frame& Rtin::update(const View& view) {
  check_view(view);
  frame_.begin();
  if (options_.metres > 0) {
    descend_for_all_views();
  } else {
    descend_for(view);
  }
  return frame_.finish(0);
}

void Rtin::descend_for_all_views() {
  const auto choose = [&](const Triangle& t, int) {
    return t.splits() && errors_.at(t.middle()).error > options_.metres ? Next::kSplit : Next::kDraw;
  };
  descend(errors_.lattice(), 0, choose, [&](const Triangle& t) { draw(t); });
}

// The state of the descent: the planes of the view that a triangle may cross.
void Rtin::descend_for(const View& view) {
  const ScreenBound bound(view, pixels_);
  const Frustum frustum(view);
  const auto choose = [&](const Triangle& t, unsigned& planes) {
    if (!t.splits()) return Next::kDraw;
    const Nested& nested = errors_.at(t.middle());
    const glm::dvec3 middle = errors_.position(t.middle());
    if (planes != 0 && frustum.see(errors_.box(t), planes) == Sight::kOutside) return Next::kSkip;
    return nested.error > bound.allow(middle, nested.radius) ? Next::kSplit : Next::kDraw;
  };
  descend(errors_.lattice(), Frustum::kAllPlanes, choose, [&](const Triangle& t) { draw(t); });
}

void Rtin::draw(const Triangle& t) {
  const rtin::Lattice& lattice = errors_.lattice();
  if (!lattice.over_ground(t)) return;
  for (const glm::ivec2 corner : {t.a, t.b, t.c}) frame_.add_corner(lattice.vertex(corner));
}

Memory Rtin::memory() const {
  Memory memory = errors_.memory();
  memory.index += heap_bytes(this);
  memory += frame_.memory();
  return memory;
}

}  // namespace terrabench
