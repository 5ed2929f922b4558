#include <fmt/format.h>

#include <map>
#include <set>

#include "representations/procedural_mesh/growing/rules.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

class Check {
 public:
  Check(const Template& mesh, const std::string& file, Place place)
      : mesh_(mesh),
        where_(fmt::format("{}:{}:{}", file, place.line, place.column)),
        vertices_(mesh.corners + static_cast<std::uint32_t>(mesh.vertices.size())) {}

  void run() {
    for (std::size_t f = 0; f + 1 < mesh_.first_corner.size(); ++f) face(f);
    base();
    for (const auto& [edge, next] : next_) inner_edge(edge);
    for (std::uint32_t v = 0; v < vertices_; ++v) fan(v);
  }

 private:
  [[noreturn]] void fail(const std::string& what, std::string_view advice) const {
    throw bad_input(what, where_, advice);
  }

  bool is_base(std::uint32_t v) const { return v < mesh_.corners; }

  void face(std::size_t f) {
    const auto first = mesh_.face_corners.begin() + mesh_.first_corner[f];
    const auto last = mesh_.face_corners.begin() + mesh_.first_corner[f + 1];
    const std::vector<std::uint32_t> corners(first, last);
    if (corners.size() < 3) fail(fmt::format("face {} has fewer than 3 corners", f + 1), "list its corners");
    if (std::set<std::uint32_t>(first, last).size() != corners.size()) {
      fail(fmt::format("face {} has a corner twice", f + 1), "list each corner once");
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % corners.size()];
      const std::uint32_t before = corners[(i + corners.size() - 1) % corners.size()];
      if (a >= vertices_) {
        fail(fmt::format("face {} names vertex {} of {}", f + 1, a, vertices_), "count vertices from 0");
      }
      if (!next_.emplace(Edge{a, b}, before).second) {
        fail(fmt::format("the edge from {} to {} is used twice in this direction", a, b),
             "list the corners of all faces counter-clockwise seen from outside");
      }
    }
  }

  void base() {
    for (std::uint32_t i = 0; i < mesh_.corners; ++i) {
      const std::uint32_t next = (i + 1) % mesh_.corners;
      if (next_.contains({i, next}) && !next_.contains({next, i})) continue;
      fail(fmt::format(
               "the template does not fit its face: the edge from {} to {} of the base must be used by "
               "one face, in this direction",
               i, next),
           "give each edge of the base a face");
    }
  }

  void inner_edge(Edge edge) const {
    const auto [a, b] = edge;
    if (is_base(a) && is_base(b)) {
      if (b == (a + 1) % mesh_.corners) return;
      fail(fmt::format("an edge from {} to {} joins two corners of the base", a, b),
           "put a vertex between them");
    }
    if (!next_.contains({b, a})) {
      fail(fmt::format("the edge from {} to {} has one face only", a, b), "close the template");
    }
  }

  // Walks around the vertex from face to face and compares with the number of faces there.
  void fan(std::uint32_t v) const {
    std::size_t faces = 0;
    std::uint32_t start = v;
    for (auto at = next_.lower_bound({v, 0}); at != next_.end() && at->first.first == v; ++at) {
      ++faces;
      if (start == v) start = at->first.second;
    }
    if (faces == 0) fail(fmt::format("vertex {} belongs to no face", v), "remove it");
    if (is_base(v)) start = (v + 1) % mesh_.corners;
    std::size_t walked = 0;
    for (std::uint32_t at = start; walked < faces + 1; ++walked) {
      const auto found = next_.find({v, at});
      if (found == next_.end()) break;
      at = found->second;
      if (at == start) {
        ++walked;
        break;
      }
    }
    if (walked != faces) {
      fail(fmt::format("the faces around vertex {} do not form one fan", v), "split the vertex in two");
    }
  }

  const Template& mesh_;
  std::string where_;
  std::uint32_t vertices_;
  std::map<Edge, std::uint32_t> next_;  // the corner before the edge in its face
};

}  // namespace

void check_template(const Template& mesh, const std::string& file, Place place) {
  if (!mesh.extruded()) Check(mesh, file, place).run();
}

}  // namespace terrabench::growing
