// Reading, resampling and hole filling in Mpixel/s, each compared with GDAL for the same result in the same
// run. Counter `vs_gdal` is GDAL's time over ours: above 1 we are faster.
#include <benchmark/benchmark.h>
#include <gdal_alg.h>
#include <gdal_priv.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "terrain/sources/dem/dem.h"

namespace terrabench {
namespace {

double seconds(const auto& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void require(CPLErr error) {
  if (error != CE_None) std::abort();
}

// Rolling ground; with `holes`, 3 % of it missing in discs.
Heightfield ground(int size, bool holes) {
  Heightfield field;
  field.width = field.depth = size;
  field.cell_x = field.cell_z = 30;
  field.heights.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const int u = i % 256 - 128, v = j % 256 - 128;
      const float x = static_cast<float>(i), z = static_cast<float>(j);
      field.at(i, j) = holes && u * u + v * v < 25 * 25
                           ? Heightfield::kNoData
                           : 500 * std::sin(x * 0.01F) + 300 * std::cos(z * 0.013F);
    }
  }
  return field;
}

struct Close {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<GDALDataset, Close>;

// GDAL's view of the same heights, with NaN as no-data.
Dataset memory_dataset(const Heightfield& field) {
  GDALAllRegister();  // the reader removes MEM
  Dataset dataset(GetGDALDriverManager()->GetDriverByName("MEM")->Create("", field.width, field.depth, 1,
                                                                         GDT_Float32, nullptr));
  GDALRasterBand& band = *dataset->GetRasterBand(1);
  band.SetNoDataValue(Heightfield::kNoData);
  require(band.RasterIO(GF_Write, 0, 0, field.width, field.depth, const_cast<float*>(field.heights.data()),
                        field.width, field.depth, GDT_Float32, 0, 0, nullptr));
  return dataset;
}

// Times ours in the loop, and GDAL's once per iteration outside the timing; both report their best.
template <class Ours, class Theirs>
void compare(benchmark::State& state, double pixels, const Ours& ours, const Theirs& theirs) {
  double our_best = 1e300, their_best = 1e300;
  for (auto _ : state) {
    const double our_time = seconds(ours);
    state.SetIterationTime(our_time);
    our_best = std::min(our_best, our_time);
    their_best = std::min(their_best, seconds(theirs));
  }
  state.counters["Mpixel/s"] = pixels / our_best / 1e6;
  state.counters["gdal_Mpixel/s"] = pixels / their_best / 1e6;
  state.counters["vs_gdal"] = their_best / our_best;
}

double pixels_of(int size) { return static_cast<double>(size) * size; }

void read_geotiff(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const std::string path = "/vsimem/bench.tif";
  const Heightfield field = ground(size, false);
  {
    const Dataset memory = memory_dataset(field);
    const char* const options[] = {"TILED=YES", nullptr};
    GDALClose(GetGDALDriverManager()->GetDriverByName("GTiff")->CreateCopy(
        path.c_str(), memory.get(), 0, const_cast<char**>(options), nullptr, nullptr));
  }
  compare(
      state, pixels_of(size), [&] { benchmark::DoNotOptimize(read_dem(path).heights.heights.data()); },
      [&] {
        const Dataset dataset(GDALDataset::Open(path.c_str()));
        std::vector<float> heights(field.heights.size());
        require(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, size, size, heights.data(), size, size,
                                                    GDT_Float32, 0, 0, nullptr));
        benchmark::DoNotOptimize(heights.data());
      });
  VSIUnlink(path.c_str());
}

void resample_by(benchmark::State& state, double factor, GDALRIOResampleAlg method, bool holes) {
  const int size = static_cast<int>(state.range(0)), to = static_cast<int>(size * factor);
  const Heightfield field = ground(size, holes);
  const Dataset dataset = memory_dataset(field);
  GDALRasterIOExtraArg how;
  INIT_RASTERIO_EXTRA_ARG(how);
  how.eResampleAlg = method;
  // Per pixel of the larger grid.
  compare(
      state, pixels_of(std::max(size, to)),
      [&] { benchmark::DoNotOptimize(resample(field, to, to).heights.data()); },
      [&] {
        std::vector<float> heights(static_cast<std::size_t>(to) * static_cast<std::size_t>(to));
        require(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, size, size, heights.data(), to, to,
                                                    GDT_Float32, 0, 0, &how));
        benchmark::DoNotOptimize(heights.data());
      });
}

void fill_holes(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const Heightfield field = ground(size, true), truth = ground(size, false);
  Heightfield filled;
  std::vector<float> theirs(field.heights.size());
  compare(
      state, pixels_of(size), [&] { filled = fill_no_data(field); },
      [&] {
        const Dataset dataset = memory_dataset(field);
        GDALRasterBand* const band = dataset->GetRasterBand(1);
        char** options = CSLSetNameValue(nullptr, "TEMP_FILE_DRIVER", "MEM");
        require(GDALFillNodata(band, nullptr, 60, 0, 0, options, nullptr, nullptr));
        CSLDestroy(options);
        require(
            band->RasterIO(GF_Read, 0, 0, size, size, theirs.data(), size, size, GDT_Float32, 0, 0, nullptr));
      });
  const auto error = [&](const std::vector<float>& heights) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
      if (!Heightfield::is_no_data(field.heights[k])) continue;
      sum += std::pow(heights[k] - truth.heights[k], 2);
      ++count;
    }
    return std::sqrt(sum / static_cast<double>(count));
  };
  state.counters["rmse_m"] = error(filled.heights);
  state.counters["gdal_rmse_m"] = error(theirs);
}

void halve(benchmark::State& state) { resample_by(state, 0.5, GRIORA_Average, false); }
void halve_with_holes(benchmark::State& state) { resample_by(state, 0.5, GRIORA_Average, true); }
void reduce_to_three_tenths(benchmark::State& state) { resample_by(state, 0.3, GRIORA_Average, false); }
void enlarge_by_half(benchmark::State& state) { resample_by(state, 1.5, GRIORA_Bilinear, false); }

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(4096)->Arg(8192)->UseManualTime()->Unit(benchmark::kMillisecond)->MinTime(0.5);
}
BENCHMARK(read_geotiff)->Apply(sizes);
BENCHMARK(halve)->Apply(sizes);
BENCHMARK(halve_with_holes)->Apply(sizes);
BENCHMARK(reduce_to_three_tenths)->Apply(sizes);
BENCHMARK(enlarge_by_half)->Apply(sizes);
BENCHMARK(fill_holes)->Apply(sizes);

}  // namespace
}  // namespace terrabench
