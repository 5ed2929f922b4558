#include "representations/procedural_mesh/procedural_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "representations/column_grid.h"
#include "representations/heightmap/heightmap.h"
#include "representations/procedural_mesh/shell.h"
#include "terrain/error.h"
#include "terrain/separators.h"

namespace terrabench {
namespace {

constexpr int kMostLevels = 16;

std::vector<float> lines(int samples, double origin, double cell) {
  std::vector<float> at(static_cast<std::size_t>(samples));
  for (std::size_t i = 0; i < at.size(); ++i)
    at[i] = static_cast<float>(origin + static_cast<double>(i) * cell);
  return at;
}

void take_heights(const TerrainSource& source, const Parameters& parameters, MeshDescription& out) {
  check_heights(*source.heights, source.name);
  const auto resampled = at_resolution(*source.heights, parameters.integer("resolution"));
  const Heightfield& field = resampled ? *resampled : *source.heights;
  require_cells(field.width, field.depth, source.name);
  out.ground = {lines(field.width, 0, field.cell_x), lines(field.depth, 0, field.cell_z), field.heights};
  // A coarser field's ground may lie lower than the floor of the finer one, never by more than rounding.
  out.ground_bounds = {
      {0, std::min(source.bounds().low.y, height_range(field).lowest), 0},
      {field.extent_x(), std::max(source.bounds().high.y, height_range(field).highest), field.extent_z()}};
}

// The outermost cells reach half a cell beyond their samples: a border of further samples, at the bounds.
void take_topmost(const TerrainSource& source, const Parameters& parameters, MeshDescription& out,
                  Progress& progress) {
  const auto sampled = Heightmap::build(source, parameters, progress);
  const auto& map = static_cast<const Heightmap&>(*sampled);
  const HeightGrid& grid = map.grid();
  const auto padded = [](std::vector<float> at, float low, float high) {
    at.insert(at.begin(), low);
    at.push_back(high);
    return at;
  };
  HeightTexture& ground = out.ground;
  ground.x = padded(lines(grid.width, grid.origin_x, grid.cell_x), grid.bounds.low.x, grid.bounds.high.x);
  ground.z = padded(lines(grid.depth, grid.origin_z, grid.cell_z), grid.bounds.low.z, grid.bounds.high.z);
  for (int j = -1; j <= grid.depth; ++j) {
    const float* const row =
        map.heights().data() + static_cast<std::size_t>(std::clamp(j, 0, grid.depth - 1)) * grid.width;
    for (int i = -1; i <= grid.width; ++i) {
      ground.heights.push_back(row[std::clamp(i, 0, grid.width - 1)]);
    }
  }
  out.ground_bounds = grid.bounds;
}

// Metres between neighbouring vertices: of the plane, or on average of the model's edges.
float spacing_of(const MeshDescription& description, const FaceMesh& mesh) {
  if (description.has_ground()) {
    const auto between = [](const std::vector<float>& at) {
      return at.size() < 2 ? 0 : (at.back() - at.front()) / static_cast<float>(at.size() - 1);
    };
    const int left_out =
        std::min(description.leave_out, usable_levels(description.ground, description.levels));
    return std::ldexp(std::max(between(description.ground.x), between(description.ground.z)), left_out);
  }
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      sum += glm::distance(mesh.positions[face[k]], mesh.positions[face[(k + 1) % face.size()]]);
    }
  }
  return static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, mesh.corners.size())));
}

void add_spans(std::span<const Crossing> crossings, float floor, SpanSink& out) {
  int depth = 0;
  for (const Crossing& c : crossings) depth -= c.weight;  // so that it is air far above
  float bottom = floor;
  for (const Crossing& c : crossings) {
    const bool inside = depth > 0;
    depth += c.weight;
    if (!inside && depth > 0) bottom = std::max(floor, c.y);
    if (inside && depth <= 0 && bottom < c.y) out.add({bottom, c.y, Material::kBedrock});
  }
}

}  // namespace

std::span<const ParameterSpec> ProceduralMesh::parameters() {
  static const std::vector<ParameterSpec> kSpecs = column_parameters_and({
      {"levels", std::int64_t{4}, "",
       "subdivisions from the coarsest plane to the samples; a small field has fewer", 0, kMostLevels},
      {"leave_out", std::int64_t{0}, "",
       "late subdivisions to leave out, of a plane or a model, for a coarser mesh", 0, kMostLevels},
  });
  return kSpecs;
}

std::unique_ptr<Representation> ProceduralMesh::build(const TerrainSource& source,
                                                      const Parameters& parameters, Progress& progress) {
  MeshDescription description;
  const auto* const from = source.solid ? source.solid->column.target<MeshColumns>() : nullptr;
  if (from != nullptr) {
    description = from->mesh->description();
  } else if (source.heights) {
    take_heights(source, parameters, description);
  } else {
    take_topmost(source, parameters, description, progress);
  }
  if (from == nullptr) description.levels = static_cast<int>(parameters.integer("levels"));
  description.leave_out = static_cast<int>(parameters.integer("leave_out"));
  progress.begin("procedural mesh", 1);
  auto built = std::make_unique<ProceduralMesh>(std::move(description), source.name);
  progress.advance();
  return built;
}

ProceduralMesh::ProceduralMesh(MeshDescription description, const std::string& origin)
    : description_(std::move(description)), bounds_(description_.ground_bounds) {
  description_.model.shrink_to_fit();
  description_.ground.heights.shrink_to_fit();
  FaceMesh polygons = description_.polygons(origin);
  spacing_ = spacing_of(description_, polygons);
  std::vector<Triangle> triangles = triangulate(polygons);
  columns_ = TriangleColumns(std::move(polygons.positions), std::move(triangles));
  if (description_.model.empty()) return;
  Bounds model = box_of(columns_.positions());
  constexpr float kFarthest = 1e9F;  // as heights of files
  const glm::vec3 reach = glm::max(glm::abs(model.low), glm::abs(model.high));
  if (const float farthest = std::max({reach.x, reach.y, reach.z}); !(farthest <= kFarthest)) {
    throw bad_input(
        fmt::format("the model reaches {:.3g} m from its origin, farther than {:.0g} m", farthest, kFarthest),
        origin, "make it smaller: its coordinates are metres");
  }
  if (description_.has_ground()) {
    bounds_ = {glm::min(bounds_.low, model.low), glm::max(bounds_.high, model.high)};
    return;
  }
  const std::vector<DirectedEdge> border = open_edges(columns_.triangles());
  const bool open = !border.empty();
  if (open && !(area_of_sheets(columns_.positions(), columns_.triangles()) > 0)) {
    throw bad_input("an open mesh that looks down has no ground below it", origin,
                    "turn its faces over, or close it");
  }
  if (volume_of_closed_parts(columns_.positions(), columns_.triangles(), border) < 0) {
    throw bad_input("a closed mesh is turned inside out: it encloses air, and all around it would be solid",
                    origin, "turn its faces over: their corners run counter-clockwise, seen from outside");
  }
  // The block under a sheet is at least a sixteenth of its width thick.
  if (open) model.low.y -= std::max(model.size().x, model.size().z) / 16;
  bounds_ = model;
}

void ProceduralMesh::spans(Columns where, SpanSink& out) const {
  std::vector<Crossing> crossings;
  crossings.reserve(64);
  for (std::size_t c = 0; c < where.size(); ++c) {
    if (c % TriangleColumns::kTogether == 0) columns_.prefetch(where.x.subspan(c), where.z.subspan(c));
    columns_.crossings(where.x[c], where.z[c], crossings);
    add_spans(crossings, bounds_.low.y, out);
    out.end_column();
  }
}

TriangleMesh ProceduralMesh::mesh(MeshDetail detail) const {
  if (columns_.triangles().empty()) return {};
  const double coarser = spacing_ > 0 && detail.cell > 0 ? std::log2(detail.cell / spacing_) : 0;
  if (!(coarser >= 1)) return close_down(columns_.positions(), columns_.triangles(), bounds_.low.y);
  FaceMesh polygons =
      description_.polygons("model", static_cast<int>(std::min(coarser, double{kMostLevels})));
  std::vector<Triangle> triangles = triangulate(polygons);
  return close_down(std::move(polygons.positions), std::move(triangles), bounds_.low.y);
}

void MeshColumns::operator()(const ColumnSamples& at, std::span<Material> out) const {
  thread_local SpanSink sink;
  sink.clear();
  mesh->spans({{&at.x, 1}, {&at.z, 1}}, sink);
  const std::span<const Span> spans = sink.column(0);
  auto span = spans.begin();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float y = at.y0 + static_cast<float>(i) * at.dy;
    while (span != spans.end() && y >= span->top) ++span;
    out[i] = span != spans.end() && y >= span->bottom ? Material::kBedrock : Material::kAir;
  }
}

std::size_t ProceduralMesh::description_bytes() const {
  ByteSink sink;
  description_.save(sink);
  return sink.bytes().size();
}

Memory ProceduralMesh::memory() const {
  Memory memory = columns_.memory();
  memory += payload_memory(description_.ground.x, description_.ground.z, description_.ground.heights,
                           description_.model);
  memory.index += heap_bytes(this);
  return memory;
}

std::unique_ptr<Representation> ProceduralMesh::load(ByteSource& in) {
  MeshDescription description = MeshDescription::load(in);
  return std::make_unique<ProceduralMesh>(std::move(description), in.origin());
}

bool ProceduralMesh::encode(double largest_error, ByteSink& out) const {
  description_.save(out, largest_error);
  return true;
}

std::unique_ptr<Representation> ProceduralMesh::decode(ByteSource& in) {
  return std::make_unique<ProceduralMesh>(MeshDescription::load(in, true), in.origin());
}

// What the program holds of a description of so many bytes.
std::vector<std::pair<std::string, std::string>> ProceduralMesh::facts() const {
  return {{"expanded", fmt::format("{} triangles, {} B, from a description of {} B",
                                   with_separators(columns_.triangles().size()),
                                   with_separators(expanded_bytes()), with_separators(description_bytes()))}};
}

}  // namespace terrabench
