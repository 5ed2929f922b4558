// Figures 6 to 10 of "meshgrow": growing steps, the frame on a face, and the trunk that forks.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "experiments/cases.h"
#include "experiments/figures/figure.h"
#include "experiments/meshgrow/figure_numbers.h"
#include "experiments/meshgrow/fork.h"
#include "experiments/meshgrow/growing_pictures.h"
#include "experiments/meshgrow/models.h"
#include "renderers/raytrace/raytraced_picture.h"
#include "results/store/format.h"

namespace terrabench::meshgrow {
namespace {

using namespace figures;
using namespace growing;

constexpr Rgb kInk{20, 20, 24}, kHidden{130, 130, 138}, kPlain{238, 238, 236}, kNext{96, 96, 100};
constexpr Rgb kRed{190, 30, 30}, kGreen{0, 120, 50}, kBlue{0, 70, 180};

// As in the paper's figure 6: a face becomes a cube, then a tent, whose roofs become cubes.
constexpr std::string_view kCubesAndTent = R"(
[symbols]
A = []
B = []
C = []
t = []
s = []

[base]
shape = "prism"
sides = 4
radius = 0.7071
height = 0.8
symbol = "s"
top = "A"

[[rule]]
symbol = "A"
sections = [{ move = 0.9, sides = "s" }]
cap = "B"

[[rule]]
symbol = "B"
corners = 4
vertices = [{ mix = [0.5, 0, 0, 0.5], move = [0, 0, 0.5] }, { mix = [0, 0.5, 0.5, 0], move = [0, 0, 0.5] }]
faces = [[0, 1, 5, 4], [1, 2, 5], [4, 5, 2, 3], [3, 0, 4]]
symbols = ["C", "s", "C", "s"]

[[rule]]
symbol = "C"
sections = [{ move = 0.9, sides = "s" }]
cap = "t"

[[step]]
grow = "all"
)";

// The base and the mesh after each growing step of a model that only grows.
std::vector<GrownMesh> stages_of(const Model& model) {
  std::vector<GrownMesh> stages;
  expand(model, {.after_step = [&](const GrownMesh& mesh, std::uint32_t) { stages.push_back(mesh); }});
  return stages;
}

View view_of(const FaceMesh& mesh, int width, int height, const glm::vec3& from, float margin = 1.06F) {
  return close_view(mesh.positions, overview(box_of(mesh.positions), width, height, from), margin);
}

bool grows(const Model& model, const GrownMesh& mesh, std::uint32_t face) {
  return model.system.symbols[mesh.mesh.symbols[face]].grows();
}

// Whether a face is seen at an angle at which words on it can be read.
bool faces_eye(const FaceMesh& mesh, std::uint32_t face, const View& view) {
  const FaceShape shape = face_shape(mesh.face(face), mesh.positions);
  return glm::dot(shape.frame.z, glm::normalize(glm::dvec3(view.eye) - shape.frame.origin)) > 0.25;
}

// Faces that grow next are dark.
Image stage_picture(Drawing& drawing, const Model& model, const GrownMesh& mesh, const View& view) {
  return face_picture(drawing.gl(), mesh.mesh, view,
                      [&](std::uint32_t face) { return grows(model, mesh, face) ? kNext : kPlain; });
}

Sheet draw_steps(Drawing& drawing) {
  const Model model = parse_model(kCubesAndTent, "figure 6");
  const std::vector<GrownMesh> stages = stages_of(model);
  const View view = view_of(stages.back().mesh, 520, 760, {1.0F, 0.62F, 0.75F});
  constexpr std::array<std::string_view, 4> kWords{"base: A becomes a cube", "step 1: B becomes a tent",
                                                   "step 2: each C becomes a cube", "step 3"};
  constexpr double kGap = 12, kWords0 = 30;
  const double width = view.width / 2.0, height = view.height / 2.0;
  Sheet sheet(static_cast<double>(stages.size()) * (width + kGap) + kGap, height + kGap + kWords0);
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const GrownMesh& stage = stages[k];
    drawing.record(fmt::format("faces_{}", k), static_cast<double>(stage.mesh.faces()));
    drawing.record(fmt::format("growing_{}", k), static_cast<double>(stage.states.size()));
    const SheetPoint corner{kGap + static_cast<double>(k) * (width + kGap), kGap};
    sheet.picture(corner.x, corner.y, width, height, stage_picture(drawing, model, stage, view));
    sheet.text(corner.x + width / 2, corner.y + height + 16, kWords[std::min(k, kWords.size() - 1)], 16,
               "middle");
    const OverPicture over(stage.mesh, view, corner);
    for (std::uint32_t face = 0; face < stage.mesh.faces(); ++face) {
      const glm::vec3 middle = middle_of(stage.mesh, face);
      if (!over.visible(middle) || !faces_eye(stage.mesh, face, view)) continue;
      const SheetPoint at = over.at(middle);
      const Rgb ink = grows(model, stage, face) ? Rgb{255, 255, 255} : kInk;
      sheet.text(at.x, at.y + 6, model.system.symbols[stage.mesh.symbols[face]].name, 17, "middle", ink);
    }
  }
  return sheet;
}

constexpr Stroke kDashed{.colour = kHidden, .thickness = 1, .dashes = "4 4"};

// Each edge that the surface hides, once.
void add_hidden_edges(Sheet& sheet, const OverPicture& over, const FaceMesh& mesh) {
  for (std::uint32_t face = 0; face < mesh.faces(); ++face) {
    const auto corners = mesh.face(face);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const glm::vec3 a = mesh.positions[corners[k]], b = mesh.positions[corners[(k + 1) % corners.size()]];
      if (corners[k] > corners[(k + 1) % corners.size()] || over.visible(0.5F * (a + b))) continue;
      sheet.line(std::array{over.at(a), over.at(b)}, kDashed);
    }
  }
}

// The axes of a frame, `length` metres long; dashed where the surface hides them.
void add_axes(Sheet& sheet, const OverPicture& over, const Frame& frame, double length) {
  constexpr int kPieces = 32;
  const std::pair<glm::dvec3, Rgb> axes[] = {{frame.x, kRed}, {frame.y, kGreen}, {frame.z, kBlue}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [axis, colour] = axes[k];
    const auto place = [&](double share) { return frame.origin + share * length * axis; };
    // The origin lies on the surface itself: half a piece along the axis decides.
    for (int piece = 0; piece < kPieces; ++piece) {
      const bool seen = over.visible(place((piece + 0.5) / kPieces));
      if (!seen && piece % 4 >= 2) continue;
      sheet.stroke(over.at(place(1.0 * piece / kPieces)), over.at(place((piece + 1.0) / kPieces)), colour,
                   seen ? 3.2 : 2);
    }
    add_arrow(sheet, over.at(place(0.94)), over.at(place(1)), colour, 2.6, 9);
    add_label(sheet, over.at(place(1.25)), std::string_view("xyz").substr(k, 1), 17, colour, 8);
  }
  sheet.dot(over.at(frame.origin), 3.4, kInk);
}

// The faces that the expansion of the first growing face of `before` added, in that face's frame, with z up;
// the base, which vanishes, is the first face.
FaceMesh template_of(const GrownMesh& before, const GrownMesh& after, std::uint32_t base) {
  const Frame& frame = before.states.front().shape.frame;
  const auto first = static_cast<std::uint32_t>(before.mesh.positions.size());
  const auto corners = before.mesh.face(base);
  const std::uint32_t end = first + static_cast<std::uint32_t>(corners.size());
  FaceMesh mesh;
  for (const glm::vec3& p : after.mesh.positions) {
    const glm::dvec3 local = frame.to_local(p);
    mesh.positions.emplace_back(local.x, local.z, -local.y);
  }
  mesh.add_face(std::vector<std::uint32_t>(corners.rbegin(), corners.rend()));
  for (std::uint32_t face = 0; face < after.mesh.faces(); ++face) {
    const auto at = after.mesh.face(face);
    if (std::ranges::any_of(at, [&](std::uint32_t v) { return v >= first && v < end; })) mesh.add_face(at);
  }
  // Only what the faces use, so that the box fits.
  std::vector<std::uint32_t> used(mesh.corners.begin(), mesh.corners.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<glm::vec3> kept;
  for (const std::uint32_t vertex : used) kept.push_back(mesh.positions[vertex]);
  for (std::uint32_t& corner : mesh.corners) {
    corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
  }
  mesh.positions = kept;
  return mesh;
}

Sheet draw_frame(Drawing& drawing) {
  const Model model = parse_model(kCubesAndTent, "figure 6");
  const std::vector<GrownMesh> stages = stages_of(model);
  const GrownMesh &before = stages[2], &after = stages[3];
  constexpr double kGap = 14, kAxis = 0.62;
  const View view = view_of(after.mesh, 540, 760, {1.0F, 0.6F, -0.25F});
  const double width = view.width / 2.0, height = view.height / 2.0;
  std::uint32_t base = 0;
  while (!grows(model, before, base)) ++base;
  const Frame frame = before.states.front().shape.frame;
  record_frame(drawing, before, after, base);
  const FaceMesh cube = template_of(before, after, base);
  View near = view_of(cube, view.width, view.height, {-0.45F, 0.55F, 1.0F}, 1.5F);
  Frame local;  // drawn with z upwards
  local.y = {0, 0, -1};
  local.z = {0, 1, 0};

  Sheet sheet(3 * (width + kGap) + kGap, height + kGap + 34);
  const auto panel = [&](int column, const FaceMesh& mesh, const View& from, const Frame& axes, Rgb first,
                         std::uint32_t dark, std::string_view words) {
    const SheetPoint corner{kGap + column * (width + kGap), kGap};
    sheet.picture(corner.x, corner.y, width, height,
                  face_picture(drawing.gl(), mesh, from,
                               [&](std::uint32_t face) { return face == dark ? first : kPlain; }));
    const OverPicture over(mesh, from, corner);
    add_hidden_edges(sheet, over, mesh);
    add_axes(sheet, over, axes, kAxis);
    sheet.text(corner.x + width / 2, corner.y + height + 20, words, 15, "middle");
  };
  panel(0, before.mesh, view, frame, kNext, base, "a) the face and its frame");
  panel(1, cube, near, local, kPlain, 0, "b) the replacement on its first face");
  panel(2, after.mesh, view, frame, kPlain, 0, "c) attached in this frame");
  return sheet;
}

Sheet draw_coordinates(Drawing& drawing) {
  const Model model = parse_model(model_text("fork_ridges"), "fork_ridges");
  const Fork fork = find_fork(model, "branch");
  record_coordinates(drawing, model, fork);
  const FaceMesh& mesh = fork.after.mesh;
  const View view = view_of(mesh, 1100, 1240, {0.12F, 0.4F, 1.0F}, 1.15F);
  const double width = view.width / 2.0, height = view.height / 2.0;
  constexpr double kGap = 14;
  Sheet sheet(width + 2 * kGap, height + 2 * kGap + 28);
  const SheetPoint corner{kGap, kGap};
  sheet.picture(corner.x, corner.y, width, height,
                face_picture(drawing.gl(), mesh, view, [](std::uint32_t) { return kPlain; }));
  const OverPicture over(mesh, view, corner);
  add_hidden_edges(sheet, over, mesh);
  const auto shared = [&](std::uint32_t vertex) {
    return std::find_if(fork.shared.begin(), fork.shared.end(), [&](auto& s) { return s.vertex == vertex; });
  };
  for (const bool front : {false, true}) {
    for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
      const glm::vec3 p = mesh.positions[vertex];
      if (over.visible(p) != front) continue;
      const auto at = shared(vertex);
      const SheetPoint place = over.at(p);
      if (at == fork.shared.end()) {
        const std::string words = fmt::format("{:.2g}", mesh.texture[vertex].x);
        add_label(sheet, place, words, 13, front ? kInk : kHidden, words.size() > 1 ? 11 : 6);
        continue;
      }
      // Words beside the trunk, on the vertex's side of the other one.
      const auto& other = fork.shared[at == fork.shared.begin() ? 1 : 0];
      const bool left = place.x < over.at(mesh.positions[other.vertex]).x;
      const SheetPoint words{left ? kGap + 92 : kGap + width - 92, place.y + 130};
      sheet.stroke(place, {words.x, words.y - 10}, kRed, 1);
      sheet.dot(place, 4, kRed);
      sheet.text(words.x, words.y + 5,
                 fmt::format("u{} = ({:.1f} + {:.1f})/2 = {}", at == fork.shared.begin() ? "₁" : "₂",
                             at->alone[0], at->alone[1], at->u),
                 14, "middle", kRed);
    }
  }
  sheet.text(kGap + width / 2, height + 2 * kGap + 10, "grey numbers and dashed edges: behind the surface",
             13, "middle");
  return sheet;
}

// A white background, wood in daylight.
Image traced(const FaceMesh& mesh, bool wires, const View& view) {
  const ModelMesh triangles = triangles_of(mesh);
  RayMesh wood;
  wood.mesh = &triangles.mesh;
  wood.material.albedo = {0.5F, 0.42F, 0.33F};
  if (wires) {
    wood.wire_width = 2.6F;
    wood.wires = triangles.wires;
  }
  RayScene scene;
  scene.add_placed(std::move(wood));
  scene.light.sun = {-0.6F, 0.8F, 1.0F};
  scene.background = glm::vec3(1);
  return raytrace(scene, view, {.samples = 20, .bounces = 2});
}

constexpr glm::vec3 kTrunkFrom(0.55F, 0.25F, 1.0F);
constexpr int kTracedWidth = 800, kTracedHeight = 1000;

Sheet draw_trunk(Drawing& drawing) {
  const Model model = parse_model(model_text("forking_trunk"), "forking_trunk");
  const GrownMesh grown = expand(model, {.leave_out = {"smooth"}}), smooth = expand(model);
  const View view = view_of(grown.mesh, kTracedWidth, kTracedHeight, kTrunkFrom);
  drawing.record("grown_faces", static_cast<double>(grown.mesh.faces()));
  drawing.record("smooth_faces", static_cast<double>(smooth.mesh.faces()));
  // One quadrilateral per corner, of which two further steps make 16.
  drawing.record("faces_of_three_steps", 16 * static_cast<double>(grown.mesh.corners.size()));
  std::vector<Panel> panels{
      {traced(grown.mesh, true, view), fmt::format("grown: {} faces", format_count(grown.mesh.faces()))},
      {traced(smooth.mesh, false, view),
       fmt::format("smoothed three times: {} faces", format_count(smooth.mesh.faces()))}};
  for (const bool smoothed : {false, true}) {
    const std::string_view name = smoothed ? "smooth" : "grown";
    const Image& image = panels[smoothed ? 1 : 0].image;
    drawing.record(fmt::format("{}_stems_below", name), parts_in_row(image, 0.75));
    drawing.record(fmt::format("{}_stems_above", name), parts_in_row(image, 0.25));
    drawing.record(fmt::format("{}_largest_bend", name),
                   bends_of(smoothed ? smooth.mesh : grown.mesh).largest);
  }
  return panel_sheet({std::move(panels)});
}

Sheet draw_ridges(Drawing& drawing) {
  std::vector<Panel> panels;
  View view;
  for (const auto& [name, words] : {std::pair{"fork_ridges", "ridges along u"},
                                    std::pair{"fork_ridges_random", "with random displacements"}}) {
    const Model model = parse_model(model_text(name), name);
    const GrownMesh mesh = expand(model);
    const std::string_view kind = panels.empty() ? "even" : "random";
    drawing.record(fmt::format("{}_ridges", kind), ridges_along_u(model, mesh.mesh));
    drawing.record(fmt::format("{}_mean_bend", kind), bends_of(mesh.mesh).mean);
    if (panels.empty()) view = view_of(mesh.mesh, kTracedWidth, kTracedHeight, kTrunkFrom);
    panels.push_back({traced(mesh.mesh, false, view), words});
  }
  return panel_sheet({panels});
}

constexpr auto kFigures = std::to_array<Figure>({
    {6, "F6",
     "growing steps; faces show their symbols, and the dark grey ones are replaced in the next step (s and t "
     "have no rule)",
     draw_steps},
    {7, "F7",
     "the reference frame on a face that is expanded: at the face's centre, z along its normal, x along its "
     "first edge; the replacement's first face is laid on it; dashed: behind the surface",
     draw_frame},
    {8, "F8", "the fork of a trunk: the mesh after growing, and after three smoothing subdivisions",
     draw_trunk},
    {9, "F9",
     "u-coordinates of the grown mesh at a fork; the two vertices that both branches share get the averages "
     "u₁ and u₂",
     draw_coordinates},
    {10, "F10",
     "ridges: displacement by a cosine of the u-coordinate in the last two subdivisions; right, with noise "
     "and random displacements",
     draw_ridges},
});

}  // namespace

extern const Experiment kGrowingFigures = figures::figure_experiment<kFigures>(
    "meshgrow.growing-figures", "Figures 6 to 10: growing, and a trunk that forks");

}  // namespace terrabench::meshgrow
