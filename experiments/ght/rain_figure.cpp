// Figure 24 of "ght": the rain of particles (§4.2), as ght.complex measures it.
#include <fmt/format.h>

#include <cmath>

#include "experiments/ght/event_figures.h"
#include "experiments/ght/site.h"
#include "experiments/ght/tree_view.h"
#include "results/format.h"

namespace terrabench::ght {
namespace {

// A quarter of the measurement's samples along each side, which show at this size.
constexpr int kSide = 256, kParticles = 2500, kDrawn = 250;

// Octahedra over the places that the next particles will hit, at several heights.
TriangleMesh falling(const Ght& ght, Rain rain) {
  const float width = ght.bounds().size().x, size = 0.008F * width;
  TriangleMesh mesh;
  for (int k = 0; k < kDrawn; ++k) {
    glm::vec3 centre(std::get<events::RadialErosion>(rain.next(ght)).centre);
    const float turns = 0.618F * static_cast<float>(k);  // the golden ratio spreads its fractions evenly
    centre.y += width * (0.01F + 0.24F * (turns - std::floor(turns)));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3 corner :
         {glm::vec3(1, 0, 0), {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, -1, 0}}) {
      mesh.positions.push_back(centre + size * corner);
    }
    for (std::uint32_t side = 0; side < 4; ++side) {
      const std::uint32_t next = (side + 1) % 4;
      mesh.indices.insert(mesh.indices.end(), {first + side, first + next, first + 4});
      mesh.indices.insert(mesh.indices.end(), {first + next, first + side, first + 5});
    }
  }
  return mesh;
}

}  // namespace

figures::Sheet draw_rain(figures::Drawing& drawing) {
  GlContext& gl = drawing.gl();
  const Site site = make_site(kSide, kSide / kEventsAlong, drawing.seed());
  Ght ght = plain_tree(site.ground);
  Rain rain(site.ground, drawing.seed());
  const figures::Look look{{0.45F, 0.7F, 1.0F}, 760, 520};
  figures::Look window = look;
  window.cuts = around(ght, {96, 96}, {160, 160});
  figures::PanelRows rows{{{planes_view(gl, ght, look), "before: ground plane"},
                           {wires_view(gl, ght, window), "wireframe, a window of 65 × 65"},
                           {solid_view(gl, ght, look, falling(ght, rain)), "solid, the rain begins"}}};
  for (int k = 0; k < kParticles; ++k) ght.apply(rain.next(ght));
  const std::string particles = format_number(static_cast<double>(ght.model().tree.events().size()));
  rows.push_back({{planes_view(gl, ght, look), fmt::format("after {} particles: ground planes", particles)},
                  {wires_view(gl, ght, window), "wireframe, the same window"},
                  {solid_view(gl, ght, look), "solid"}});
  return panel_sheet(rows);
}

}  // namespace terrabench::ght
