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
#include "experiments/refusals.h"
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

// The ground without its events after `heights` changed a height field, column by column, or `solid` a solid,
// line by line.
template <class Heights, class Solid>
TerrainSource changed(const TerrainSource& source, const Heights& heights, const Solid& solid) {
  TerrainSource result = source;
  result.events = nullptr;
  if (!result.heights) {
    result.solid->column = [inner = source.solid->column, solid](const ColumnSamples& at,
                                                                 std::span<Material> out) {
      inner(at, out);
      solid(at, out);
    };
    return result;
  }
  Heightfield& field = *result.heights;
  for (int j = 0; j < field.depth; ++j) {
    for (int i = 0; i < field.width; ++i) {
      float& height = field.at(i, j);
      if (Heightfield::is_no_data(height)) continue;
      height = heights(static_cast<float>(i) * field.cell_x, static_cast<float>(j) * field.cell_z, height);
    }
  }
  return result;
}

// Heights are dug to the sphere's lower half, or filled up to its upper half within the ground's bounds.
TerrainSource with_sphere(const TerrainSource& source, const Sphere& sphere, Material material) {
  const auto squared_rest = [sphere](float x, float z) {
    const float dx = x - sphere.centre.x, dz = z - sphere.centre.z;
    return sphere.radius * sphere.radius - dx * dx - dz * dz;
  };
  const auto heights = [&, highest = source.bounds().high.y](float x, float z, float height) {
    const float rest = squared_rest(x, z);
    if (!(rest > 0)) return height;
    const float reach = std::sqrt(rest);
    return material == Material::kAir ? std::min(height, sphere.centre.y - reach)
                                      : std::max(height, std::min(highest, sphere.centre.y + reach));
  };
  return changed(source, heights, [=](const ColumnSamples& at, std::span<Material> out) {
    const float dx = at.x - sphere.centre.x, dz = at.z - sphere.centre.z;
    for (std::size_t k = 0; k < out.size(); ++k) {
      const float dy = at.y0 + static_cast<float>(k) * at.dy - sphere.centre.y;
      if (dx * dx + dy * dy + dz * dz < sphere.radius * sphere.radius) out[k] = material;
    }
  });
}

TerrainSource eroded(const TerrainSource& source, const RadialErosion& event) {
  const auto heights = [&](float x, float z, float height) {
    return std::min(height, static_cast<float>(event.bottom({x, z})));
  };
  return changed(source, heights, [event](const ColumnSamples& at, std::span<Material> out) {
    const double bottom = event.bottom({at.x, at.z});
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (at.y0 + static_cast<float>(k) * at.dy > bottom) out[k] = Material::kAir;
    }
  });
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
struct Baseline {
  const Scene& scene;
  const RepresentationType& type;
  const Parameters& parameters;
  const Representation& built;
  const TriangleMesh& mesh;  // of `built`
  Progress& progress;

  std::unique_ptr<Representation> build() const { return type.build(scene.source, parameters, progress); }
  // From a changed ground. It no longer lists its events, so that a tree would sample it as it does any
  // solid, at 128 columns by default; it gets the columns that the other types have.
  std::unique_ptr<Representation> build_from(const TerrainSource& ground) const {
    Parameters changed = parameters;
    if (scene.source.events && changed.has("resolution") && changed.integer("resolution") == 0) {
      changed.set("resolution", std::int64_t{scene.options.resolution});
    }
    return type.build(ground, changed, progress);
  }
};

// One of the edits that follow each other on a structure: "dig", "fill" or "event".
struct Step {
  std::string name;
  std::function<void(Representation&)> edit;
  std::function<TerrainSource()> ground;  // from which a type that does not take the edit is built again
};

// Records the steps, and times them. Calls last() with the structure after all of them.
template <class Last>
void measure_steps(const Baseline& baseline, std::span<const Step> steps, bool rebuilds, Recorder& recorder,
                   const Last& last) {
  std::vector<TerrainSource> grounds;
  for (const Step& step : steps) {
    if (rebuilds) grounds.push_back(step.ground());
  }
  // Drills tuned for an error may not reach it on the changed ground; an event may pass between the samples
  // of a coarse tree.
  try {
    for (const TerrainSource& ground : grounds) baseline.build_from(ground);
    if (!rebuilds) {
      const auto changed = baseline.build();
      for (const Step& step : steps) step.edit(*changed);
    }
  } catch (const Error& error) {
    if (!refuses(error)) throw;
    for (const Step& step : steps) {
      const std::string bytes = step.name + "_bytes", triangles = step.name + "_triangles",
                        time = step.name + "_time";
      recorder.undefined({bytes, triangles, time}, "the type does not take the change at this setting");
    }
    return;
  }
  const auto bytes_before = static_cast<double>(baseline.built.memory().total());
  std::unique_ptr<Representation> after = rebuilds ? nullptr : baseline.build();
  TriangleMesh mesh = baseline.mesh;
  Samples samples;
  std::vector<std::string> times;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (rebuilds) {
      after = baseline.build_from(grounds[k]);
      samples.add(steps[k].name + "_time", "s", [&baseline, &ground = grounds[k]] {
        return seconds_to_make([&] { return baseline.build_from(ground); });
      });
    } else {
      steps[k].edit(*after);
    }
    TriangleMesh now = after->mesh({});
    recorder.add(steps[k].name + "_bytes", "B", static_cast<double>(after->memory().total()) - bytes_before);
    recorder.add(steps[k].name + "_triangles", "", static_cast<double>(new_triangles(mesh, now)));
    mesh = std::move(now);
    times.push_back(steps[k].name + "_time");
  }
  last(*after);
  after.reset();
  if (!rebuilds) {
    samples.add(times, "s", [&baseline, steps] {
      const auto fresh = baseline.build();  // a loaded one has no spare capacity for events
      std::vector<double> all;
      for (const Step& step : steps) all.push_back(seconds([&] { step.edit(*fresh); }));
      return all;
    });
  }
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

void measure_edit(const Scene& scene, const RepresentationType& type, const Parameters& parameters,
                  const Representation& built, const TriangleMesh& mesh, Recorder& recorder,
                  Progress& progress) {
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
  const Baseline baseline{scene, type, parameters, built, mesh, progress};
  const auto sphere_step = [&](const char* name, Material material) {
    return Step{name, [=](Representation& on) { fill_sphere(on, sphere, material); },
                [&, material] { return with_sphere(scene.source, sphere, material); }};
  };
  const std::array spheres{sphere_step("dig", Material::kAir), sphere_step("fill", Material::kBedrock)};
  measure_steps(baseline, spheres, !digs, recorder, [](const Representation&) {});
  const std::array events{Step{"event", [&](Representation& on) { on.apply(place.event); },
                               [&] { return eroded(scene.source, place.event); }}};
  measure_steps(baseline, events, !erodes, recorder, [&](const Representation& after) {
    const EventLines lines(place.event);
    record_misplaced(lines.metres(built), lines.metres(after), recorder);
  });
}

}  // namespace terrabench::cross
