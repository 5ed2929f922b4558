// Where each type of representation errs: one map per type of the signed error of height, in files of at most
// the same bytes, one figure per ground.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "experiments/cross/files/file_search.h"
#include "experiments/experiment.h"
#include "experiments/figures/maps.h"

namespace terrabench::cross {
namespace {

const std::array kSpecs{
    ParameterSpec{"share", 0.05, "", "of the ground's own bytes, for the file of each type", 1e-4, 1},
    ParameterSpec{"builds", std::int64_t{120}, "", "of each type, to search its settings", 1, 100000},
    ParameterSpec{"size", std::int64_t{257}, "samples", "side of the fractal ground, 2^n + 1", 3, 8193},
    ParameterSpec{"resolution", std::int64_t{64}, "columns", "along solid ground", 2, 4096},
    ParameterSpec{"lines", std::int64_t{400}, "", "along the ground: pixels of a map", 2, 4001},
    ParameterSpec{"compared", std::int64_t{101}, "", "lines along solid ground on which errors are measured",
                  2, 4001},
};

constexpr int kAcross = 3;                // maps in a row
constexpr double kTitle = 42, kGap = 14;  // units of the sheet
constexpr double kWidth = 285;            // of a map
constexpr double kLegend = 46;
constexpr Rgb kMissing{120, 120, 128};  // where only one of ground and type has a surface

std::vector<Case> cases(const RunOptions& options) {
  const bool paper = options.profile == Profile::kPaper;
  std::vector<Case> cases;
  for (const std::string& terrain : compared_scenes(options)) {
    cases.push_back({terrain,
                     {kSpecs,
                      {{"size", std::int64_t{paper ? 513 : 257}},
                       {"builds", std::int64_t{paper ? 120 : 24}},
                       {"resolution", std::int64_t{paper ? 128 : 64}},
                       {"lines", std::int64_t{paper ? 400 : 200}},
                       {"compared", std::int64_t{paper ? 211 : 101}}}},
                     terrain});
  }
  return cases;
}

struct Map {
  const RepresentationType* type = nullptr;
  bool fits = false;
  std::size_t file_bytes = 0;
  std::size_t columns = 0, lost_columns = 0;  // where both have a surface; where only one of the two has
  double rmse = 0;                            // as the tables have it; not of the map's pixels
  Heightfield error;  // metres; infinite where only one of the two has a surface, no data where neither
};

// The tops of the lines as a height field, no data where a line is empty.
Heightfield tops(const LineParts& parts, const GroundLines& at) {
  Heightfield field = Heightfield::zeros(at.width, at.depth, at.step, at.step);
  for (std::size_t c = 0; c < parts.lines(); ++c) {
    field.heights[c] = parts.line(c).empty() ? Heightfield::kNoData : parts.line(c).back().top;
  }
  return field;
}

Map map_of(const Scene& scene, const RepresentationType& type, const Heightfield& ground,
           const GroundLines& compared, double most_bytes, int builds, Progress& progress) {
  Map map;
  map.type = &type;
  // The limit of bytes, and about the error of such files, from which the search starts.
  const double error = scene.source.heights ? 0.03 * relief_of(scene) : 0.03;
  const FileAim bytes{FileAim::kBytes, &BuiltFile::rmse, most_bytes},
      errors{FileAim::kError, scene.source.heights ? &BuiltFile::largest : &BuiltFile::volume_error, error};
  const std::vector<BuiltFile> files =
      search_files(scene, type, builds, std::array{bytes, bytes, errors}, progress);
  const BuiltFile* chosen = closest_within(files, &BuiltFile::rmse, most_bytes);
  map.fits = chosen != nullptr;
  const auto built =
      chosen != nullptr
          ? through_file(scene, type, chosen->parameters, chosen->within, map.file_bytes, progress)
          : through_file(scene, type, scene.parameters(type), 0, map.file_bytes, progress);
  map.error = tops(lines_of(*built, scene.lines), scene.lines);
  map.rmse = top_and_volume_differences(*built, scene.source, compared).rmse;
  for (std::size_t c = 0; c < ground.heights.size(); ++c) {
    float& error = map.error.heights[c];
    const bool has = !Heightfield::is_no_data(error), expected = !Heightfield::is_no_data(ground.heights[c]);
    if (has != expected) {
      error = HUGE_VALF;
      ++map.lost_columns;
    } else if (has) {
      error -= ground.heights[c];
      ++map.columns;
    }
  }
  return map;
}

// The metres at the ends of the colours: twice the middle one of the maps' RMSE, as 1, 2 or 5 times a power
// of ten.
double end_of_colours(const std::vector<Map>& maps) {
  std::vector<double> rmse;
  for (const Map& map : maps) {
    if (map.columns > 0) rmse.push_back(map.rmse);
  }
  std::sort(rmse.begin(), rmse.end());
  const double wish = std::max(rmse.empty() ? 0 : 2 * rmse[rmse.size() / 2], 1e-3),
               power = std::pow(10, std::floor(std::log10(wish)));
  return power * (wish >= 5 * power ? 10 : wish >= 2 * power ? 5 : 2);
}

std::string kilobytes(double bytes) { return fmt::format("{:.{}f} kB", bytes / 1000, bytes < 1000 ? 2 : 1); }

std::string numbers(const Map& map) {
  const std::string bytes = kilobytes(static_cast<double>(map.file_bytes)) + (map.fits ? "" : "*");
  if (map.columns == 0) return bytes + ", no common ground";
  return fmt::format("{}, RMSE {:.{}f} m", bytes, map.rmse, map.rmse < 10 ? 2 : 1);
}

struct Marks {
  bool missing = false, larger = false;  // which of them the maps have
};

void add_legend(figures::Sheet& sheet, double y, double most, const Marks& marks) {
  figures::add_colour_key(sheet, kGap, y, "type minus ground, m", 170, 300, figures::difference_colour,
                          {fmt::format("−{:g} or less", most), fmt::format("−{:g}", most / 2), "0",
                           fmt::format("{:g}", most / 2), fmt::format("{:g} or more", most)});
  const double x = kGap + 540;
  if (marks.missing) {
    sheet.box(x, y, 22, 12, kMissing);
    sheet.text(x + 28, y + 11, "only the ground or only the type is here", 12);
  }
  if (marks.larger) sheet.text(x, y + 29, "* no smaller file", 12);
}

figures::Sheet draw(const std::vector<Map>& maps, const Heightfield& ground) {
  const double height = kWidth * ground.depth / ground.width;
  const int rows = (static_cast<int>(maps.size()) + kAcross - 1) / kAcross;
  const figures::PanelGrid grid{.columns = kAcross,
                                .rows = rows,
                                .width = kWidth,
                                .height = height,
                                .gap = kGap,
                                .below = 8,
                                .title = kTitle};
  figures::Sheet sheet(grid.sheet_width(), grid.bottom() + kLegend);
  const double most = end_of_colours(maps);
  const figures::Light light(ground);
  Marks marks;
  for (int k = 0; k < static_cast<int>(maps.size()); ++k) {
    const Map& map = maps[static_cast<std::size_t>(k)];
    marks.larger |= !map.fits;
    const Image image = figures::shaded_map(
        map.error, light,
        [&](float metres) {
          marks.missing |= std::isinf(metres);
          return std::isinf(metres) ? kMissing : figures::difference_colour(0.5 + 0.5 * metres / most);
        },
        0.45, 0.4);
    grid.place(sheet, k, numbers(map), image);
    sheet.text(grid.x(k), grid.y(k) - 24, fmt::format("({:c}) {}", 'a' + k, map.type->label), 13);
  }
  add_legend(sheet, grid.bottom() + 6, most, marks);
  return sheet;
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const Scene& ground =
      scene({at.terrain, at.integer("size"), at.integer("resolution"), at.integer("lines"), options.seed},
            progress);
  recorder.terrain(ground.source);
  const Heightfield surface = tops(ground.lines.parts, ground.lines);
  const GroundLines compared = ground_lines(ground.source, at.integer("compared"));
  const double most_bytes = at.parameters.number("share") * own_bytes(ground);
  std::vector<Map> maps;
  for (const RepresentationType& type : representations()) {
    const Map& map = maps.emplace_back(
        map_of(ground, type, surface, compared, most_bytes, at.integer("builds"), progress));
    const std::string name(type.name);
    recorder.add(name + "_file", "kB", static_cast<double>(map.file_bytes) / 1000);
    if (map.columns > 0) recorder.add(name + "_rmse", "m", map.rmse);
  }
  // Of the type that loses most.
  const Map& worst = *std::ranges::max_element(maps, {}, &Map::lost_columns);
  recorder.add("columns", "", static_cast<double>(worst.columns));
  recorder.add("lost_columns", "", static_cast<double>(worst.lost_columns));
  const double width = static_cast<double>(surface.width) * surface.cell_x;
  const bool far = width >= 1000;
  draw(maps, surface)
      .write(recorder.figure(
          "cross.error-maps" + figures::ground_suffix(at.terrain, "jacksboro"),
          fmt::format(
              "Signed error of height of each type on {}, {:.3g} {} across, over its shaded relief: "
              "blue too low, red too high, one scale for all. Of the files that {} builds of each type "
              "make, the one of least RMSE with at most {:.0f} % of the ground's own bytes, {}; a type "
              "without so small a file is marked * and shown at the ground's own resolution. Stacks and "
              "voxels have the same files.",
              at.terrain, far ? width / 1000 : width, far ? "km" : "m", at.integer("builds"),
              100 * at.parameters.number("share"), kilobytes(most_bytes))));
}

}  // namespace

extern const Experiment kErrorMaps{"cross.error-maps",
                                   "Where representations err, in files of at most the same bytes", kSpecs,
                                   cases, measure};

}  // namespace terrabench::cross
