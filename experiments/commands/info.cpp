#include <fmt/format.h>

#include "experiments/commands/commands.h"
#include "representations/representation.h"
#include "results/format.h"
#include "results/store.h"
#include "terrain/files.h"
#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

void print_bounds(const Bounds& b) {
  fmt::print("bounds      x {:.6g}…{:.6g} m, y {:.6g}…{:.6g} m, z {:.6g}…{:.6g} m\n", b.low.x, b.high.x,
             b.low.y, b.high.y, b.low.z, b.high.z);
}

void describe_dem(const std::filesystem::path& path) {
  const Dem dem = read_dem(path.string());
  const Heightfield& field = dem.heights;
  const HeightRange range = height_range(field);
  fmt::print("{}: digital elevation model ({})\n", path.string(), dem.format);
  fmt::print("samples     {} × {}, cells {:.6g} m × {:.6g} m, {:.4g} km × {:.4g} km\n", field.width,
             field.depth, field.cell_x, field.cell_z, field.extent_x() / 1000, field.extent_z() / 1000);
  fmt::print("heights     {:.6g}…{:.6g} m, {} without data\n", range.lowest, range.highest, range.no_data);
  fmt::print("checksum    {}\n", checksum(field));
  for (const std::string& note : dem.notes) fmt::print("note        {}\n", note);
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
}

void describe_results(const std::filesystem::path& folder) {
  const Store store = Store::open(folder);
  fmt::print("{}: results, {} cases, profile {}\n", folder.string(), store.records().size(),
             store.last_profile());
  for (const std::string& warning : store.warnings()) fmt::print("warning     {}\n", warning);
  for (const Record& record : store.records()) {
    fmt::print("  {} {} ({}): {} metrics, {} figures\n", record.experiment, record.case_name, record.profile,
               record.metrics.size(), record.figures.size());
  }
}

}  // namespace

ExitCode info_command(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) {
    describe_results(path);
  } else if (is_saved_representation(path)) {
    describe_representation(path);
  } else {
    describe_dem(path);  // says what is wrong with a path that is none of these
  }
  return ExitCode::kGood;
}

}  // namespace terrabench
