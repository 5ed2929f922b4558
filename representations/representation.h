// The interface of all representations. A representation answers which parts of a vertical line are solid;
// overhangs, volumes, errors and ray hits all derive from the answer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrain/events/event.h"
#include "terrain/files.h"
#include "terrain/memory.h"
#include "terrain/mesh.h"
#include "terrain/parameters.h"
#include "terrain/progress.h"
#include "terrain/solid.h"
#include "terrain/source.h"

namespace terrabench {

struct ColumnGrid;      // column_grid.h
struct FaceMesh;        // procedural_mesh/face_mesh.h
struct LineGrid;        // line_grid.h
class RayCaster;        // ray_cast.h
struct ThermalErosion;  // layered_stack/thermal_erosion.h

// A solid stretch of a vertical line: bottom < top, metres.
struct Span {
  float bottom, top;
  Material material;
  bool operator==(const Span&) const = default;
};

// Vertical lines at (x[i], z[i]), metres. Both of one length.
struct Columns {
  std::span<const float> x, z;
  std::size_t size() const { return x.size(); }
};

struct Points {
  std::span<const float> x, y, z;
  std::size_t size() const { return x.size(); }
};

// Collects the spans of a batch of columns, in order. Reused for later batches it hardly allocates.
class SpanSink {
 public:
  void clear() {
    spans_.clear();
    ends_.clear();
  }
  void add(const Span& span) { spans_.push_back(span); }
  void end_column() { ends_.push_back(static_cast<std::uint32_t>(spans_.size())); }

  std::size_t columns() const { return ends_.size(); }
  std::span<const Span> column(std::size_t i) const {
    const std::uint32_t first = i == 0 ? 0 : ends_[i - 1];
    return {spans_.data() + first, ends_[i] - first};
  }
  std::span<const Span> all() const { return spans_; }

 private:
  std::vector<Span> spans_;
  std::vector<std::uint32_t> ends_;
};

struct MeshDetail {
  float cell = 0;  // metres between vertices; 0: the structure's own resolution
};

class Representation {
 public:
  virtual ~Representation() = default;

  // Appends one column to `out` per line: its spans, sorted upward and disjoint; spans touch only where the
  // material changes; none outside the terrain. A batch, so that the virtual call is paid once. Thread-safe.
  virtual void spans(Columns where, SpanSink& out) const = 0;

  // The material at each point; air outside. The default uses spans(); methods with something faster override
  // it.
  virtual void materials(Points where, std::span<Material> out) const;

  // Fills each column from the span's bottom to its top with its material (air clears). For types with the
  // trait `editable`; others throw usage_error. Quantises as building does. Throws before any change.
  virtual void edit(Columns where, std::span<const Span> what);
  // Changes the ground as the event of a grounded heightmap tree does. The default takes a radial erosion
  // alone, and by edit(); a type that takes all events has the trait `events`. Throws usage_error, before any
  // change, for an event that it does not take or that does not suit its ground.
  virtual void apply(const events::Event&);
  // Lets material slide until no open slope is steeper than the talus angle (degrees, 0 ≤ talus < 90). For
  // types with the trait `erodes`; others throw usage_error.
  virtual ThermalErosion erode_to(double talus, Progress&);

  // The lattice of columns that the structure consists of; null if it has none.
  virtual const ColumnGrid* column_grid() const { return nullptr; }
  // The vertical lines on which edit() acts; nothing if it does not. By default those of the columns.
  virtual std::optional<LineGrid> edited_lines() const;
  // The vertical lines along which it holds its ground; by default the edited ones, or kDefaultResolution of
  // them along the longer side.
  virtual LineGrid lines() const;
  // Closest hits of rays, without a mesh (ray_cast.h). Null for a type that has no caster of its own and no
  // column grid. The structure must outlive the caster and not be edited.
  virtual std::unique_ptr<RayCaster> ray_caster() const;
  // The faces to export; by default the triangles of mesh().
  virtual FaceMesh polygons() const;
  // What is particular to the structure, for people: a name and a sentence each.
  virtual std::vector<std::pair<std::string, std::string>> facts() const { return {}; }

  virtual TriangleMesh mesh(MeshDetail detail) const = 0;  // watertight where the method promises it
  virtual Memory memory() const = 0;                       // every heap byte the structure holds
  virtual void save(ByteSink& out) const = 0;              // to the bit, uncompressed
  // Appends its smallest form, by the coders of representations/coding: its heights are kept to within
  // `largest_error` metres, ≥ 0, or to 2⁻²⁰ of their range; all else exactly. Returns false, and appends
  // nothing, for a type that has no such form.
  virtual bool encode(double largest_error, ByteSink& out) const;
  virtual Bounds bounds() const = 0;
};

// The heap bytes that destroying the structure frees, by the count of operator new. No other thread may
// allocate meanwhile.
std::int64_t destroy_and_count(std::unique_ptr<Representation>);

struct Traits {
  bool overhangs = false;
  bool materials = false;
  bool lossless = false;  // returns the samples that it was built from, to the bit
  bool editable = false;
  bool events = false;  // takes all events of a grounded heightmap tree
  bool erodes = false;  // erode_to()
  bool rays = false;    // casts rays on ground with area without a mesh: ray_caster()
};

// How costs grow in theory: upper bounds, as exponents of the number of columns n. The default is a flat
// array of columns over heights: what it builds, holds, writes, reads and draws is proportional to the
// columns; a query, a ray or an edit within a fixed number of columns takes the same time at any size.
struct GrowthTheory {
  double build = 1, bytes = 1, query = 0, mesh = 1, ray = 0, edit = 0;
};

// A parameter that decides how large a file is and how closely it keeps the ground, which a search for the
// best files varies (besides `resolution`). Numbers from a low one above 0 are searched by their logarithm; a
// flag and a choice take all their values.
struct FileKnob {
  std::string_view parameter;
  double low = 0, high = 0;  // as multiples of `of`; both 0 of a flag and a choice
  // kColumn: the distance between columns at the resolution that is searched with it; kSamples: their number.
  enum Unit { kOne, kRelief, kColumn, kSamples } of = kOne;
  double error = 1;          // metres by which heights change per metre of a knob of kRelief
  bool solids_only = false;  // has no effect on heights
};

struct RepresentationType {
  std::string_view name, label, summary, paper;  // label: in figures
  Traits traits;
  std::span<const ParameterSpec> parameters;
  // Keeps no reference to the source. Throws usage_error for a source that the type cannot represent.
  std::unique_ptr<Representation> (*build)(const TerrainSource&, const Parameters&, Progress&);
  std::unique_ptr<Representation> (*load)(ByteSource&);
  std::unique_ptr<Representation> (*decode)(ByteSource&) = nullptr;  // what encode() wrote
  // Over height maps, and over a solid at growing resolution: n^1.5 voxels, surfaces of area n. Where none is
  // stated, growth is measured and not judged.
  std::optional<GrowthTheory> growth = {}, growth_in_solids = {};
  std::span<const FileKnob> file_knobs = {};
};

// The table, one entry per method: registry.cpp.
std::span<const RepresentationType> representations();
// Adds a method of another program, which then takes part in everything. To be called before anything else
// is: references to entries do not stay valid. Throws usage_error for a taken name or an unknown file knob.
void add_representation(const RepresentationType&);
const RepresentationType& representation(std::string_view name);  // throws unknown_name

// Files: a header that names the type, then the structure's bytes, zstd-compressed and checksummed alike for
// all methods. Reading a truncated or altered file throws bad_input. Returns the bytes on disk.
// With `largest_error` the structure is encoded, if its type can; without, it is kept to the bit.
std::size_t save_representation(const std::filesystem::path&, const RepresentationType&,
                                const Representation&, std::optional<double> largest_error = {});
struct Loaded {
  const RepresentationType* type = nullptr;
  std::unique_ptr<Representation> representation;
};
Loaded load_representation(const std::filesystem::path&);
// Whether the file's first bytes are those of a saved representation; the rest may be damaged.
bool is_saved_representation(const std::filesystem::path&);
Loaded load_representation(std::span<const std::byte> file, const std::string& origin);

}  // namespace terrabench
