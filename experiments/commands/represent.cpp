#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <cmath>

#include "experiments/commands/commands.h"
#include "experiments/fidelity.h"
#include "experiments/named_model.h"
#include "experiments/stopwatch.h"
#include "renderers/raytrace/ray_scene.h"
#include "renderers/raytrace/raytraced_picture.h"
#include "renderers/scene.h"
#include "representations/edit_tools.h"
#include "representations/export/export.h"
#include "representations/layered_stack/thermal_erosion.h"
#include "representations/procedural_mesh/model_terrain.h"
#include "representations/representation.h"
#include "results/store/format.h"
#include "terrain/hydrology/channels.h"
#include "terrain/hydrology/flow.h"
#include "terrain/hydrology/steepest.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

// Crops and resamples a file while reading it, so that only the result must fit into memory.
TerrainSource open_file(const RepresentArguments& a, const std::string& name, Progress& progress) {
  DemOptions options;
  if (!a.crop.empty()) options.window = {a.crop[0], a.crop[1], a.crop[2], a.crop[3]};
  if (!a.resample.empty()) {
    options.width = a.resample[0];
    options.depth = a.resample[1];
  }
  options.fill_no_data = a.fill;
  Dem dem = read_dem(name, options, &progress);
  TerrainSource source;
  source.name = name;
  source.checksum = checksum(dem.heights);
  source.notes = std::move(dem.notes);
  source.heights = std::move(dem.heights);
  return source;
}

bool shaped(const RepresentArguments& a) { return !a.crop.empty() || !a.resample.empty() || a.fill; }

Error solid_is_not_shaped() {
  return usage_error("this terrain is a solid, not a height field", "--crop, --resample, --fill",
                     "leave them out, or set the representation's resolution");
}

TerrainSource open_named(const RepresentArguments& a, const std::string& name) {
  TerrainSource source = open_terrain(name, a.seed);
  if (!shaped(a)) return source;
  if (!source.heights) throw solid_is_not_shaped();
  if (!a.crop.empty()) source.heights = crop(*source.heights, a.crop[0], a.crop[1], a.crop[2], a.crop[3]);
  if (!a.resample.empty()) source.heights = resample(*source.heights, a.resample[0], a.resample[1]);
  if (a.fill) source.heights = fill_no_data(*source.heights);
  source.checksum = checksum(*source.heights);
  return source;
}

TerrainSource open_ground(const RepresentArguments& a, const std::string& name, Progress& progress) {
  return names_dem_file(name) ? open_file(a, name, progress) : open_named(a, name);
}

// Numbers between commas, without anything else: whether there were `least` to all.size(). What is left out
// stays.
bool parse_numbers(const std::string& text, std::span<float> all, std::size_t least) {
  const char* at = text.data();
  const char* const end = at + text.size();
  std::size_t count = 0;
  while (count < all.size()) {
    const auto [rest, error] = std::from_chars(at, end, all[count]);
    if (error != std::errc() || !std::isfinite(all[count])) return false;
    at = rest;
    ++count;
    if (at == end || *at != ',') break;
    ++at;
  }
  return at == end && *(end - 1) != ',' && count >= least;
}

std::optional<ModelPlace> parse_place(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::array<float, 3> numbers{0, 0, 1};
  if (!parse_numbers(text, numbers, 2) || !(numbers[2] > 0)) {
    throw usage_error(
        fmt::format("invalid place '{}'", text), "--place",
        "give X,Z or X,Z,SCALE without spaces, such as 120,80,2.5: metres, and a scale above 0");
  }
  return ModelPlace{numbers[0], numbers[1], numbers[2]};
}

// A terrain, a model, or a model on a terrain.
TerrainSource open_source(const RepresentArguments& a, Progress& progress) {
  const bool model = names_model(a.terrain);
  const std::optional<ModelPlace> place = parse_place(a.place);
  if (a.ground.empty() && place) {
    throw usage_error("a place on no ground", "--place", "name the ground with --ground");
  }
  if (!a.ground.empty() && !model) {
    throw usage_error(fmt::format("'{}' is a terrain itself", a.terrain), "--ground",
                      "leave it out, or name a model of `terrabench list models`");
  }
  if (!model) return open_ground(a, a.terrain, progress);
  const std::string text = open_model_text(a.terrain);
  if (!a.ground.empty()) {
    return model_on_ground(text, a.terrain, open_ground(a, a.ground, progress), place);
  }
  if (shaped(a)) throw solid_is_not_shaped();
  return model_source(text, a.terrain);
}

void print_fidelity(const Fidelity& fidelity) {
  if (!fidelity.compared) {
    if (fidelity.from_heights) {
      fmt::print("error       not defined: no column has ground in both; {} have it in only one\n",
                 fidelity.lost);
    } else {
      fmt::print("agreement   not defined: none of {} samples is solid in either\n", fidelity.samples);
    }
    return;
  }
  if (!fidelity.from_heights) {
    fmt::print("agreement   {:.6f} volume IoU over {} samples\n", fidelity.volume_iou, fidelity.samples);
    return;
  }
  fmt::print("error       {:.4g} m RMSE, {:.4g} m largest, over {} columns", fidelity.rmse,
             fidelity.largest_error, fidelity.columns);
  if (fidelity.lost > 0) fmt::print("; {} columns gained or lost", fidelity.lost);
  fmt::print("\n");
}

void draw(const RepresentArguments& a, const Representation& built, Bounds bounds, Progress& progress) {
  const TriangleMesh mesh = built.mesh({});
  if (mesh.triangles() == 0) {
    throw usage_error("nothing of the terrain is left to draw", "--render",
                      "leave it out, or dig less (--dig, --set)");
  }
  const View view = overview(bounds_of(mesh), a.view_width, a.view_height);
  if (a.renderer == kRaytrace) {
    const RayScene scene = relief_scene(mesh, bounds.low.y, bounds.high.y);
    const Stopwatch watch;
    write_picture(a.render, raytrace(scene, view, {.samples = a.samples}, &progress));
    fmt::print("rendered    {} ({} triangles, Embree {}, {} samples per pixel in {:.3g} s)\n", a.render,
               mesh.triangles(), RayIndex::embree_version(), a.samples, watch.seconds());
    return;
  }
  const auto context = open_context(a.renderer, view.width, view.height);
  write_picture(a.render,
                render_relief(*context, mesh, view, {.lowest = bounds.low.y, .highest = bounds.high.y}));
  fmt::print("rendered    {} ({} triangles, {})\n", a.render, mesh.triangles(), context->renderer());
}

// Rasters for other programs: how many pixels drain through each pixel, and in which direction.
void write_flow(const RepresentArguments& a, const TerrainSource& source, Progress& progress) {
  const std::filesystem::path path = a.write_flow;
  const FlowNetwork network =
      a.flow == kFlows[0] ? route_flow(*source.heights, &progress) : route_steepest(*source.heights);
  std::filesystem::path directions = path;
  directions.replace_filename(path.stem().string() + "-direction" + path.extension().string());
  write_geotiff(path, accumulation_raster(network, *source.heights), "");
  write_geotiff(directions, direction_raster(network, *source.heights), "");
  fmt::print("flow        {}, directions {}\n", path.string(), directions.string());
}

Sphere parse_sphere(const RepresentArguments::Stroke& stroke) {
  std::array<float, 4> numbers{};
  if (!parse_numbers(stroke.sphere, numbers, numbers.size()) || !(numbers[3] > 0)) {
    throw usage_error(fmt::format("invalid sphere '{}'", stroke.sphere), stroke.dig ? "--dig" : "--add",
                      "give X,Y,Z,RADIUS in metres without spaces, such as 120,35.5,80,12: finite numbers "
                      "and a radius above 0");
  }
  return {{numbers[0], numbers[1], numbers[2]}, numbers[3]};
}

// Before work that may take minutes.
std::vector<Sphere> check_edits(const RepresentArguments& a, const RepresentationType& type) {
  std::vector<Sphere> spheres;
  for (const auto& stroke : a.strokes) spheres.push_back(parse_sphere(stroke));
  if (!spheres.empty() && !type.traits.editable) {
    throw usage_error(fmt::format("'{}' cannot be edited", type.name), a.strokes[0].dig ? "--dig" : "--add",
                      "`terrabench list representations` names those that can");
  }
  if (a.erode && !type.traits.erodes) {
    std::vector<std::string_view> able;
    for (const RepresentationType& one : representations()) {
      if (one.traits.erodes) able.push_back(one.name);
    }
    throw usage_error(fmt::format("'{}' cannot be eroded", type.name), "--erode",
                      fmt::format("choose --as {}", fmt::join(able, " or ")));
  }
  if (a.erode && !(*a.erode >= 0 && *a.erode < 90)) {
    throw usage_error(fmt::format("a talus angle of {} degrees", *a.erode), "--erode",
                      "choose an angle from 0 to below 90; sand rests at about 35");
  }
  return spheres;
}

void edit(const RepresentArguments& a, std::span<const Sphere> spheres, Representation& built,
          Progress& progress) {
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    const bool dig = a.strokes[s].dig;
    const std::size_t columns = fill_sphere(built, spheres[s], dig ? Material::kAir : Material::kBedrock);
    fmt::print("{}       {}: {} columns{}\n", dig ? "dug  " : "added", a.strokes[s].sphere, columns,
               columns == 0 ? "; the sphere lies between all columns: make it larger" : "");
  }
  if (!a.erode) return;
  const ThermalErosion erosion = built.erode_to(*a.erode, progress);
  progress.end();
  fmt::print("eroded      to {} degrees in {} steps, {} columns changed{}\n", *a.erode, erosion.steps,
             erosion.columns, erosion.settled ? "" : "; material would still move");
}

}  // namespace

ExitCode represent_command(const RepresentArguments& a) {
  const RepresentationType& type = representation(a.as);
  Parameters parameters(type.parameters);
  for (const std::string& assignment : split_assignments(a.assignments, type.parameters)) {
    parameters.set_from_text(assignment);
  }
  const std::vector<Sphere> spheres = check_edits(a, type);
  if (!a.save.empty()) export_format(a.save, type);  // before work that may take minutes
  Progress progress(isatty(STDERR_FILENO) != 0 ? Progress::Output::kTerminal : Progress::Output::kLines);

  const TerrainSource source = open_source(a, progress);
  if (!a.write_flow.empty() && !source.heights) {  // checked before work that may take minutes
    throw usage_error("this terrain is a solid; flow needs a height field", "--write-flow",
                      "leave it out, or name a height field");
  }
  const Stopwatch watch;
  auto built = type.build(source, parameters, progress);
  const double seconds = watch.seconds();
  const Fidelity fidelity = measure_fidelity(*built, source, progress);
  progress.end();

  fmt::print("terrain     {}, checksum {}\n", source.name, source.checksum);
  for (const std::string& note : source.notes) fmt::print("note        {}\n", note);
  fmt::print("built as    {} in {:.3g} s\n", type.name, seconds);
  print_fidelity(fidelity);
  edit(a, spheres, *built, progress);
  const Memory memory = built->memory();
  fmt::print("memory      {} (payload {}, index {}, slack {})\n",
             format_quantity(static_cast<double>(memory.total()), "B"), memory.payload, memory.index,
             memory.slack);
  for (const auto& [name, what] : built->facts()) fmt::print("{:<11} {}\n", name, what);
  if (!a.save.empty()) {
    print_export(a.save, type, *built, source.heights ? lines_of(*source.heights) : own_lines(*built),
                 progress);
  }
  if (!a.write_flow.empty()) write_flow(a, source, progress);
  if (!a.render.empty()) draw(a, *built, source.bounds(), progress);
  fmt::print("allocator   {} freed\n",
             format_quantity(static_cast<double>(destroy_and_count(std::move(built))), "B"));
  return ExitCode::kGood;
}

}  // namespace terrabench
