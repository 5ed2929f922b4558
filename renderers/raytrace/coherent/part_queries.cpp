#include "renderers/raytrace/coherent/part_queries.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "renderers/raytrace/scattering.h"
#include "terrain/error.h"
#include "terrain/progress.h"

namespace terrabench {

RayPart::RayPart(TriangleMesh triangles, std::vector<glm::vec2> coordinates,
                 std::vector<std::uint32_t> of_triangles)
    : mesh(std::move(triangles)),
      texture(std::move(coordinates)),
      tags(std::move(of_triangles)),
      index(RayIndex::on_shared_device(mesh)) {
  const bool good = (texture.empty() || texture.size() == mesh.positions.size()) &&
                    (tags.empty() || tags.size() == mesh.triangles());
  if (good) return;
  throw bad_input(fmt::format("{} texture coordinates for {} positions, {} tags for {} triangles",
                              texture.size(), mesh.positions.size(), tags.size(), mesh.triangles()),
                  "a part", "give one for each, or none");
}

Memory RayPart::memory() const {
  Memory memory = payload_memory(mesh.positions, mesh.normals, texture);
  memory += index_memory(mesh.indices, tags);
  memory.index += heap_bytes(this) + index_objects();
  return memory;
}

std::size_t RayPart::index_objects() {
  static const std::size_t bytes = [] {
    TriangleMesh one;
    one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    one.indices = {0, 1, 2};
    const RayIndex first = RayIndex::on_shared_device(one);  // what Embree allocates once
    const HeapScope heap;
    const RayIndex second = RayIndex::on_shared_device(one);
    return static_cast<std::size_t>(std::max<std::int64_t>(heap.held(), 0));
  }();
  return bytes;
}

std::size_t RayPart::bytes() const { return memory().total() + index.bytes(); }

namespace {

constexpr std::size_t kRays = 2048;  // of a part, per task

std::vector<Bounds> boxes_of(const PartScene& scene) {
  std::vector<Bounds> boxes;
  boxes.reserve(scene.parts.size());
  for (const PartScene::Placement& part : scene.parts) boxes.push_back(part.box);
  return boxes;
}

// Distances stay the same: they are in lengths of the direction.
Ray transformed(const Ray& ray, const glm::mat4& matrix) {
  Ray local = ray;
  local.origin = glm::vec3(matrix * glm::vec4(ray.origin, 1));
  local.direction = glm::mat3(matrix) * ray.direction;
  return local;
}

PartHit surface(const RayPart& part, const glm::mat4& to_world, const Ray& ray, const RayHit& hit) {
  const TriangleMesh& mesh = part.mesh;
  const std::uint32_t* const corners = &mesh.indices[3 * std::size_t{hit.triangle}];
  const glm::vec3 a = mesh.positions[corners[0]];
  const glm::vec3 ab = mesh.positions[corners[1]] - a, ac = mesh.positions[corners[2]] - a;
  PartHit s;
  s.distance = hit.distance;
  s.point.triangle = hit.triangle;
  s.point.mesh = part.tags.empty() ? 0 : part.tags[hit.triangle];
  s.point.local = a + hit.u * ab + hit.v * ac;
  if (!part.texture.empty()) s.point.texture = hit.interpolate<glm::vec2>(part.texture, corners);
  const glm::mat3 of_normals = glm::transpose(glm::inverse(glm::mat3(to_world)));
  const glm::vec3 facet = glm::cross(ab, ac);
  s.point.position = glm::vec3(to_world * glm::vec4(s.point.local, 1));
  s.facet = unit_or(of_normals * unit_or(facet, {0, 1, 0}), -ray.direction);
  s.point.normal = mesh.normals.empty() ? facet : hit.interpolate<glm::vec3>(mesh.normals, corners);
  s.point.normal = unit_or(of_normals * s.point.normal, s.facet);
  const glm::vec3 size = glm::max(glm::abs(s.point.position), glm::abs(ab));
  s.offset = kRayOffset * std::max({size.x, size.y, size.z});
  return s;
}

}  // namespace

PartQueries::PartQueries(const PartScene& scene) : scene_(scene), tree_(boxes_of(scene)) {
  to_local_.reserve(scene.parts.size());
  for (const PartScene::Placement& part : scene.parts) to_local_.push_back(glm::inverse(part.to_world));
}

template <class Visit>
void PartQueries::run(std::span<const Ray> rays, const Visit& visit) const {
  struct Waiting {
    std::uint32_t part, ray;
    float entry, far;
    bool operator<(const Waiting& other) const {
      return part != other.part ? part < other.part : ray < other.ray;
    }
  };
  std::vector<Waiting> waiting(rays.size());
  for (std::uint32_t r = 0; r < rays.size(); ++r) waiting[r] = {BoxVisit::kNone, r, -1, rays[r].far};
  std::vector<std::size_t> groups;
  while (!waiting.empty()) {
    tbb::parallel_for(std::size_t{0}, waiting.size(), [&](std::size_t i) {
      Waiting& at = waiting[i];
      if (at.far < 0) {
        at.part = BoxVisit::kNone;
        return;
      }
      const BoxVisit next = tree_.next(rays[at.ray], {at.entry, at.part}, at.far);
      at.part = next.box;
      at.entry = next.entry;
    });
    std::erase_if(waiting, [](const Waiting& at) { return at.part == BoxVisit::kNone; });
    tbb::parallel_sort(waiting.begin(), waiting.end());
    groups.clear();
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      const bool fresh = i == 0 || waiting[i].part != waiting[i - 1].part;
      if (fresh || i - groups.back() == kRays) groups.push_back(i);
    }
    groups.push_back(waiting.size());
    tbb::parallel_for(
        std::size_t{0}, groups.size() - 1,
        [&](std::size_t g) {
          const std::uint32_t part = waiting[groups[g]].part;
          scene_.open(part, [&](const RayPart& opened) {
            for (std::size_t i = groups[g]; i < groups[g + 1]; ++i) {
              waiting[i].far = visit(opened, part, waiting[i].ray, waiting[i].far);
            }
          });
        },
        tbb::simple_partitioner());
    if (Progress::interrupted()) throw Error(ExitCode::kInterrupted, "interrupted", "ray tracing", "");
  }
}

void PartQueries::closest(std::span<const Ray> rays, std::span<PartHit> hits) const {
  std::fill(hits.begin(), hits.end(), PartHit{});
  run(rays, [&](const RayPart& opened, std::uint32_t part, std::uint32_t r, float far) {
    Ray local = transformed(rays[r], to_local_[part]);
    local.far = far;
    const RayHit hit = opened.index.closest(local);
    // At equal distances, the part that was visited first is seen.
    if (!hit.hit() || !(hit.distance < hits[r].distance)) return far;
    PartHit& s = hits[r] = surface(opened, scene_.parts[part].to_world, rays[r], hit);
    s.point.instance = part;
    return s.distance;
  });
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t r) {
    PartHit& s = hits[r];
    if (!s.hit()) return;
    if (glm::dot(s.facet, rays[r].direction) > 0) s.facet = -s.facet;
    if (glm::dot(s.point.normal, s.facet) < 0) s.point.normal = -s.point.normal;
  });
}

void PartQueries::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  std::fill(blocked.begin(), blocked.end(), std::uint8_t{0});
  run(rays, [&](const RayPart& opened, std::uint32_t part, std::uint32_t r, float far) {
    Ray local = transformed(rays[r], to_local_[part]);
    local.far = far;
    if (!opened.index.occluded(local)) return far;
    blocked[r] = 1;
    return -1.0F;
  });
}

}  // namespace terrabench
