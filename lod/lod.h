// The interface of all level-of-detail methods: a view in, batches of triangles out. A method may reuse the
// mesh of the last frame. Methods do not measure themselves; meters/ measures error, cracks and popping.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/frame.h"
#include "terrain/heightfield.h"
#include "terrain/memory.h"
#include "terrain/mesh_chunks.h"
#include "terrain/parameters.h"
#include "terrain/progress.h"
#include "terrain/view.h"

namespace terrabench {

// Samples `low` to `high`, both included.
struct SampleRect {
  glm::ivec2 low{0}, high{0};
};

class Lod {
 public:
  virtual ~Lod() = default;
  // The triangles for this view. The frame stays valid until the next call. The eye may be anywhere,
  // underground or far away too. Throws usage_error for an invalid view (NaN, no pixels, a field of view
  // outside (0, π)); see check_view().
  virtual const Frame& update(const View&) = 0;
  // Sets the method's knob (LodType::knob) to setting(), which throws for NaN; takes effect with the next
  // update().
  virtual void tune(double knob) = 0;
  // The ground's heights at these samples have changed. From the next update() on, the method draws the same
  // as one that is built on the changed ground, and that update's uploads contain the changed heights. Costs
  // what depends on these samples alone, unless the method says otherwise. Before the change, call memory(),
  // which waits for work in the background. Throws usage_error for samples that are not on the ground.
  virtual void edited(const SampleRect&) = 0;
  // Every heap byte, the object itself included. Waits for work in the background, so that the answer holds
  // until the next update().
  virtual Memory memory() const = 0;
};

// What a method is built from: heights and, where the ground has more than one surface over a place, the near
// surface as chunks of a mesh. Methods for heights alone ignore the chunks. Points to both, which must
// outlive the method. Before an edit of the surface, call Lod::memory(), which waits for work in the
// background.
struct LodGround {
  LodGround(const Heightfield& of, const MeshChunks* surface = nullptr)  // NOLINT: heights are ground
      : heights(of), near_surface(surface) {}
  const Heightfield& heights;
  const MeshChunks* near_surface;
};

// The one setting that trades triangles for error. Each method has its own unit: methods are compared at
// equal measured error, not at equal settings.
struct Knob {
  std::string_view name, unit;
  double finest = 0, coarsest = 0, fallback = 0;  // finest may be greater or less than coarsest
  bool whole = false;                             // whole numbers only
};

struct LodTraits {
  bool conforming = true;     // promises no cracks
  bool bounds_error = false;  // promises a screen-space error of at most the knob, in pixels
  bool near_surface = false;  // draws LodGround::near_surface
};

// Another value of one option, with which a method is compared as if it were a method of its own.
struct LodVariant {
  std::string_view name, label;  // added to the method's: geomipmap_morph, "geomipmap, morphing"
  std::string_view option;       // "name=value"
  bool bounds_error = true;      // keeps LodTraits::bounds_error
};

// How costs grow in theory with the samples n of the ground, along one path at one error on the screen: upper
// bounds, as exponents of n. Every method reads its ground once.
struct LodGrowth {
  double build = 1, memory = 1;
  double update = 1;             // also of uploads and triangles; 0: as log n
  bool windows = false;          // memory grows as n^memory · log n
  std::string_view option = {};  // "name=value" for which this holds; empty: the defaults
};

struct LodType {
  std::string_view name, label, summary, paper;  // label: in figures
  LodTraits traits;
  Knob knob;
  std::span<const ParameterSpec> parameters;
  // The parameter, as "name=value", that leaves open what the method otherwise closes between triangles of
  // different detail, for measurements of what that closing is worth. Empty: it cannot be left out.
  std::string_view unstitched;
  // Takes fields of any size from 2 × 2 samples. Throws usage_error for a smaller field or one with no-data
  // (see fill_no_data).
  std::unique_ptr<Lod> (*build)(const LodGround&, const Parameters&, Progress&);
  std::span<const LodVariant> variants = {};
  std::optional<LodGrowth> growth = {};  // where none is stated, growth is measured and not judged

  bool tunable() const { return knob.finest != knob.coarsest; }
};

// The registry, one entry per method: registry.cpp.
std::span<const LodType> lods();
const LodType& lod(std::string_view name);  // throws unknown_name
// Adds a method of another program, which then takes part in everything. To be called before anything else
// is: references to entries do not stay valid. Throws usage_error for a name that is taken.
void add_lod(const LodType&);

// What comparisons compare: every method with its defaults, then every variant of one.
struct Entrant {
  std::string name;             // in case names
  std::string method, options;  // options: such as "geomipmap.morph=true"; empty: the defaults
  std::string label = {};       // in figures
  bool bounds_error = false;    // LodTraits::bounds_error, LodVariant::bounds_error
};
std::vector<Entrant> entrants();

// The value, clamped to the knob's range and rounded if it must be whole. Throws usage_error for NaN.
double setting(const Knob&, double value);

// Throws usage_error for a field smaller than 2 × 2 samples or with no-data.
void check_ground(const Heightfield&);
// The grid of a field's samples.
GroundGrid grid_of(const Heightfield&);
// Throws usage_error unless low ≤ high and both are among width × depth samples.
void check_edit(const SampleRect&, int width, int depth);
// Appends the ranges of the grid's heights in the rectangle, row by row.
void append_heights(const GroundGrid&, const SampleRect&, std::vector<DirtyRange>&);

}  // namespace terrabench
