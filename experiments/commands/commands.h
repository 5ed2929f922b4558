// The subcommands of the command line. Each prints to standard output, throws Error for what the user can
// correct, and returns the exit code.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/runner.h"
#include "representations/line_grid.h"
#include "results/compare/compare_pictures.h"
#include "terrain/error.h"

namespace CLI {
class App;
}

namespace terrabench {

struct ListArguments {
  // representations, lods, experiments, claims, terrains, models, scene; a paper's id: its experiments and
  // claims; empty: all
  std::string what;
  bool json = false;
};
ExitCode list_command(const ListArguments&);

struct RunArguments {
  RunPlan plan;
  std::string profile = "quick", shard = "1/1", part = "all";  // of the plan, as given
  bool dry_run = false;
};
ExitCode run_command(RunArguments);

// The renderer that traces rays instead of opening an OpenGL context.
inline constexpr std::string_view kRaytrace = "raytrace";

// Rules of --flow: the paper's search from the border, and steepest descent.
inline constexpr std::array<std::string_view, 2> kFlows = {"lowest", "steepest"};

struct RepresentArguments {
  std::string terrain, as;
  std::string ground, place;  // where a model stands, "X,Z" or "X,Z,SCALE"; empty: nowhere, and the middle
  std::vector<std::string> assignments;
  std::string save, render;     // files to write; empty: none
  std::string write_flow;       // likewise: flow accumulation; directions go into a second file beside it
  std::string flow = "lowest";  // where each sample drains: kFlows
  std::vector<int> crop;        // i, j, width, depth
  std::vector<int> resample;    // width, depth
  bool fill = false;            // fill no-data holes
  struct Stroke {
    bool dig;            // otherwise adds bedrock
    std::string sphere;  // "X,Y,Z,RADIUS", metres
  };
  std::vector<Stroke> strokes;  // edits of what was built, in order
  std::optional<double> erode;  // then thermal erosion to this talus angle, degrees
  int view_width = 1600, view_height = 1000;
  std::string renderer = "osmesa";  // or kRaytrace
  int samples = 64;                 // per pixel, of ray tracing
  std::uint64_t seed = 1;
};
ExitCode represent_command(const RepresentArguments&);

struct ExportArguments {
  std::filesystem::path saved, out;  // a saved representation, and the file to write of it
  std::string like;                  // path of the DEM that it was built from; empty: none
  bool surface_only = false;         // polygons without underside and sides
  std::string up = "y";              // of polygons: y or z
};
ExitCode export_command(const ExportArguments&);

struct RenderArguments {
  std::string terrain;
  bool scene = false;  // a landscape; otherwise the method's triangles as shaded relief
  std::string path;    // camera path: a name or a TOML file; empty: one view
  int frames = 1;      // pictures, evenly spaced along the path
  std::string lod = "clipmap";
  std::vector<double> detail;               // the method's knob; empty: its usual setting
  std::string size;                         // "1600x1000"; empty: the path's, or 1600x1000
  std::vector<float> eye, look_at;          // three metres each; empty: chosen
  std::vector<float> up;                    // direction of the picture's top; empty: upright()
  float field_of_view = 0;                  // degrees, vertical; 0: chosen
  double seconds = 0;                       // time of clouds and waves in the first picture
  int samples = 513;                        // along the sides of a solid's height field
  std::vector<std::string> assignments;     // of the landscape and of the method
  std::filesystem::path out = "scene.png";  // a file, or a folder for several frames
  std::string renderer = "osmesa";
  std::uint64_t seed = 1;
};
ExitCode render_command(const RenderArguments&);

struct ViewArguments {
  std::string terrain = "jacksboro";
  std::vector<std::string> lods;  // one or two; empty: roam
  std::string as;                 // representation; empty: the terrain itself
  std::string size = "1280x800";  // of the window
  int samples = 513;              // along the sides of a solid's height field
  std::filesystem::path script;   // empty: none
  bool panels = true;
  std::uint64_t seed = 1;
};
ExitCode view_command(const ViewArguments&);

// The samples along a side of the largest ground that `advise` measures whole.
inline constexpr int kAdvisedSide = 257;

struct AdviseArguments {
  std::string terrain, purpose;             // purpose: one of purposes() (advice.h); empty: all
  std::filesystem::path folder, reference;  // empty: advice-NAME; the reference run's answers
  int side = kAdvisedSide;  // of a larger DEM a part is measured, at most so many samples along its sides
};
// `plan`: with threads and command set.
ExitCode advise_command(const AdviseArguments&, RunPlan plan);

struct CheckArguments {
  std::filesystem::path folder = "out", junit;
  std::vector<std::string> claims;  // ids or globs; empty: those of the experiments that were run
  std::string profile;              // empty: the newest record's
  bool json = false, verbose = false;
  bool all = false;  // also the claims of experiments that were not run
};
ExitCode check_command(const CheckArguments&);

struct CompareArguments {
  std::filesystem::path before, after;
  PictureLimits limits;
  bool json = false, all = false;
};
ExitCode compare_command(const CompareArguments&);

struct MergeArguments {
  std::filesystem::path out;
  std::vector<std::filesystem::path> folders;
};
ExitCode merge_command(const MergeArguments&);

struct ReportArguments {
  std::filesystem::path folder = "out";
  std::filesystem::path latex;      // folder of a LaTeX bundle to write instead of the report; empty: none
  std::filesystem::path reference;  // results folder to compare further grounds with; empty: `folder`
  std::string profile;              // empty: the newest record's
};
// Prints that results cannot be trusted, if they have faults.
void warn_of(const std::vector<std::string>& faults);
ExitCode report_command(const ReportArguments&);

// Prints BibTeX of the papers and of this program.
ExitCode cite_command();

// Writes the file and says what it holds, as export_representation().
void print_export(const std::filesystem::path&, const RepresentationType&, const Representation&,
                  const LineGrid&, Progress&);

// Describes a DEM, a saved structure or a results folder, which it distinguishes by content.
ExitCode info_command(const std::filesystem::path&);

// Add the command with its options, which set the arguments; these must outlive the parser.
void add_run(CLI::App&, RunArguments&, int& threads);
void add_represent(CLI::App&, RepresentArguments&, int& threads);
void add_export(CLI::App&, ExportArguments&);
void add_info(CLI::App&, std::filesystem::path& file);
void add_render(CLI::App&, RenderArguments&, int& threads);
void add_view(CLI::App&, ViewArguments&, int& threads);
void add_advise(CLI::App&, AdviseArguments&, int& threads);
// "1600x1000". Throws usage_error.
glm::ivec2 parse_size(const std::string&);
// `raytrace`: whether the command also takes the renderer that traces rays.
void add_renderer(CLI::App& command, std::string& renderer, bool raytrace = false);

}  // namespace terrabench
