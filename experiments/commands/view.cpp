// `terrabench view`: what the viewer shows, opened as `render` opens it.
#include "viewer/view.h"

#include <fmt/format.h>

#include "experiments/commands/commands.h"
#include "experiments/near_ground.h"
#include "representations/representation.h"
#include "results/store/provenance.h"
#include "terrain/framing.h"
#include "viewer/method.h"

namespace terrabench {
namespace {

// The highest surface that a structure holds over each sample; the floor where it holds nothing. O(samples)
Heightfield surface_of(const Representation& structure, Heightfield like, float floor, Progress& progress) {
  std::vector<float> x, z(static_cast<std::size_t>(like.width));
  for (int i = 0; i < like.width; ++i) x.push_back(static_cast<float>(i) * like.cell_x);
  progress.begin("sampling the representation", static_cast<std::uint64_t>(like.depth));
  SpanSink spans;
  for (int j = 0; j < like.depth; ++j) {
    std::fill(z.begin(), z.end(), static_cast<float>(j) * like.cell_z);
    spans.clear();
    structure.spans({x, z}, spans);
    for (int i = 0; i < like.width; ++i) {
      const auto column = spans.column(static_cast<std::size_t>(i));
      like.at(i, j) = column.empty() ? floor : column.back().top;
    }
    progress.advance();
  }
  progress.end();
  return like;
}

std::string render_of(const ViewArguments& a, const std::string& ground, bool solid) {
  const ViewArguments usual;
  std::vector<std::string> words{"terrabench", "render", ground};
  if (solid && a.samples != usual.samples)
    words.insert(words.end(), {"--samples", std::to_string(a.samples)});
  if (a.seed != usual.seed) words.insert(words.end(), {"--seed", std::to_string(a.seed)});
  return quote_command(words);
}

std::shared_ptr<viewer::Ground> open_ground(const ViewArguments& a, const std::string& name,
                                            bool near_surface, Progress& progress) {
  const TerrainSource source = open_terrain(name, a.seed);
  NearGround opened = ground_for(source, near_surface, a.samples, progress);
  auto ground = std::make_shared<viewer::Ground>();
  ground->name = name;
  ground->notes = source.notes;
  ground->solid = source.solid.has_value();
  ground->heights = std::move(opened.heights);
  ground->surface = std::move(opened.surface);
  if (!a.as.empty()) {
    const RepresentationType& as = representation(a.as);
    const auto structure = as.build(source, Parameters(as.parameters), progress);
    ground->heights = surface_of(*structure, std::move(ground->heights), source.bounds().low.y, progress);
    ground->as = a.as;
  } else {
    ground->render = render_of(a, name, ground->solid);
  }
  ground->bounds = bounds_of(ground->heights);
  return ground;
}

}  // namespace

ExitCode view_command(const ViewArguments& a) {
  viewer::ViewOptions options;
  options.ground = a.terrain;
  options.methods = a.lods.empty() ? std::vector<std::string>{"roam"} : a.lods;
  options.window = parse_size(a.size);
  options.script = a.script;
  options.panels = a.panels;
  // Before a window is opened.
  terrain_file(a.terrain);
  for (const std::string& name : options.methods) viewer::method_named(name);
  if (!a.as.empty()) representation(a.as);
  return viewer::view(options, [&](const std::string& name, bool near_surface, Progress& progress) {
    return open_ground(a, name, near_surface, progress);
  });
}

}  // namespace terrabench
