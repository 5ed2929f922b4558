// The one interface of all level-of-detail methods: a view goes in, batches of triangles come out, and what
// can be kept from the last frame is kept. No method measures itself: error, cracks and popping are the
// meters' (meters/).
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "terrain/frame.h"
#include "terrain/heightfield.h"
#include "terrain/memory.h"
#include "terrain/parameters.h"
#include "terrain/progress.h"
#include "terrain/view.h"

namespace terrabench {

class Lod {
 public:
  virtual ~Lod() = default;
  // The triangles for this view. The frame stays valid until the next call. Any view is legal: an eye under
  // ground, outside or far away. Throws usage_error for a view that is none (NaN, no pixels, a field of view
  // outside (0, π)); see check_view().
  virtual const Frame& update(const View&) = 0;
  // Turns the method's one knob (LodType::knob) to setting(), which throws for NaN; takes effect with the
  // next update().
  virtual void tune(double knob) = 0;
  virtual Memory memory() const = 0;  // every heap byte that it holds, itself included
};

// What trades triangles for error. Methods are compared at equal measured error, so its unit is the method's
// own.
struct Knob {
  std::string_view name, unit;
  double finest = 0, coarsest = 0, fallback = 0;  // finest may be above or below coarsest
  bool whole = false;                             // takes whole numbers only
};

struct LodTraits {
  bool conforming = true;     // promises no cracks
  bool bounds_error = false;  // promises a screen-space error: the knob, in pixels
};

struct LodType {
  std::string_view name, summary, paper;
  LodTraits traits;
  Knob knob;
  std::span<const ParameterSpec> parameters;
  // Any size of field from 2×2 on, no 2ⁿ+1 asked for; holes are filled first (fill_no_data). The field must
  // outlive the method, which may point into it. Throws usage_error for a smaller one.
  std::unique_ptr<Lod> (*build)(const Heightfield&, const Parameters&, Progress&);
};

// The table, one line a method: registry.cpp.
std::span<const LodType> lods();
const LodType& lod(std::string_view name);  // throws unknown_name

// The knob's setting nearest to the value: from finest to coarsest, and whole where it must be. Throws
// usage_error for NaN.
double setting(const Knob&, double value);

// Throws usage_error, naming the field, for a view that no frame can be made for.
void check_view(const View&);
// Throws usage_error for a field under 2×2 or with no-data in it.
void check_ground(const Heightfield&);
// The grid that a field's samples make.
GroundGrid grid_of(const Heightfield&);

}  // namespace terrabench
