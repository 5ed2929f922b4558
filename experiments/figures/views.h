// Pictures in space as papers draw ground: wires over white, and blocks of rock.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/figures/cut_away.h"
#include "renderers/context.h"
#include "renderers/scene.h"
#include "terrain/image.h"
#include "terrain/mesh.h"
#include "terrain/view.h"

namespace terrabench::figures {

struct Look {
  glm::vec3 from{0.55F, 0.75F, 1.0F};  // direction towards the eye
  int width = 800, height = 600;       // pixels
  std::vector<CutPlane> cuts{};        // the part behind all of them is shown
  View at(const Bounds& box) const { return overview(box, width, height, from); }
};

// White triangles, or of another `fill`, that hide what lies behind; `wires` as in SceneMesh.
SceneMesh wired(const TriangleMesh&, std::vector<std::uint8_t> wires, float wire_width,
                Rgb wire_colour = SceneMesh{}.wire_color);
// The colour of cut rock, lit as steeply as it stands. O(vertices)
SceneMesh rock(const TriangleMesh&);

// The borders of the mesh's four-sided cells over white ground.
Image wire_view(GlContext&, const TriangleMesh&, const Look&, float wire_width);

}  // namespace terrabench::figures
