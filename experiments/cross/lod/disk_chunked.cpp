// Chunked level of detail from disk: a flight at 100 m/s and 60 frames per second, as fast as time passes.
// The case has a process of its own, whose peak memory is that of the flight.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>

#include "experiments/cross/files/temporary_folder.h"
#include "experiments/cross/lod/ground_on_disk.h"
#include "experiments/experiment.h"
#include "experiments/stopwatch.h"
#include "lod/chunked/paged_chunked.h"
#include "terrain/error.h"

namespace terrabench::cross {
namespace {

namespace fs = std::filesystem;

const std::array kSpecs{
    kMountainsSide,
    ParameterSpec{"budget", std::int64_t{128}, "MiB", "of chunks in memory", 1, 65536},
    ParameterSpec{"seconds", std::int64_t{30}, "s", "of the flight", 1, 100000},
};
constexpr double kRate = 60;                                                // frames per second
constexpr float kSpeed = 100, kHeight = 100, kPitch = -0.1F, kTurn = 0.1F;  // m/s; m over the ground; rad/s

// From the middle of the ground to the east and back again while the sight turns, at a fixed height over the
// ground below.
std::vector<View> flight(const fs::path& folder, int seconds) {
  const auto pyramid = HeightPyramid::open(folder);
  const int middle = pyramid->depth() / 2, width = pyramid->width();
  std::vector<float> row(static_cast<std::size_t>(width) + 1);
  pyramid->read(0, 0, middle, width + 1, 1, row.data(), width + 1);
  const float extent = static_cast<float>(width - 1) * pyramid->cell_x();
  std::vector<View> views(static_cast<std::size_t>(seconds * kRate));
  for (std::size_t k = 0; k < views.size(); ++k) {
    const float time = static_cast<float>(static_cast<double>(k) / kRate),
                flown = std::fmod(0.5F * extent + kSpeed * time, 2 * extent);
    const float x = std::min(flown, 2 * extent - flown), sample = x / pyramid->cell_x();
    const auto i = static_cast<std::size_t>(sample);
    View& view = views[k];
    view.eye = {x, std::lerp(row[i], row[i + 1], sample - static_cast<float>(i)) + kHeight,
                static_cast<float>(middle) * pyramid->cell_z()};
    view.target = view.eye + glm::vec3(std::cos(kTurn * time), kPitch, std::sin(kTurn * time));
    view.width = 1920;
    view.height = 1080;
    view.near = 1;
    view.far = 150000;
  }
  return views;
}

// Frees the memory in which the system keeps what was written, so that chunks come from the disk.
void forget_content(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const bool forgotten = descriptor >= 0 && posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED) == 0;
  if (descriptor >= 0) close(descriptor);
  if (!forgotten) {
    throw environment_error("the system does not free the memory that holds it", file.string(),
                            "set TMPDIR to a folder on a disk");
  }
}

// Updates without pause until all chunks of the first view are there, then at the time of each frame.
void fly(const fs::path& chunks, const std::vector<View>& views, std::size_t budget, Recorder& recorder,
         Progress& progress) {
  using Clock = std::chrono::steady_clock;
  const Stopwatch first;
  const auto lod = std::make_unique<PagedChunked>(chunks, budget);
  for (lod->update(views.front()); !lod->settled(); lod->update(views.front())) lod->finish();
  recorder.add("first_time", "s", first.seconds());
  const std::uint64_t late = lod->late_frames(), read = lod->bytes_read();
  std::vector<double> times;
  progress.begin("flying over the ground", views.size());
  const Clock::time_point begin = Clock::now();
  for (const View& view : views) {
    std::this_thread::sleep_until(
        begin + std::chrono::duration_cast<Clock::duration>(
                    std::chrono::duration<double>(static_cast<double>(times.size()) / kRate)));
    const Stopwatch watch;
    lod->update(view);
    times.push_back(watch.seconds());
    recorder.add_frame("update_time", "s", times.back());
    progress.advance();
  }
  std::ranges::sort(times);
  recorder.add("p99_time", "s", times[(times.size() - 1) * 99 / 100]);
  recorder.add("longest_time", "s", times.back());
  recorder.add_varying("late_frames", "", static_cast<double>(lod->late_frames() - late));
  recorder.add_varying("read_bytes", "B", static_cast<double>(lod->bytes_read() - read));
  recorder.add_varying("held_bytes", "B", static_cast<double>(lod->memory().total()));
}

void measure(const Case& at, const RunOptions& options, Recorder& recorder, Progress& progress) {
  const TemporaryFolder folder;
  const fs::path pyramid = pyramid_of(at, options, folder.path(), recorder, progress),
                 chunks = folder.path() / "chunks";
  forget_peak();
  const Stopwatch watch;
  chunked::ChunkFile::build(*heights_on_disk(HeightPyramid::open(pyramid)), {}, chunks, progress);
  recorder.add("build_time", "s", watch.seconds());
  recorder.add_varying("build_resident", "B", static_cast<double>(peak_resident_bytes()));
  recorder.add("file_bytes", "B", static_cast<double>(fs::file_size(chunks)));
  const std::vector<View> views = flight(pyramid, at.integer("seconds"));
  forget_content(chunks);
  forget_peak();
  fly(chunks, views, static_cast<std::size_t>(at.integer("budget")) << 20, recorder, progress);
  recorder.add_varying("peak_resident", "B", static_cast<double>(peak_resident_bytes()));
}

std::vector<Case> cases(const RunOptions& options) { return cases_on_disk(kSpecs, options); }

}  // namespace

extern const Experiment kLodDiskChunked{
    "cross.lod-disk-chunked", "Chunks over ground that stays on disk", kSpecs, cases, measure,
    Experiment::kOwnProcess};

}  // namespace terrabench::cross
