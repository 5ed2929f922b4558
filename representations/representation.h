// The one interface of all representations. A representation answers for every vertical line which parts of
// it are solid; overhangs, volumes, errors and ray hits all derive from that question.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/files.h"
#include "terrain/memory.h"
#include "terrain/mesh.h"
#include "terrain/parameters.h"
#include "terrain/progress.h"
#include "terrain/solid.h"
#include "terrain/source.h"

namespace terrabench {

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

// Receives the spans of a batch of columns, in order. Kept between batches, it allocates nothing once warm.
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
  float cell = 0;  // metres between vertices; 0 takes the structure's own resolution
};

class Representation {
 public:
  virtual ~Representation() = default;

  // Appends one column to `out` for each line asked for: its spans sorted upward and disjoint, touching spans
  // only where the material changes; none outside the terrain. A batch, so that the virtual call is paid
  // once. Thread-safe.
  virtual void spans(Columns where, SpanSink& out) const = 0;

  // The material at each point; air outside. The default asks spans(); methods with something quicker
  // override it.
  virtual void materials(Points where, std::span<Material> out) const;

  // Fills (or, with air, clears) from bottom to top in each column. For types whose traits say editable; the
  // others throw usage_error. Edits quantise as building does. Throws before anything is changed.
  virtual void paint(Columns where, std::span<const Span> what);

  virtual TriangleMesh mesh(MeshDetail detail) const = 0;  // watertight where the method promises it
  virtual Memory memory() const = 0;                       // every heap byte the structure holds
  virtual void save(ByteSink& out) const = 0;              // its own compact form, uncompressed
  virtual Bounds bounds() const = 0;
};

// Heap bytes that the structure holds by the allocator's count: what destroying it gives back. Nothing else
// may run.
std::int64_t destroy_and_count(std::unique_ptr<Representation>);

struct Traits {
  bool overhangs = false;
  bool materials = false;
  bool lossless = false;  // gives back the samples it was built from, to the bit
  bool editable = false;
};

struct RepresentationType {
  std::string_view name, summary, paper;
  Traits traits;
  std::span<const ParameterSpec> parameters;
  // The source must stay alive during the call only. Throws usage_error when it cannot represent such a
  // source.
  std::unique_ptr<Representation> (*build)(const TerrainSource&, const Parameters&, Progress&);
  std::unique_ptr<Representation> (*load)(ByteSource&);
};

// The table, one line a method: registry.cpp.
std::span<const RepresentationType> representations();
const RepresentationType& representation(std::string_view name);  // throws unknown_name

// Files: a header that names the type, then the structure's bytes, zstd-compressed and checksummed alike for
// all methods, so that sizes on disk compare. Reading a cut or altered file throws bad_input. Returns the
// bytes on disk.
std::size_t save_representation(const std::filesystem::path&, const RepresentationType&,
                                const Representation&);
struct Loaded {
  const RepresentationType* type = nullptr;
  std::unique_ptr<Representation> representation;
};
Loaded load_representation(const std::filesystem::path&);
// Whether the file says that it is one, by its first bytes; damaged ones say so too.
bool is_saved_representation(const std::filesystem::path&);
Loaded load_representation(std::span<const std::byte> file, const std::string& origin);

}  // namespace terrabench
