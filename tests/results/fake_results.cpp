#include "tests/results/fake_results.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "results/store/record_json.h"
#include "terrain/image.h"

namespace terrabench {
namespace {

Image gradient(int width, int height) {
  Image image(width, height, {255, 255, 255});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto v = static_cast<std::uint8_t>(255 * (x + y) / (width + height));
      image.set(x, y, {v, static_cast<std::uint8_t>(200 - v / 2), 90});
    }
  }
  return image;
}

constexpr int kWidth = 320, kHeight = 200;

double mean_brightness(const Image& image) {
  return std::reduce(image.rgb.begin(), image.rgb.end(), 0.0) /
         (255.0 * static_cast<double>(image.rgb.size()));
}

// A figure of one panel.
void add_picture(Record& record, const std::filesystem::path& folder, const std::string& id,
                 std::string caption, std::vector<std::string> words = {}) {
  const std::string file = "figures/" + id + ".webp";
  write_picture(folder / file, gradient(kWidth, kHeight));
  record.figures.push_back({id, file, std::move(caption), checksum(read_file(folder / file)),
                            FigureLayout{{{0, 0, kWidth, kHeight}}, std::move(words)}});
}

void add_tables(Store& store, const Provenance& run, const std::string& profile) {
  const bool paper = profile == "paper";
  for (const int n : {64, 128, 256, 512}) {
    const double columns = n * n, cells = columns * n;
    Record memory = fake_record(run, "hybrid.table1", fmt::format("n={}", n), profile);
    add(memory, "paper_stack_bytes", "B", {columns * 24});
    add(memory, "columns_over_three_layers", "", {0.1});
    add(memory, "dense_voxel_bytes", "B", {cells});
    add(memory, "dense_heap_bytes", "B", {cells + 4192});
    add(memory, "voxel_to_stack_ratio", "", {cells / (columns * 24)});
    add(memory, "stack_bytes", "B", {columns * 13 + 48});
    add(memory, "stack_heap_bytes", "B", {columns * 13 + 48});
    add(memory, "stack_bytes_per_column", "B", {(columns * 13 + 48) / columns});
    add(memory, "paper_layout_heap_bytes", "B", {columns * 40});
    add(memory, "openvdb_bytes", "B", {cells / 30 + 4096});
    add(memory, "openvdb_heap_bytes", "B", {cells / 30 + 4096});
    add(memory, "point_queries_per_second", "1/s", {3.1e7, 3.2e7, 3.0e7, 3.1e7, 3.2e7, 3.0e7});
    add(memory, "column_queries_per_second", "1/s", {8.1e6, 8.2e6, 8.0e6, 8.1e6, 8.2e6, 8.0e6});
    if (paper ? n >= 128 : n <= 256) store.append(memory);
    for (const std::string_view work : {"", "/every-cell"}) {
      Record time = fake_record(run, "hybrid.table2", fmt::format("n={}{}", n, work), profile);
      const double seconds = 0.021 * std::pow(n / 64.0, 2.96);
      add(time, "generation_time", "s",
          {seconds, seconds * 1.04, seconds * 0.98, seconds * 1.2, seconds * 1.01, seconds * 1.01});
      add(time, "samples_per_second", "1/s",
          {cells / seconds, cells / seconds / 1.02, cells / seconds / 1.04, cells / seconds,
           cells / seconds / 1.02, cells / seconds / 1.04});
      if (paper || n <= 256) store.append(time);
    }
  }
}

}  // namespace

FolderTest::FolderTest() {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  folder_ = std::filesystem::temp_directory_path() /
            fmt::format("terrabench.{}.{}.{}", test->test_suite_name(), test->name(), getpid());
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
}

FolderTest::~FolderTest() { std::filesystem::remove_all(folder_); }

Paper paper_of(std::string_view entries) {
  return parse_claims(fmt::format("paper = \"p\"\ntitle = \"t\"\nsource = \"s\"\n{}", entries),
                      "claims.toml");
}

Paper paper_with_claim(std::string_view type, std::string_view check, std::string_view more) {
  return paper_of(fmt::format(
      "[[claim]]\nid = \"p.1\"\nwhere = \"w\"\nstatement = \"s\"\nclass = \"{}\"\ncheck = [{}]\n{}", type,
      check, more));
}

std::string claim_entry(std::string_view id, std::string_view check, std::string_view more) {
  return fmt::format(
      "[[claim]]\nid = \"{0}\"\nwhere = \"w\"\nstatement = \"states {0}\"\nclass = \"E\"\n"
      "check = [{1}]\n{2}",
      id, check, more);
}

std::string table_entry(std::string_view id, std::string_view rows, std::string_view columns,
                        std::string_view more) {
  return fmt::format(
      "[[table]]\nid = \"{0}\"\ntitle = \"{0}\"\ncaption = \"c\"\nexperiment = \"e\"\nrows_title = \"r\"\n"
      "rows = [{1}]\ncolumns = [{2}]\n{3}",
      id, rows, columns, more);
}

std::string plot_entry(std::string_view id, std::string_view series, std::string_view more) {
  return fmt::format(
      "[[plot]]\nid = \"{0}\"\ntitle = \"{0}\"\ncaption = \"c\"\nx = {{label = \"x\"}}\n"
      "y = {{label = \"y\"}}\nseries = [{1}]\n{2}",
      id, series, more);
}

Provenance fake_provenance() {
  Provenance p;
  p.time = "2024-02-29T12:00:00Z";
  p.command = "terrabench run --profile quick";
  p.git_revision = "0123456789abcdef0123456789abcdef01234567";
  p.git_dirty = false;
  p.compiler = "GNU 12.2.0";
  p.flags = "-O3";
  p.build_type = "Release";
  p.cpu = "A processor <of & for> tests";
  p.os = "Debian GNU/Linux 12";
  p.gl_renderer = "llvmpipe";
  p.threads = 2;
  p.memory = std::uint64_t{8} << 30;
  p.simd = "AVX2";
  p.libraries = {{"GDAL", "3.6.2"}, {"VTK", "9.1.0"}};
  p.id = digest(p);
  return p;
}

Record fake_record(const Provenance& run, std::string experiment, std::string case_name,
                   std::string profile) {
  Record record;
  record.experiment = std::move(experiment);
  record.case_name = std::move(case_name);
  record.profile = std::move(profile);
  record.run = run.id;
  record.seed = 1;
  record.terrain = "caves";
  record.terrain_checksum = "00112233445566778899aabbccddeeff";
  record.parameters = {{"n", std::int64_t{128}}, {"scale", 1.0}, {"name", std::string("x")}, {"flag", true}};
  return record;
}

void add(Record& record, std::string metric, std::string unit, std::vector<double> samples) {
  record.metrics.push_back({std::move(metric), std::move(unit), std::move(samples)});
}

namespace {

bool is_faked(const Condition& condition) {
  constexpr std::array kExperiments = {"hybrid.table1", "hybrid.table2", "hybrid.caves",
                                       "hybrid.noise-stages"};
  if (condition.kind == Condition::Kind::kFigure) {
    for (int k = 3; k <= 13; ++k) {
      if (condition.figure == fmt::format("hybrid.F{}", k)) return true;
    }
    return false;
  }
  return std::ranges::all_of(condition.operands, [&](const Operand& operand) {
    return operand.is_number() || std::ranges::find(kExperiments, operand.experiment) != kExperiments.end();
  });
}

}  // namespace

std::span<const Paper> faked_papers() {
  static const std::vector<Paper> kFaked = [] {
    std::vector<Paper> faked;
    for (const Paper& paper : papers()) {
      if (paper.id != "hybrid" && paper.id != "cross") continue;
      std::erase_if(faked.emplace_back(paper).claims,
                    [](const Claim& c) { return !std::ranges::all_of(c.conditions, is_faked); });
    }
    return faked;
  }();
  return kFaked;
}

void write_fake_results(const std::filesystem::path& folder, const std::string& profile) {
  Store store(folder);
  const Provenance run = fake_provenance();
  store.begin_run(run);
  add_tables(store, run, profile);
  // Overhanging columns, floating components and volume, solid share.
  const std::pair<const char*, std::array<double, 4>> caves[] = {
      {"y-only", {0, 0, 0, 0.49}},
      {"x-and-y", {812, 1, 5, 0.49}},
      {"caves-no-attenuation", {950, 41, 230, 0.43}},
      {"caves-attenuated", {700, 1, 5, 0.46}},
      {"caves-printed-product", {640, 9, 1202, 0.31}},
      {"caves-printed-product-no-attenuation", {640, 19, 10449, 0.21}},
      {"x-and-y/n=128", {389, 1, 5, 0.49}},
      {"caves-attenuated/n=128", {846, 3, 8, 0.46}}};
  for (const auto& [name, counts] : caves) {
    Record record = fake_record(run, "hybrid.caves", name, profile);
    add(record, "overhang_columns", "", {counts[0]});
    add(record, "floating_components", "", {counts[1]});
    add(record, "floating_volume", "m³", {counts[2]});
    add(record, "solid_share", "", {counts[3]});
    store.append(record);
  }
  // Mean, least and most of the slices of figures 3 to 13.
  constexpr std::array<std::array<double, 3>, 11> kSlices{{{0.5, 0.001, 0.999},
                                                           {0.5, 0, 1},
                                                           {0.08, -0.26, 0.39},
                                                           {0.03, -0.18, 0.18},
                                                           {0.486, 0, 1},
                                                           {0.492, 0, 1},
                                                           {0.645, 0.155, 0.993},
                                                           {0.651, 0, 1},
                                                           {0.656, 0, 1},
                                                           {0.433, 0, 1},
                                                           {0.463, 0, 1}}};
  // What a figure has to do with those before it.
  struct Relation {
    int figure;
    const char* metric;
    double value;
  };
  constexpr Relation kRelations[] = {{3, "row_spread", 0},
                                     {3, "off_the_line", 1e-7},
                                     {4, "highest_gradient_of_air", 0.499},
                                     {4, "lowest_gradient_of_ground", 0.501},
                                     {5, "column_spread", 0.5},
                                     {5, "bend_4m", 1e-4},
                                     {5, "bend_8m", 6e-4},
                                     {5, "lowest_row_step", 0.01},
                                     {6, "column_spread", 0},
                                     {6, "off_lowest_row", 0.005},
                                     {7, "heights_off_the_noise", 0.6},
                                     {7, "relief", 200},
                                     {8, "share_off_the_shift", 0},
                                     {8, "share_far_from_edges", 0},
                                     {9, "sharpness_of_maxima", 0.03},
                                     {9, "sharpness_of_minima", 0.003},
                                     {10, "highest_noise_outside", 0.719},
                                     {10, "lowest_noise_inside", 0.721},
                                     {11, "share_moved", 0.05},
                                     {11, "share_off_the_shift", 0},
                                     {11, "share_far_from_edges", 0.001},
                                     {12, "share_off_product", 0},
                                     {13, "caves_added", 0},
                                     {13, "caves_left_low", 0.9},
                                     {13, "caves_left_high", 0.3}};
  for (int figure = 3; figure <= 13; ++figure) {
    Record record = fake_record(run, "hybrid.noise-stages", fmt::format("F{}", figure), profile);
    const std::array<double, 3>& slice = kSlices[static_cast<std::size_t>(figure - 3)];
    add(record, "mean", "", {slice[0]});
    add(record, "least", "", {slice[1]});
    add(record, "most", "", {slice[2]});
    add(record, "mean_shown", "", {mean_brightness(gradient(kWidth, kHeight))});
    for (const auto& [of, metric, value] : kRelations) {
      if (of == figure) add(record, metric, "", {value});
    }
    std::vector<std::string> words;
    if (figure == 7 || figure == 8 || figure == 12 || figure == 13) {
      const double floating = figure == 7 ? 0 : figure == 12 ? 7 : 1;
      add(record, "overhang_columns", "", {figure == 7 ? 0.0 : 200});
      add(record, "floating_pieces", "", {floating});
      add(record, "floating_area", "m²", {10 * floating});
      words.push_back(fmt::format("Ground that floats: {} pieces, {} m²", floating, 10 * floating));
    }
    add_picture(record, folder, fmt::format("hybrid.F{}", figure), "Vertical slice of 64 m × 64 m.", words);
    store.append(record);
  }
  Record relief = fake_record(run, "overview.relief", "jacksboro/heightmap", profile);
  add(relief, "bytes", "B", {554528});
  add_picture(relief, folder, "relief.jacksboro.heightmap", "jacksboro as heightmap.");
  store.append(relief);
}

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

void edit(const std::filesystem::path& file, std::string_view from, std::string_view to) {
  std::string text = read_file(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, text.npos) << from;
  write_file(file, text.replace(at, from.size(), to));
}

}  // namespace terrabench
