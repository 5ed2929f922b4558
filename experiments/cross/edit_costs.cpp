// The same edit on every type of representation.
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "experiments/cross/representation_costs.h"
#include "experiments/stopwatch.h"
#include "representations/edit_tools.h"
#include "representations/ght/ght.h"
#include "terrain/error.h"

namespace terrabench::cross {
namespace {

// Where the ground's highest line stands, and a radius of a sixteenth of the shorter side; at most half the
// relief, so that no type digs through its floor.
Sphere place_of_edit(const Scene& scene) {
  const GroundLines& lines = scene.lines;
  Sphere sphere;
  float highest = -HUGE_VALF;
  for (std::size_t c = 0; c < lines.parts.lines(); ++c) {
    const auto line = lines.parts.line(c);
    if (line.empty() || line.back().top <= highest) continue;
    highest = line.back().top;
    sphere.centre = {lines.x[c], highest, lines.z[c]};
  }
  const glm::vec3 size = lines.bounds.size();
  sphere.radius = std::min({size.x / 16, size.z / 16, static_cast<float>(relief_of(scene)) / 2});
  return sphere;
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

bool apply_event(Ght& tree, const Sphere& sphere, Recorder& recorder) {
  const glm::dvec3 radii(sphere.radius);
  try {
    recorder.add("dig_time", "s", seconds([&] {
                   tree.apply(events::RadialErosion{glm::dvec3(sphere.centre), radii});
                 }));
    return true;
  } catch (const Error& error) {
    if (error.code() != ExitCode::kBadInput && error.code() != ExitCode::kUsage) throw;
    return false;  // trees of solids take no events, and some places allow none: built again
  }
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

class Edit {
 public:
  Edit(double bytes_before, const TriangleMesh& mesh, Recorder& recorder)
      : bytes_before_(bytes_before), mesh_(mesh), recorder_(recorder) {}

  // After a step of the edit, "dig" or "fill".
  void measure(const std::string& step, const Representation& built) {
    const auto bytes = static_cast<double>(built.memory().total());
    TriangleMesh mesh = built.mesh({});
    recorder_.add(step + "_bytes", "B", bytes - bytes_before_);
    recorder_.add(step + "_triangles", "", static_cast<double>(new_triangles(last(), mesh)));
    edited_ = std::move(mesh);
  }

 private:
  const TriangleMesh& last() const { return edited_.indices.empty() ? mesh_ : edited_; }

  double bytes_before_;
  const TriangleMesh& mesh_;
  TriangleMesh edited_;
  Recorder& recorder_;
};

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

void measure_edit(const Scene& scene, const RepresentationType& type, Representation& built,
                  const TriangleMesh& mesh, Recorder& recorder, Progress& progress) {
  const Sphere sphere = place_of_edit(scene);
  Edit edit(static_cast<double>(built.memory().total()), mesh, recorder);
  bool rebuilt = false;
  auto* const tree = dynamic_cast<Ght*>(&built);
  const std::array steps{std::pair{"dig", Material::kAir}, std::pair{"fill", Material::kBedrock}};
  if (type.traits.editable) {
    for (const auto& [step, material] : steps) {
      recorder.add(step + std::string("_time"), "s", seconds([&] { fill_sphere(built, sphere, material); }));
      edit.measure(step, built);
    }
  } else if (tree != nullptr && apply_event(*tree, sphere, recorder)) {
    edit.measure("dig", built);
  } else {
    rebuilt = true;
    for (const auto& [step, material] : steps) {
      const TerrainSource edited = changed(scene.source, sphere, material);
      std::unique_ptr<Representation> again;
      recorder.add(step + std::string("_time"), "s",
                   seconds([&] { again = type.build(edited, scene.parameters(type), progress); }));
      edit.measure(step, *again);
    }
  }
  recorder.add("rebuilt", "", rebuilt ? 1 : 0);
}

}  // namespace terrabench::cross
