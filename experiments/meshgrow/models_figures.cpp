// Figures 11 to 16 of "meshgrow": the models of §7, ray traced (§6).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <optional>
#include <span>

#include "experiments/cases.h"
#include "experiments/experiment.h"
#include "experiments/figures/figure.h"
#include "experiments/figures/measures.h"
#include "experiments/meshgrow/figure_numbers.h"
#include "experiments/meshgrow/fork.h"
#include "experiments/meshgrow/models.h"
#include "experiments/meshgrow/subdivision_reference.h"
#include "renderers/raytrace/raytraced_picture.h"
#include "results/store/format.h"

namespace terrabench::meshgrow {
namespace {

// What the second picture shows: the mesh before the subdivision, or the model without its leaves.
enum class Beside : std::uint8_t { kWires, kBare };

struct ModelFigure {
  std::string_view name, model, caption;
  glm::vec3 from;                   // direction towards the eye
  float aspect;                     // width of the picture per height
  std::optional<glm::vec3> ground;  // albedo; none: the model stands before white
  Beside beside;
};

constexpr glm::vec3 kStone(0.55F, 0.53F, 0.5F), kSand(0.62F, 0.5F, 0.34F), kMoss(0.4F, 0.42F, 0.34F),
    kGrass(0.42F, 0.44F, 0.34F);
constexpr auto kFigures = std::to_array<ModelFigure>({
    {"F11", "chair", "a chair with folds in the cushion, and its mesh before subdivision",
     glm::vec3(0.85F, 0.42F, 0.62F), 0.85F, kStone, Beside::kWires},
    {"F12", "cactus",
     "a cactus, grown by alternating growing and subdivision steps, and its mesh before subdivision",
     glm::vec3(0.3F, 0.38F, 1.0F), 0.85F, kSand, Beside::kWires},
    {"F13", "fork_ridges_random", "the ridges on a forking branch, and its mesh before subdivision",
     glm::vec3(0.25F, 0.38F, 1.0F), 0.8F, kMoss, Beside::kWires},
    {"F14", "branch_aspen",
     "a branch of a tree on a piece of its trunk, with and without its leaves: quaking aspen, by the "
     "parameters of Weber and Penn",
     glm::vec3(0.1F, 0.1F, 1.0F), 1.0F, std::nullopt, Beside::kBare},
    {"F15", "bush_tupelo",
     "dense foliage: a whole young black tupelo, by the parameters of Weber and Penn, with and without "
     "its leaves. The paper's caption says \"a branch\", its §6 \"the bush\"",
     glm::vec3(0.4F, 0.38F, 1.0F), 0.78F, kGrass, Beside::kBare},
    {"F16", "candle_holder", "a wrought-iron candle holder with rust stains, and its mesh before subdivision",
     glm::vec3(0.35F, 0.38F, 1.0F), 0.8F, kStone, Beside::kWires},
});
constexpr auto kFigureNames = names_of(kFigures);

const std::array kSpecs{
    choice("figure", kFigureNames, "number in the paper"),
    ParameterSpec{"height", std::int64_t{1000}, "pixels", "of the picture", 32, 8192},
    ParameterSpec{"samples", std::int64_t{20}, "", "paths per pixel", 1, 65536},
    ParameterSpec{"bounces", std::int64_t{2}, "", "reflections between surfaces", 0, 64},
};

std::vector<Case> cases(const RunOptions& options) {
  if (options.profile == Profile::kPaper) return cases_by("figure", kSpecs);
  return cases_by(
      "figure", kSpecs,
      {{"height", std::int64_t{420}}, {"samples", std::int64_t{12}}, {"bounces", std::int64_t{2}}});
}

// The mesh and, on ground, its shadow.
std::vector<glm::vec3> in_picture(const TriangleMesh& mesh, bool on_ground) {
  std::vector<glm::vec3> points = mesh.positions;
  if (!on_ground) return points;
  const float ground = bounds_of(mesh).low.y;
  const glm::vec3 sun = model_daylight().sun;
  for (const glm::vec3& p : mesh.positions) points.push_back(p - (p.y - ground) / sun.y * sun);
  return points;
}

// A picture of one state of a figure's model, all by the same camera.
class Picture {
 public:
  Picture(const ModelFigure& figure, const View& view, const Bounds& box, const RaytraceSettings& settings,
          Progress& progress)
      : figure_(figure), view_(view), ground_(ground_plane(box)), settings_(settings), progress_(progress) {}

  figures::Panel in_daylight(const ModelMesh& mesh, const growing::RuleSystem& system,
                             std::string_view words) const {
    RayScene scene;
    scene.light = model_daylight();
    scene.add_placed(in_materials(mesh, painted(figure_.model), system));
    if (figure_.ground) {
      scene.add_placed({.mesh = &ground_, .material = {.albedo = *figure_.ground, .roughness = 1}});
    } else {
      scene.background = glm::vec3(1);
    }
    return {raytrace(scene, view_, settings_, &progress_),
            fmt::format("{}{} triangles", words, format_count(mesh.mesh.triangles()))};
  }

  // From the same direction, as large as the picture allows.
  figures::Panel in_wires(const ModelMesh& mesh) const {
    RaytraceSettings settings = settings_;
    View view = view_;
    view.width = view.width * 3 / 4;
    view = close_view(mesh.mesh.positions, view);
    settings.samples = std::max(settings.samples / 2, 4);
    RayScene scene;
    scene.light.sky = SkyKind::kUniform;
    scene.light.zenith = glm::vec3(0.75F);
    scene.light.sun_irradiance = glm::vec3(0);
    scene.background = glm::vec3(1);
    scene.add_placed({.mesh = &mesh.mesh,
                      .material = {.albedo = glm::vec3(0.85F)},
                      .wire_width = 1.6F,
                      .wires = mesh.wires});
    return {raytrace(scene, view, settings, &progress_), "before subdivision"};
  }

 private:
  const ModelFigure& figure_;
  View view_;
  TriangleMesh ground_;
  RaytraceSettings settings_;
  Progress& progress_;
};

double area_of(const TriangleMesh& mesh, std::size_t triangle) {
  const auto corners = std::span(mesh.indices).subspan(3 * triangle, 3);
  return 0.5 * static_cast<double>(glm::length(figures::across_face<glm::vec3>(mesh.positions, corners)));
}

// Of the triangles whose symbols these are: how many, and their area in square metres.
struct Amount {
  double triangles = 0, area = 0;
};
Amount amount_of(const ModelMesh& mesh, const growing::RuleSystem& system, std::string_view symbol) {
  Amount amount;
  for (std::size_t t = 0; t < mesh.symbols.size(); ++t) {
    if (system.symbols[mesh.symbols[t]].name != symbol) continue;
    ++amount.triangles;
    amount.area += area_of(mesh.mesh, t);
  }
  return amount;
}

// The chair: how far the folds move the cloth, and all that is not cloth.
void record_folds(const growing::Model& model, const FaceMesh& mesh, Recorder& recorder) {
  const std::vector<double> heights = heights_over(mesh, without_displacements(model, "folds").mesh);
  RootMeanSquare cloth, rest;
  for (std::uint32_t face = 0; face < mesh.faces(); ++face) {
    const bool is_cloth = model.system.symbols[mesh.symbols[face]].name == "cloth";
    for (const std::uint32_t v : mesh.face(face)) (is_cloth ? cloth : rest).add(heights[v]);
  }
  recorder.add("folds_of_cloth", "m", cloth.value());
  recorder.add("folds_elsewhere", "m", rest.value());
}

// The cactus: its spikes, of four triangles each, and what they add to the model without them. A spike's
// template puts four quadrilaterals and the spike in the place of a quadrilateral.
void record_spikes(const growing::Model& model, const ModelMesh& mesh, Recorder& recorder) {
  const ModelMesh without = triangles_of(growing::expand(model, {.leave_out = {"spikes"}}).mesh);
  const ModelMesh before = triangles_of(growing::expand(model, {.most_steps = 1}).mesh);
  const double spikes = amount_of(mesh, model.system, "spike").triangles / 4;
  recorder.add("spikes", "", spikes);
  recorder.add("triangles_of_spikes", "", (4 * 2 + 4 - 2) * spikes);
  recorder.add("triangles_more", "",
               static_cast<double>(mesh.mesh.triangles()) - static_cast<double>(without.mesh.triangles()));
  recorder.add("spikes_before", "", amount_of(before, model.system, "spike").triangles);
}

// The candle holder: the share of the iron's area that is rusty, and how deep rust and clean iron lie against
// the model without the step that rust eats.
void record_rust(const growing::Model& model, const FaceMesh& mesh, const PaintedModel& look,
                 Recorder& recorder) {
  const std::vector<double> heights = heights_over(mesh, without_displacements(model, "rust").mesh);
  double iron_area = 0, rusty_area = 0, rusty_height = 0, clean_height = 0;
  for (std::uint32_t face = 0; face < mesh.faces(); ++face) {
    const std::string_view symbol = model.system.symbols[mesh.symbols[face]].name;
    if (symbol == "wax") continue;
    const auto corners = mesh.face(face);
    double height = 0;
    glm::vec3 middle(0);
    for (const std::uint32_t v : corners) {
      height += heights[v] / static_cast<double>(corners.size());
      middle += mesh.positions[v] / static_cast<float>(corners.size());
    }
    const auto across = figures::across_face<glm::vec3>(mesh.positions, corners);
    const double area = 0.5 * static_cast<double>(glm::length(across));
    SurfacePoint point;
    point.position = point.local = middle;
    const bool rusty = look.material(symbol, point).metal < 0.35F;  // half of clean iron's
    iron_area += area;
    (rusty ? rusty_height : clean_height) += area * height;
    rusty_area += rusty ? area : 0;
  }
  recorder.add("rusty_share", "", rusty_area / iron_area);
  recorder.add("rusty_height", "m", rusty_height / rusty_area);
  recorder.add("clean_height", "m", clean_height / (iron_area - rusty_area));
}

// Leaves: their area per area of ground under the model's box, and the share of green pixels in both
// pictures.
void record_leaves(const growing::Model& model, const ModelMesh& mesh, const ModelMesh& without,
                   std::span<const figures::Panel> panels, Recorder& recorder) {
  const Amount leaves = amount_of(mesh, model.system, "green");
  const glm::vec3 size = bounds_of(mesh.mesh).size();
  recorder.add("bare_triangles", "", static_cast<double>(without.mesh.triangles()));
  recorder.add("leaf_triangles", "", leaves.triangles);
  recorder.add("triangles_more", "",
               static_cast<double>(mesh.mesh.triangles()) - static_cast<double>(without.mesh.triangles()));
  // Both sides of a leaf are faces.
  recorder.add("leaf_area_index", "", 0.5 * leaves.area / static_cast<double>(size.x * size.z));
  for (std::size_t k = 0; k < 2; ++k) {
    const Image& image = panels[k].image;
    double green = 0;
    for (std::size_t p = 0; p < image.rgb.size(); p += 3) {
      green += 4 * image.rgb[p + 1] > 5 * std::max(image.rgb[p], image.rgb[p + 2]) ? 1 : 0;
    }
    recorder.add(k == 0 ? "green_pixels" : "green_pixels_bare", "", green);
  }
}

void measure(const Case& test_case, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const ModelFigure& figure = kFigures[test_case.parameters.choice("figure")];
  const growing::Model model =
      growing::parse_model(growing::model_text(figure.model), std::string(figure.model));
  const FaceMesh faces = growing::expand(model).mesh;
  const ModelMesh mesh = triangles_of(faces);
  const Bounds box = bounds_of(mesh.mesh);
  const int height = test_case.integer("height");
  const View view = close_view(
      in_picture(mesh.mesh, figure.ground.has_value()),
      overview(box, static_cast<int>(figure.aspect * static_cast<float>(height)), height, figure.from));
  const Picture picture(figure, view, box,
                        {.samples = test_case.integer("samples"),
                         .bounces = test_case.integer("bounces"),
                         .seed = static_cast<std::uint32_t>(options.seed)},
                        progress);

  std::vector<figures::Panel> panels{picture.in_daylight(mesh, model.system, "")};
  if (figure.beside == Beside::kWires) {
    panels.push_back(picture.in_wires(triangles_of(growing::expand(model, {.most_steps = 1}).mesh)));
  } else {
    const ModelMesh without = triangles_of(growing::expand(model, {.leave_out = {"leaves"}}).mesh);
    panels.push_back(picture.in_daylight(without, model.system, "without leaves: "));
    record_leaves(model, mesh, without, panels, recorder);
  }
  if (figure.name == "F11") record_folds(model, faces, recorder);
  if (figure.name == "F12") record_spikes(model, mesh, recorder);
  if (figure.name == "F13") recorder.add("ridges", "", ridges_along_u(model, faces));
  if (figure.name == "F16") record_rust(model, faces, painted(figure.model), recorder);
  recorder.add("triangles", "", static_cast<double>(mesh.mesh.triangles()));
  figures::Sheet sheet = figures::panel_sheet({std::move(panels)});
  sheet.write(
      recorder.figure(fmt::format("meshgrow.{}", figure.name),
                      fmt::format("Figure {} of the paper: {}", figure.name.substr(1), figure.caption)));
}

}  // namespace

extern const Experiment kModelFigures{
    "meshgrow.model-figures", "§7: the models, ray traced (figures 11 to 16)", kSpecs, cases, measure};

}  // namespace terrabench::meshgrow
