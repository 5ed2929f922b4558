#include <fmt/format.h>

#include "experiments/commands/commands.h"
#include "experiments/named_model.h"
#include "representations/procedural_mesh/model_terrain.h"
#include "representations/representation.h"
#include "results/store/format.h"
#include "results/store/store.h"
#include "terrain/events/event_file.h"
#include "terrain/files.h"
#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

void print_bounds(const Bounds& b) {
  fmt::print("bounds      x {:.6g}…{:.6g} m, y {:.6g}…{:.6g} m, z {:.6g}…{:.6g} m\n", b.low.x, b.high.x,
             b.low.y, b.high.y, b.low.z, b.high.z);
}

void print_heights(const Heightfield& field, const std::vector<std::string>& notes) {
  const HeightRange range = height_range(field);
  fmt::print("samples     {} × {}, cells {:.6g} m × {:.6g} m, {:.4g} km × {:.4g} km\n", field.width,
             field.depth, field.cell_x, field.cell_z, field.extent_x() / 1000, field.extent_z() / 1000);
  fmt::print("heights     {:.6g}…{:.6g} m, {} without data\n", range.lowest, range.highest, range.no_data);
  const std::string system = name_of_reference_system(field.georeference.crs);
  fmt::print("system      {}\n", system.empty() ? "not named" : system);
  fmt::print("checksum    {}\n", checksum(field));
  for (const std::string& note : notes) fmt::print("note        {}\n", note);
}

// Of a DEM that is too large to be read whole, its header.
void describe_dem(const std::string& name) {
  const DemHeader header = read_dem_header(name);
  fmt::print("{}: digital elevation model ({}, {})\n", name, header.format, header.type);
  if (header.too_large.empty()) {
    const Dem dem = read_dem(name);
    print_heights(dem.heights, dem.notes);
  } else {
    fmt::print("samples     {} × {}, cells {:.6g} m × {:.6g} m, {:.4g} km × {:.4g} km\n", header.width,
               header.depth, header.cell_x, header.cell_z, (header.width - 1) * header.cell_x / 1000,
               (header.depth - 1) * header.cell_z / 1000);
    for (const std::string& note : header.notes) fmt::print("note        {}\n", note);
    fmt::print(
        "note        its heights were not read: {}; `represent` reads a part of it (--crop) or a reduced "
        "copy (--resample)\n",
        header.too_large);
  }
  if (header.format == "PNG" && !name.starts_with(kDemPrefix)) {
    fmt::print("note        its values are used as heights; {}{} makes a landscape with a sea of it\n",
               kDrawingPrefix, name);
  }
}

void describe_drawing(const std::string& name) {
  const TerrainSource source = open_terrain(name);
  fmt::print("{}: land from a drawing\n", name);
  print_heights(*source.heights, source.notes);
}

void print_facts(const Representation& structure) {
  for (const auto& [name, what] : structure.facts()) fmt::print("{:<11} {}\n", name, what);
}

void describe_representation(const std::filesystem::path& path) {
  const std::string file = read_file(path);
  const Loaded loaded = load_representation(std::as_bytes(std::span(file)), path.string());
  const Memory memory = loaded.representation->memory();
  fmt::print("{}: {} ({})\n", path.string(), loaded.type->name, loaded.type->summary);
  fmt::print("on disk     {}\n", format_quantity(static_cast<double>(file.size()), "B"));
  fmt::print("memory      {} (payload {}, index {}, slack {})\n",
             format_quantity(static_cast<double>(memory.total()), "B"), memory.payload, memory.index,
             memory.slack);
  print_bounds(loaded.representation->bounds());
  print_facts(*loaded.representation);
}

// A script of events, described by the tree that it builds.
void describe_script(const std::filesystem::path& path) {
  const TerrainSource source = events::open_script(read_file(path, events::kMostBytes), path.string());
  const RepresentationType& type = representation("ght");
  Progress progress;
  const auto built = type.build(source, Parameters(type.parameters), progress);
  fmt::print("{}: terrain with {} events\n", path.string(), source.events ? source.events->events.size() : 0);
  for (const std::string& note : source.notes) fmt::print("note        {}\n", note);
  fmt::print("checksum    {}\n", source.checksum);
  print_bounds(built->bounds());
  print_facts(*built);
}

// A model of mesh growing, expanded.
void describe_model(const std::string& path) {
  const TerrainSource source = model_source(open_model_text(path), path);
  fmt::print("{}: model of mesh growing\n", path);
  for (const std::string& note : source.notes) fmt::print("note        {}\n", note);
  fmt::print("checksum    {}\n", source.checksum);
  print_bounds(source.bounds());
}

void describe_results(const std::filesystem::path& folder) {
  const Store store = Store::open(folder);
  fmt::print("{}: results, {} cases, profile {}\n", folder.string(), store.records().size(), store.profile());
  for (const std::string& warning : store.warnings()) fmt::print("warning     {}\n", warning);
  for (const Record& record : store.records()) {
    const std::string what =
        record.outcome == CaseOutcome::kMeasured
            ? fmt::format("{} metrics, {} figures", record.metrics.size(), record.figures.size())
            : fmt::format("{}: {}", name(record.outcome), record.reason);
    fmt::print("  {} {} ({}): {}\n", record.experiment, record.case_name, record.profile, what);
  }
}

}  // namespace

ExitCode info_command(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (path.string().starts_with(kDrawingPrefix)) {
    describe_drawing(path.string());
  } else if (std::filesystem::is_directory(status)) {
    describe_results(path);
  } else if (is_saved_representation(path)) {
    describe_representation(path);
  } else if (path.extension() == events::kExtension && std::filesystem::exists(status)) {
    if (names_model(path.string())) {
      describe_model(path.string());
    } else {
      describe_script(path);
    }
  } else {
    describe_dem(path.string());  // its error names what is wrong with any other path
  }
  return ExitCode::kGood;
}

}  // namespace terrabench
