// The options of the commands that build or draw one terrain.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "experiments/commands/commands.h"
#include "renderers/context.h"
#include "results/report/advice.h"
#include "terrain/error.h"
#include "terrain/number.h"

namespace terrabench {

void add_renderer(CLI::App& command, std::string& renderer, bool raytrace) {
  std::vector<std::string_view> names(context_names().begin(), context_names().end());
  std::string help =
      "OpenGL context: osmesa (software), egl (the first GPU, otherwise software), glfw (a hidden "
      "window on an X display), auto (egl if there is a GPU, otherwise osmesa)";
  if (raytrace) {
    names.push_back(kRaytrace);
    help += "; or raytrace (Embree: sun, sky and soft shadows, no OpenGL)";
  }
  command.add_option("--renderer", renderer, help)
      ->check(CLI::Validator(
          [names](const std::string& value) {
            const bool known = std::find(names.begin(), names.end(), value) != names.end();
            return known ? std::string() : std::string(unknown_name("renderer", value, names).what());
          },
          fmt::format("{{{}}}", fmt::join(names, ","))))
      ->capture_default_str();
}

glm::ivec2 parse_size(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%9dx%9d%c", &width, &height, &rest) != 2 || width < 1 || height < 1 ||
      std::max(width, height) > kLargestPictureSide) {
    throw usage_error(fmt::format("invalid size '{}': expected WIDTHxHEIGHT, such as 1600x1000", text),
                      "--size", fmt::format("give both sides in pixels, each 1 to {}", kLargestPictureSide));
  }
  return {width, height};
}

void add_represent(CLI::App& app, RepresentArguments& a, int& threads) {
  auto* command = app.add_subcommand("represent",
                                     "Build one representation; print its bytes and error, save it, draw it");
  command
      ->add_option("terrain", a.terrain,
                   "A name from `terrabench list terrains` or `list models`, the path of a DEM, an event "
                   "file or a model, "
                   "dem:FILE,OPTION=VALUE (docs/grounds.md) or drawing:FILE.png")
      ->required();
  command->add_option(
      "--ground", a.ground,
      "Let a model stand on this terrain, a height field; --crop, --resample and --fill are for it");
  command
      ->add_option("--place", a.place,
                   "Where on the ground a model stands, and how many times its size (default: the middle, 1)")
      ->type_name("X,Z[,SCALE]");
  command->add_option("--as", a.as, "A name from `terrabench list representations`")->required();
  command->add_option("--set", a.assignments,
                      "Parameters of the representation, name=value or name=value,name=value");
  // Short forms of --set for parameters of drill.
  const auto budget = [&](const char* option, const char* parameter, const char* help) {
    command
        ->add_option_function<double>(
            option,
            [&a, parameter](double value) {
              a.assignments.push_back(fmt::format("{}={}", parameter, value));
            },
            help)
        ->check(CLI::Validator(
            [](const std::string& value) {
              const bool above = parse_number<double>(value).value_or(0) > 0;
              return above ? std::string() : fmt::format("must be a number above 0, got '{}'", value);
            },
            ""));
  };
  budget("--budget-bytes", "budget_bytes",
         "For drill: choose the parameters so that it takes at most this many bytes");
  budget("--max-rmse", "max_rmse",
         "For drill: choose the parameters so that the RMSE is at most this many metres");
  command->add_option("--save", a.save,
                      "Write the representation to this file: .tb its own form, .tif heights, .ply or .obj "
                      "polygons, .csv spans, .vdb a volume");
  command->add_option("--render", a.render, "Write a shaded or ray-traced relief to this PNG");
  command->add_option("--write-flow", a.write_flow,
                      "Write flow accumulation to this GeoTIFF, and directions beside it");
  command
      ->add_option(
          "--flow", a.flow,
          "Where a sample drains, for --write-flow: lowest, as the drill paper says, to the neighbour that "
          "a search from the border reaches first, lowest first, so that nothing stays in pits; steepest, "
          "to the neighbour with the largest fall per metre, so that pits keep their flow (D8)")
      ->check(CLI::IsMember(std::vector<std::string>(kFlows.begin(), kFlows.end())))
      ->capture_default_str();
  command
      ->add_option("--crop", a.crop,
                   "Part to use, in samples from the north-western one: column, row, width, depth")
      ->expected(4);
  command->add_option("--resample", a.resample, "New width and depth in samples")->expected(2);
  command->add_flag("--fill", a.fill, "Fill samples without data from the samples around them");
  // Called at each occurrence, so that --dig and --add keep their common order.
  const auto stroke = [&](const char* option, bool dig, const char* help) {
    command
        ->add_option_function<std::string>(
            option,
            [&a, dig](const std::string& sphere) {
              a.strokes.push_back({dig, sphere});
            },
            help)
        ->type_name("X,Y,Z,RADIUS")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->trigger_on_parse();
  };
  stroke("--dig", true, "Dig a sphere (metres, Y up) out of what was built; may be repeated");
  stroke("--add", false, "Add a sphere of bedrock; may be repeated, in order with --dig");
  command->add_option("--erode", a.erode,
                      "After --dig and --add, let material slide until no slope exceeds this talus angle in "
                      "degrees (layered_stack and implicit)");
  add_renderer(*command, a.renderer, true);
  command
      ->add_option("--samples", a.samples,
                   "For --renderer raytrace: samples per pixel; noise halves with four times as many")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  command->add_option("--threads", threads, "Threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
  command->add_option("--seed", a.seed, "Seed of procedural terrains")->capture_default_str();
}

void add_export(CLI::App& app, ExportArguments& a) {
  auto* command = app.add_subcommand("export", "Write a saved representation for other programs");
  command->add_option("saved", a.saved, "File that `represent --save NAME.tb` has written")->required();
  command
      ->add_option("out", a.out,
                   "File to write: .tif heights, .ply or .obj polygons, .csv spans, .vdb a volume")
      ->required();
  command->add_option("--like", a.like,
                      "The DEM that it was built from: write along its samples, with its reference system");
  command->add_flag("--surface-only", a.surface_only,
                    "For .ply and .obj: without the underside and the sides that close the ground");
  command->add_option("--up", a.up, "For .ply and .obj: the axis that points up; y, or z with y to the north")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
}

void add_info(CLI::App& app, std::filesystem::path& file) {
  auto* command = app.add_subcommand(
      "info",
      "Describe a DEM, a drawing, an event file, a model, a saved representation or a results folder");
  command
      ->add_option("file", file,
                   "File or folder, dem:FILE,OPTION=VALUE (docs/grounds.md) or drawing:FILE.png")
      ->required();
}

void add_advise(CLI::App& app, AdviseArguments& a, int& threads) {
  auto* command =
      app.add_subcommand("advise",
                         "Say which method to take for a ground: measures them on it in a few minutes, "
                         "prints a table with reasons, "
                         "and writes a page with pictures. The same command goes on after an interruption");
  command
      ->add_option(
          "terrain", a.terrain,
          "The path of a DEM, dem:FILE,OPTION=VALUE (docs/grounds.md), drawing:FILE.png or an event file")
      ->required();
  command
      ->add_option("--for", a.purpose,
                   "What the ground is for. Asks only the questions that matter for it (default: all)")
      ->check(CLI::Validator(
          [](const std::string& value) {
            const std::vector<std::string> known = purposes();
            if (std::ranges::find(known, value) != known.end()) return std::string();
            const std::vector<std::string_view> names(known.begin(), known.end());
            return std::string(unknown_name("purpose", value, names).what());
          },
          fmt::format("{{{}}}", fmt::join(purposes(), ","))));
  command->add_option("--out", a.folder, "Results folder (default: advice-NAME, after the file)");
  command->add_option(
      "--reference", a.reference,
      "Compare with the grounds of this results folder (default: with those of the reference run, "
      "which are inside the program)");
  command
      ->add_option(
          "--side", a.side,
          "Measure a larger DEM's middle, so many samples wide and deep, or where that has no heights or "
          "is flat, another part. A part that you name, dem:FILE,crop=WIDTHxDEPTH, is measured whole")
      ->check(CLI::Range(2, 16385))
      ->capture_default_str();
  command->add_option("--threads", threads, "Threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
}

void add_render(CLI::App& app, RenderArguments& r, int& threads) {
  auto* command = app.add_subcommand(
      "render",
      "Draw a terrain through a level-of-detail method: a picture, or a sequence along a camera path");
  command
      ->add_option("terrain", r.terrain,
                   "A name from `terrabench list terrains`, the path of a DEM or an event file, "
                   "dem:FILE,OPTION=VALUE (docs/grounds.md) or drawing:FILE.png")
      ->required();
  command->add_flag(
      "--scene", r.scene,
      "A landscape with materials, sky, fog, water and shadows; otherwise the method's triangles "
      "as shaded relief");
  command->add_option("--path", r.path,
                      "Camera path: fly, low, walk, turn or cross, or a TOML file (default: one view)");
  command->add_option("--frames", r.frames, "Pictures, evenly spaced along the path")->capture_default_str();
  command->add_option("--lod", r.lod, "A name from `terrabench list lods`")->capture_default_str();
  command->add_option("--detail", r.detail, "The method's knob (see `terrabench list lods`)")->expected(1);
  command->add_option("--size", r.size, "Size of the picture in pixels, such as 1600x1000");
  command->add_option("--eye", r.eye, "Place of the eye in metres: x (east), y (up), z (south)")->expected(3);
  command->add_option("--look-at", r.look_at, "Place in the middle of the picture, likewise")->expected(3);
  command
      ->add_option("--up", r.up,
                   "Direction of the picture's top, likewise (default: up; north in a plan, looking straight "
                   "down)")
      ->expected(3);
  command->add_option("--fov", r.field_of_view, "Vertical field of view in degrees")
      ->check(CLI::Range(1.0, 170.0));
  command->add_option("--seconds", r.seconds, "Time of clouds and waves in the first picture")
      ->check(CLI::Range(-1e5, 1e5));
  command->add_option("--samples", r.samples, "Height samples along each side of a solid terrain")
      ->check(CLI::Range(2, 16385))
      ->capture_default_str();
  command->add_option("--set", r.assignments,
                      "Parameters of the landscape or of the method: name=value or name=value,name=value "
                      "(see `terrabench list scene`)");
  command
      ->add_option("--out", r.out,
                   "PNG to write, or a folder for several frames: pictures that it holds are kept")
      ->capture_default_str();
  add_renderer(*command, r.renderer);
  command->add_option("--threads", threads, "Threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
  command->add_option("--seed", r.seed, "Seed of procedural terrains")->capture_default_str();
}

void add_view(CLI::App& app, ViewArguments& v, int& threads) {
  auto* command = app.add_subcommand(
      "view", "Open a window: fly over a terrain, switch methods, compare two, edit, record camera paths");
  command
      ->add_option("terrain", v.terrain,
                   "A name from `terrabench list terrains`, the path of a DEM or an event file, "
                   "dem:FILE,OPTION=VALUE (docs/grounds.md) or drawing:FILE.png")
      ->capture_default_str();
  command
      ->add_option(
          "--lod", v.lods,
          "A level of detail from `terrabench list lods`, or a variant such as geomipmap_morph; given "
          "twice, two side by side (default: roam)")
      ->expected(1, 2);
  command->add_option("--as", v.as,
                      "Show the ground as this representation holds it, a name from `terrabench list "
                      "representations`, built with its defaults (default: the terrain itself)");
  command->add_option("--size", v.size, "Size of the window in pixels")->capture_default_str();
  command->add_option("--samples", v.samples, "Height samples along each side of a solid terrain")
      ->check(CLI::Range(2, 16385))
      ->capture_default_str();
  command->add_option("--script", v.script, "Run the commands in this file, then close (docs/view.md)");
  command->add_flag("!--no-panels", v.panels, "Hide the panels; H shows them");
  command->add_option("--threads", threads, "Threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
  command->add_option("--seed", v.seed, "Seed of procedural terrains")->capture_default_str();
}

}  // namespace terrabench
