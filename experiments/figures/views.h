// Perspective pictures as papers draw ground: wire frames over white, and blocks of rock.
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
  std::vector<CutPlane> cuts{};        // only ground that none of them cuts away is shown
  View at(const Bounds& box) const { return overview(box, width, height, from); }
};

// Opaque white triangles that hide the wires behind them; `wires` as in SceneMesh.
SceneMesh wired(const TriangleMesh&, std::vector<std::uint8_t> wires, float wire_width,
                Rgb wire_colour = SceneMesh{}.wire_color);
// The mesh in the colour of cut rock, shaded by its true slopes. O(vertices)
SceneMesh rock(const TriangleMesh&);

// The edges of the mesh's quadrilaterals, without their diagonals, over white triangles.
Image wire_view(GlContext&, const TriangleMesh&, const Look&, float wire_width);

}  // namespace terrabench::figures
