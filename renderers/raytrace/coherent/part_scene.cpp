#include "renderers/raytrace/coherent/part_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "terrain/error.h"

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
  Memory memory = payload_memory(mesh.positions);
  memory += payload_memory(mesh.normals);
  memory += payload_memory(texture);
  memory += index_memory(mesh.indices);
  memory += index_memory(tags);
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

}  // namespace terrabench
