// The same edits on every type of representation.
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>

#include "experiments/cross/representations/representation_costs.h"
#include "experiments/samples.h"
#include "experiments/stopwatch.h"
#include "representations/edit_tools.h"
#include "terrain/error.h"
#include "terrain/events/event.h"

namespace terrabench::cross {
namespace {

using events::RadialErosion;

// The tops of the ground's lines, the highest first.
std::vector<glm::vec3> tops(const GroundLines& lines) {
  std::vector<glm::vec3> all;
  for (std::size_t c = 0; c < lines.parts.lines(); ++c) {
    const auto line = lines.parts.line(c);
    if (!line.empty()) all.emplace_back(lines.x[c], line.back().top, lines.z[c]);
  }
  std::ranges::stable_sort(all, std::greater{}, &glm::vec3::y);
  return all;
}

// Where the ground's highest line stands, and a radius of a sixteenth of the shorter side; at most half the
// relief, so that no type digs through its floor.
Sphere place_of_edit(const Scene& scene) {
  const glm::vec3 size = scene.lines.bounds.size();
  Sphere sphere;
  if (const std::vector<glm::vec3> all = tops(scene.lines); !all.empty()) sphere.centre = all.front();
  sphere.radius = std::min({size.x / 16, size.z / 16, static_cast<float>(relief_of(scene)) / 2});
  return sphere;
}

struct EventPlace {
  RadialErosion event;
  bool taken = false;  // by a type that takes all events
};

RadialErosion event_of(const Sphere& sphere) {
  return {glm::dvec3(sphere.centre), glm::dvec3(sphere.radius)};
}

// Returns an event with the sphere's radius, on the highest vertical line where the first type with the trait
// events (the grounded heightmap tree) accepts it, and high enough not to reach below the ground. If the tree
// accepts none of the kMostPlaces highest lines or cannot be built, for example for lack of memory, returns
// the event at the sphere's own centre with taken = false. Trees of solids take no events.
EventPlace find_place(const Scene& scene, Sphere sphere, Progress& progress) {
  const EventPlace none{event_of(sphere)};
  const auto types = representations();
  const auto tree = std::ranges::find_if(types, [](const auto& type) { return type.traits.events; });
  if (tree == types.end()) return none;
  std::unique_ptr<Representation> built;
  try {
    built = scene.build(*tree, progress);
  } catch (const Error& error) {
    if (!refuses(error) && error.code() != ExitCode::kEnvironment) throw;
    return none;
  }
  constexpr std::size_t kMostPlaces =
      1000;  // bounds the time: a refused event costs as much as one that is taken
  std::size_t tried = 0;
  for (const glm::vec3 top : tops(scene.lines)) {
    if (tried++ == kMostPlaces || top.y - sphere.radius < scene.lines.bounds.low.y) break;
    sphere.centre = top;
    try {
      built->apply(event_of(sphere));
      return {event_of(sphere), true};
    } catch (const Error& error) {
      if (!refuses(error)) throw;
      if (error.code() == ExitCode::kUsage) break;  // here and anywhere else
    }
  }
  return none;
}

// Kept until another scene is asked for: all types get the same event.
const EventPlace& place_of_event(const Scene& scene, const Sphere& sphere, Progress& progress) {
  static std::optional<std::pair<SceneOptions, EventPlace>> kept;
  if (!kept || !(kept->first == scene.options))
    kept.emplace(scene.options, find_place(scene, sphere, progress));
  return kept->second;
}

// Heights: dug to the sphere's lower half, or filled up to its upper half within the ground's bounds.
void change_heights(Heightfield& field, const Sphere& sphere, Material material, float highest) {
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      const float dx = static_cast<float>(i) * field.cell_x - sphere.centre.x,
                  dz = static_cast<float>(j) * field.cell_z - sphere.centre.z;
      const float rest = sphere.radius * sphere.radius - dx * dx - dz * dz;
      float& height = field.at(i, j);
      if (!(rest > 0) || Heightfield::is_no_data(height)) continue;
      const float reach = std::sqrt(rest);
      height = material == Material::kAir ? std::min(height, sphere.centre.y - reach)
                                          : std::max(height, std::min(highest, sphere.centre.y + reach));
    }
  }
}

TerrainSource changed(const TerrainSource& source, const Sphere& sphere, Material material) {
  TerrainSource result = source;
  result.events = nullptr;
  if (result.heights) {
    change_heights(*result.heights, sphere, material, source.bounds().high.y);
    return result;
  }
  result.solid->column = [inner = source.solid->column, sphere, material](const ColumnSamples& at,
                                                                          std::span<Material> out) {
    inner(at, out);
    const float dx = at.x - sphere.centre.x, dz = at.z - sphere.centre.z;
    for (std::size_t k = 0; k < out.size(); ++k) {
      const float dy = at.y0 + static_cast<float>(k) * at.dy - sphere.centre.y;
      if (dx * dx + dy * dy + dz * dz < sphere.radius * sphere.radius) out[k] = material;
    }
  };
  return result;
}

TerrainSource eroded(const TerrainSource& source, const RadialErosion& event) {
  TerrainSource result = source;
  result.events = nullptr;
  if (result.heights) {
    Heightfield& field = *result.heights;
    for (int j = 0; j < field.depth; ++j) {
      for (int i = 0; i < field.width; ++i) {
        float& height = field.at(i, j);
        if (Heightfield::is_no_data(height)) continue;
        const glm::dvec2 plan(i * field.cell_x, j * field.cell_z);
        height = std::min(height, static_cast<float>(event.bottom(plan)));
      }
    }
    return result;
  }
  result.solid->column = [inner = source.solid->column, event](const ColumnSamples& at,
                                                               std::span<Material> out) {
    inner(at, out);
    const double bottom = event.bottom({at.x, at.z});
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (at.y0 + static_cast<float>(k) * at.dy > bottom) out[k] = Material::kAir;
    }
  };
  return result;
}

// The solid metres above and below the event's lower half, on lines within its ellipse.
class EventLines {
 public:
  explicit EventLines(const RadialErosion& event) {
    constexpr int kAlong = 61;  // across the ellipse
    for (int j = 0; j < kAlong; ++j) {
      for (int i = 0; i < kAlong; ++i) {
        const glm::vec2 plan(event.centre.x + event.radii.x * ((2.0 * i + 1) / kAlong - 1),
                             event.centre.z + event.radii.z * ((2.0 * j + 1) / kAlong - 1));
        const double bottom = event.bottom(plan);
        if (bottom == HUGE_VAL) continue;
        x_.push_back(plan.x);
        z_.push_back(plan.y);
        bottoms_.push_back(bottom);
      }
    }
  }

  struct Metres {
    std::vector<double> below;  // per line
    double above = 0;           // of all lines
  };
  Metres metres(const Representation& built) const {
    SpanSink sink;
    built.spans({x_, z_}, sink);
    Metres all;
    for (std::size_t c = 0; c < bottoms_.size(); ++c) {
      double below = 0;
      for (const Span& s : sink.column(c)) {
        const double cut = std::clamp<double>(bottoms_[c], s.bottom, s.top);
        below += cut - s.bottom;
        all.above += s.top - cut;
      }
      all.below.push_back(below);
    }
    return all;
  }

 private:
  std::vector<float> x_, z_;
  std::vector<double> bottoms_;
};

// Ground that was added below counts as well, such as a tunnel filled by a type without overhangs.
void record_misplaced(const EventLines::Metres& before, const EventLines::Metres& after, Recorder& recorder) {
  double misplaced = after.above;
  for (std::size_t c = 0; c < before.below.size(); ++c) {
    misplaced += std::abs(after.below[c] - before.below[c]);
  }
  recorder.add_ratio("event_misplaced", misplaced, before.above, "the event removes nothing");
}

// One number per triangle: a hash of the bits of its corners, the same wherever its first corner is.
std::vector<std::uint64_t> hashes(const TriangleMesh& mesh) {
  std::vector<std::uint64_t> all(mesh.triangles());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t t) {
    std::array<glm::vec3, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.indices[3 * t + k]];
    const auto first = std::min_element(corners.begin(), corners.end(), [](glm::vec3 a, glm::vec3 b) {
      return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    });
    std::rotate(corners.begin(), first, corners.end());
    std::uint64_t hash = 0;
    for (const glm::vec3& corner : corners) {
      for (const float value : {corner.x, corner.y, corner.z}) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;  // the golden ratio's bits
        hash ^= hash >> 29;
      }
    }
    all[t] = hash;
  });
  return all;
}

// A type on a ground before any edit, with which all edits are compared.
struct Untouched {
  const Scene& scene;
  const RepresentationType& type;
  const Representation& built;
  const TriangleMesh& mesh;  // of `built`
  Progress& progress;

  std::unique_ptr<Representation> build() const { return scene.build(type, progress); }
  // From a changed ground. It no longer lists its events, so that a tree would sample it as it does any
  // solid, at 128 columns by default; it gets the columns that the other types have.
  std::unique_ptr<Representation> build_from(const TerrainSource& ground) const {
    Parameters parameters = scene.parameters(type);
    if (scene.source.events && parameters.has("resolution")) {
      parameters.set("resolution", std::int64_t{scene.options.resolution});
    }
    return type.build(ground, parameters, progress);
  }
};

// After a step, "dig", "fill" or "event"; `mesh` is that before the step. Returns the new mesh.
TriangleMesh record_step(const std::string& step, const Representation& after, const Untouched& untouched,
                         const TriangleMesh& mesh, Recorder& recorder) {
  TriangleMesh now = after.mesh({});
  const auto bytes_before = static_cast<double>(untouched.built.memory().total());
  recorder.add(step + "_bytes", "B", static_cast<double>(after.memory().total()) - bytes_before);
  recorder.add(step + "_triangles", "", static_cast<double>(new_triangles(mesh, now)));
  return now;
}

void measure_sphere(const Untouched& untouched, const Sphere& sphere, Recorder& recorder) {
  const auto edit = [&](Representation& on, Material material) { fill_sphere(on, sphere, material); };
  {
    const auto edited = untouched.build();
    edit(*edited, Material::kAir);
    const TriangleMesh dug_mesh = record_step("dig", *edited, untouched, untouched.mesh, recorder);
    edit(*edited, Material::kBedrock);
    record_step("fill", *edited, untouched, dug_mesh, recorder);
  }
  Samples samples;
  samples.add({"dig_time", "fill_time"}, "s", [&] {
    const auto fresh = untouched.build();
    const double dig = seconds([&] { edit(*fresh, Material::kAir); });
    return std::vector{dig, seconds([&] { edit(*fresh, Material::kBedrock); })};
  });
  samples.take(recorder);
}

void measure_rebuilt_sphere(const Untouched& untouched, const Sphere& sphere, Recorder& recorder) {
  const TerrainSource dug = changed(untouched.scene.source, sphere, Material::kAir),
                      filled = changed(untouched.scene.source, sphere, Material::kBedrock);
  {
    const TriangleMesh dug_mesh =
        record_step("dig", *untouched.build_from(dug), untouched, untouched.mesh, recorder);
    record_step("fill", *untouched.build_from(filled), untouched, dug_mesh, recorder);
  }
  Samples samples;
  samples.add("dig_time", "s", [&] { return seconds_to_make([&] { return untouched.build_from(dug); }); });
  samples.add("fill_time", "s",
              [&] { return seconds_to_make([&] { return untouched.build_from(filled); }); });
  samples.take(recorder);
}

void record_event(const Untouched& untouched, const Representation& after, const RadialErosion& event,
                  Recorder& recorder) {
  record_step("event", after, untouched, untouched.mesh, recorder);
  const EventLines lines(event);
  record_misplaced(lines.metres(untouched.built), lines.metres(after), recorder);
}

void measure_event(const Untouched& untouched, const RadialErosion& event, Recorder& recorder) {
  {
    const auto edited = untouched.build();
    edited->apply(event);
    record_event(untouched, *edited, event, recorder);
  }
  Samples samples;
  samples.add("event_time", "s", [&] {
    const auto fresh = untouched.build();  // a loaded one has no spare capacity for events
    return seconds([&] { fresh->apply(event); });
  });
  samples.take(recorder);
}

void measure_rebuilt_event(const Untouched& untouched, const RadialErosion& event, Recorder& recorder) {
  const TerrainSource cut = eroded(untouched.scene.source, event);
  record_event(untouched, *untouched.build_from(cut), event, recorder);
  Samples samples;
  samples.add("event_time", "s", [&] { return seconds_to_make([&] { return untouched.build_from(cut); }); });
  samples.take(recorder);
}

}  // namespace

std::size_t new_triangles(const TriangleMesh& before, const TriangleMesh& after) {
  std::vector<std::uint64_t> known = hashes(before);
  tbb::parallel_sort(known);
  std::size_t found = 0;
  for (const std::uint64_t hash : hashes(after)) {
    found += !std::binary_search(known.begin(), known.end(), hash);
  }
  return found;
}

void measure_edit(const Scene& scene, const RepresentationType& type, const Representation& built,
                  const TriangleMesh& mesh, Recorder& recorder, Progress& progress) {
  const Sphere sphere = place_of_edit(scene);
  if (!(sphere.radius >= scene.cell)) {
    return recorder.undefined(
        {"rebuilt", "dig_bytes", "dig_triangles", "dig_time", "fill_bytes", "fill_triangles", "fill_time",
         "event_rebuilt", "event_bytes", "event_triangles", "event_time"},
        "the ground is too flat or too small for an edit as large as its cells");
  }
  const EventPlace& place = place_of_event(scene, sphere, progress);
  const bool digs = type.traits.editable, erodes = digs || (place.taken && type.traits.events);
  recorder.add("rebuilt", "", digs ? 0 : 1);
  recorder.add("event_rebuilt", "", erodes ? 0 : 1);
  const Untouched untouched{scene, type, built, mesh, progress};
  (digs ? measure_sphere : measure_rebuilt_sphere)(untouched, sphere, recorder);
  (erodes ? measure_event : measure_rebuilt_event)(untouched, place.event, recorder);
}

}  // namespace terrabench::cross
