#include "terrain/sources/dem/dem.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include "terrain/error.h"
#include "terrain/memory.h"
#include "terrain/sources/dem/band_reader.h"
#include "terrain/sources/dem/gdal_session.h"
#include "terrain/sources/dem/height_values.h"
#include "terrain/sources/dem/placement.h"

namespace terrabench {
namespace {

std::string size_text(std::uint64_t width, std::uint64_t depth) { return fmt::format("{}×{}", width, depth); }

// The pixels asked for, in the file's own order.
DemWindow choose_window(GDALDataset& dataset, const DemWindow& asked, const std::string& where) {
  const int width = dataset.GetRasterXSize(), depth = dataset.GetRasterYSize();
  if (asked.whole()) return {0, 0, width, depth};
  if (asked.in_middle) {
    return choose_window(dataset,
                         {std::max(0, width - asked.width) / 2, std::max(0, depth - asked.depth) / 2,
                          asked.width, asked.depth},
                         where);
  }
  if (asked.x < 0 || asked.y < 0 || asked.width < 1 || asked.depth < 1 || asked.width > width - asked.x ||
      asked.depth > depth - asked.y) {
    throw usage_error(
        fmt::format("a window of {} pixels from ({}, {}) does not lie inside its {}",
                    size_text(asked.width, asked.depth), asked.x, asked.y, size_text(width, depth)),
        where, "give a window of at least one pixel inside the raster");
  }
  const Directions directions = directions_of(dataset);
  return {directions.mirrored ? width - asked.x - asked.width : asked.x,
          directions.south_first ? depth - asked.y - asked.depth : asked.y, asked.width, asked.depth};
}

// The sizes at each step from the file to the result.
struct Plan {
  int width, depth;  // of the result
  bool reduced;      // averages while reading
  int read_width,
      read_depth;  // what is held first: the result's, or the window's when it is enlarged afterwards
};

Plan plan_sizes(const DemWindow& window, const DemOptions& options, const std::string& where) {
  if (options.width < 0 || options.depth < 0) {
    throw usage_error(
        fmt::format("width and depth must be at least 1, got {}", size_text(options.width, options.depth)),
        where, "choose the number of samples along both sides");
  }
  Plan plan{options.width > 0 ? options.width : window.width,
            options.depth > 0 ? options.depth : window.depth, false, window.width, window.depth};
  plan.reduced = plan.width <= window.width && plan.depth <= window.depth &&
                 (plan.width < window.width || plan.depth < window.depth);
  if (plan.reduced) {
    plan.read_width = plan.width;
    plan.read_depth = plan.depth;
  }
  return plan;
}

// Why the plan cannot be carried out; empty: it can.
std::string size_fault(const Plan& plan, const DemOptions& options, std::uint64_t buffers) {
  const std::uint64_t samples =
      std::max(std::uint64_t(plan.width) * plan.depth, std::uint64_t(plan.read_width) * plan.read_depth);
  if (samples > options.max_samples) {
    return fmt::format("{} samples are {:.0f} million, more than the {:.0f} million allowed",
                       size_text(plan.width, plan.depth), samples / 1e6, options.max_samples / 1e6);
  }
  const bool resampled_after = plan.read_width != plan.width || plan.read_depth != plan.depth;
  std::uint64_t bytes = std::uint64_t(plan.read_width) * plan.read_depth * sizeof(float) + buffers;
  if (resampled_after) bytes += std::uint64_t(plan.width) * plan.depth * sizeof(float);
  const std::uint64_t available = available_memory();
  if (bytes <= available) return "";
  return fmt::format("{} samples need {:.1f} GB of memory, and {:.1f} GB are free",
                     size_text(plan.width, plan.depth), bytes / 1e9, available / 1e9);
}

void check_sizes(const Plan& plan, const DemWindow& window, const DemOptions& options, std::uint64_t buffers,
                 const std::string& where) {
  const std::string fault = size_fault(plan, options, buffers);
  if (fault.empty()) return;
  const double most =
      std::min(static_cast<double>(options.max_samples), static_cast<double>(available_memory()) / 8);
  const double factor = std::sqrt(most / (static_cast<double>(window.width) * window.depth));
  const int width = std::max(1, static_cast<int>(std::min(factor, 1.0) * window.width));
  const int depth = std::max(1, static_cast<int>(std::min(factor, 1.0) * window.depth));
  throw bad_input(
      fault, where,
      fmt::format("read a part of it (crop) or read it smaller (resample), to {} samples for example",
                  size_text(width, depth)));
}

// Flips the field to rows from north to south and columns from west to east.
void turn(const Placement& placement, Heightfield& field) {
  std::array<double, 6>& t = field.georeference.transform;
  if (placement.mirrored) {
    tbb::parallel_for(0, field.depth,
                      [&](int j) { std::reverse(&field.at(0, j), &field.at(0, j) + field.width); });
    t[0] += field.width * t[1];
    t[1] = -t[1];
  }
  if (placement.south_first) {
    tbb::parallel_for(0, field.depth / 2, [&](int j) {
      std::swap_ranges(&field.at(0, j), &field.at(0, j) + field.width, &field.at(0, field.depth - 1 - j));
    });
    t[3] += field.depth * t[5];
    t[5] = -t[5];
  }
}

void note_holes(const Tally& tally, const DemWindow& window, const std::string& where,
                std::vector<std::string>& notes) {
  const std::uint64_t samples = std::uint64_t(window.width) * window.depth;
  if (tally.too_high > 0) {
    throw bad_input(
        fmt::format("{} of {} heights lie beyond ±1000 km", tally.too_high, samples), where,
        fmt::format("if they are not in metres, name their unit: {0}FILE,unit=mm; if they stand for "
                    "no height, name the number: {0}FILE,nodata=9999999",
                    kDemPrefix));
  }
  if (tally.holes() == samples) {
    throw bad_input("no sample holds a height", where,
                    tally.impossible < samples
                        ? "choose another window or band; check the file's no-data value and mask"
                        : "all are NaN, infinite or beyond ±1000 km: check its data type and scale");
  }
  if (tally.missing > 0)
    notes.push_back(fmt::format("{} of {} samples hold no height", tally.missing, samples));
  for (std::size_t k = 0; k < kUsualNoData.size(); ++k) {
    if (tally.undeclared[k] == 0) continue;
    notes.push_back(
        fmt::format("{} of {} samples are {}, which the file does not declare as no-data but often "
                    "stands for it: taken as no height; {}FILE,nodata=none takes them as heights",
                    tally.undeclared[k], samples, kUsualNoData[k], kDemPrefix));
  }
  if (tally.impossible > 0) {
    notes.push_back(
        fmt::format("{} heights are NaN, infinite or beyond ±10⁹ m: taken as no-data", tally.impossible));
  }
}

// A file, opened, and how its pixels become heights.
struct Opened {
  Opened(const std::string& path, const DemOptions& options, const std::string& where,
         std::vector<std::string>& notes)
      : dataset(open_dataset(path, where, messages)),
        bands(choose_bands(*dataset, options, where, notes)),
        window(choose_window(*dataset, options.window, where)),
        placement(place_raster(*dataset, window, where, notes)),
        reader(bands, window, height_rule(*bands[0], options, placement, where, notes), messages, where),
        plan(plan_sizes(window, options, where)) {}

  std::string format() const {
    return dataset->GetDriver() != nullptr ? dataset->GetDriver()->GetDescription() : "";
  }

  GdalMessages messages;
  DatasetPointer dataset;
  std::vector<GDALRasterBand*> bands;
  DemWindow window;  // in the file's own order
  Placement placement;
  BandReader reader;
  Plan plan;
};

std::string window_note(const Opened& opened, const DemWindow& asked) {
  const std::string whole = size_text(opened.dataset->GetRasterXSize(), opened.dataset->GetRasterYSize());
  const std::string part = size_text(asked.width, asked.depth);
  if (asked.in_middle) return fmt::format("the middle {} of its {} samples", part, whole);
  return fmt::format("{} of its {} samples, from column {} and row {}", part, whole, asked.x, asked.y);
}

// The field that the plan reads first, without its heights.
Heightfield planned_field(const Opened& opened) {
  Heightfield field;
  field.width = opened.plan.read_width;
  field.depth = opened.plan.read_depth;
  const double ratio_x = static_cast<double>(opened.window.width) / field.width;
  const double ratio_z = static_cast<double>(opened.window.depth) / field.depth;
  field.cell_x = static_cast<float>(opened.placement.cell_x * ratio_x);
  field.cell_z = static_cast<float>(opened.placement.cell_z * ratio_z);
  field.georeference = opened.placement.georeference;
  for (const int k : {1, 4}) field.georeference.transform[k] *= ratio_x;
  for (const int k : {2, 5}) field.georeference.transform[k] *= ratio_z;
  return field;
}

Dem read(const std::string& path, const DemOptions& options, Progress* progress) {
  const std::string where = label(path);
  register_gdal();
  Dem dem;
  Opened opened(path, options, where, dem.notes);
  dem.format = opened.format();
  check_raw_length(*opened.dataset, opened.bands[0]->GetBand(), where);
  const DemWindow& window = opened.window;
  const Plan& plan = opened.plan;
  check_sizes(plan, window, options, opened.reader.buffer_bytes(plan.reduced), where);

  Heightfield& field = dem.heights;
  field = planned_field(opened);
  field.heights.resize(static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.depth));
  if (plan.reduced) {
    opened.reader.read_reduced(field.width, field.depth, field.heights.data(), progress);
  } else {
    opened.reader.read_whole(field.heights.data(), progress);
  }
  if (!options.window.whole()) dem.notes.push_back(window_note(opened, options.window));
  note_holes(opened.reader.tally(), window, where, dem.notes);
  turn(opened.placement, field);
  if (field.width != plan.width || field.depth != plan.depth) field = resample(field, plan.width, plan.depth);
  if (plan.width != window.width || plan.depth != window.depth) {
    dem.notes.push_back(fmt::format("{} pixels were resampled to {}", size_text(window.width, window.depth),
                                    size_text(plan.width, plan.depth)));
  }
  if (options.fill_no_data) {
    const std::size_t holes = height_range(field).no_data;
    if (holes > 0) {
      field = terrabench::fill_no_data(field);
      dem.notes.push_back(fmt::format("{} samples without height were filled from around them", holes));
    }
  }
  for (const std::string& warning : opened.messages.warnings()) dem.notes.push_back("GDAL warns: " + warning);
  return dem;
}

}  // namespace

Dem read_dem(const std::string& name, const DemOptions& options, Progress* progress) {
  const NamedDem dem = parse_dem(name, options);
  try {
    return read(dem.path, dem.options, progress);
  } catch (const std::bad_alloc&) {
    throw environment_error("not enough memory to read it", label(dem.path),
                            "read a part of it (crop) or read it smaller (resample)");
  }
}

DemHeader read_dem_header(const std::string& name, const DemOptions& options) {
  const NamedDem dem = parse_dem(name, options);
  const std::string where = label(dem.path);
  register_gdal();
  DemHeader header;
  const Opened opened(dem.path, dem.options, where, header.notes);
  header.width = opened.window.width;
  header.depth = opened.window.depth;
  header.cell_x = opened.placement.cell_x;
  header.cell_z = opened.placement.cell_z;
  header.type = GDALGetDataTypeName(opened.bands[0]->GetRasterDataType());
  header.format = opened.format();
  header.too_large = size_fault(opened.plan, dem.options, opened.reader.buffer_bytes(opened.plan.reduced));
  return header;
}

}  // namespace terrabench
