// Table 1 and figure 2: the two-dimensional example of visibility.
#include <fmt/format.h>

#include <random>

#include "experiments/experiment.h"
#include "experiments/mrbsp/figures.h"
#include "lod/mrbsp/visibility/codec.h"

namespace terrabench::mrbsp {
namespace {

// The share of random profiles with heights within `metres` of ours that give the same table.
double share_alike(float metres, visibility::Mode mode, std::uint64_t seed, Progress& progress) {
  constexpr int kProfiles = 100;
  std::mt19937_64 random(seed);
  int alike = 0;
  for (int k = 0; k < kProfiles; ++k) {
    std::vector<float> heights(table1_profile().begin(), table1_profile().end());
    for (float& h : heights) h += metres * (static_cast<float>(random() >> 40) / 8388608.0F - 1);
    const Heightfield strip = extrude(heights);
    alike += lines_unlike_table1(profile_steps(strip, find_changes(strip, mode, progress), progress)) == 0;
  }
  return static_cast<double>(alike) / kProfiles;
}

std::vector<Case> cases(const RunOptions&) { return {Case{"profile", Parameters(), ""}}; }

void measure(const Case&, const RunOptions& options, Recorder& recorder, Progress& progress) {
  using visibility::Mode;
  const Heightfield strip = extrude(table1_profile());
  recorder.terrain("profile", checksum(strip));
  for (std::size_t m = 0; m < visibility::kModeNames.size(); ++m) {
    const auto mode = static_cast<Mode>(m);
    const std::vector<ProfileStep> found =
        profile_steps(strip, find_changes(strip, mode, progress), progress);
    recorder.add(fmt::format("differing_lines_{}", name_of(mode)), "", lines_unlike_table1(found));
    recorder.add(fmt::format("alike_within_half_a_metre_{}", name_of(mode)), "",
                 share_alike(0.5F, mode, options.seed, progress));
  }
  // The first reading of the sampling that gives the table.
  const visibility::ChangeTable table = find_changes(strip, Mode::kFacing, progress);
  const std::vector<ProfileStep> steps = profile_steps(strip, table, progress);
  std::size_t changes = 0;
  for (const ProfileStep& step : steps) changes += step.coarse.size();
  recorder.add("changes", "", changes);
  // Saved and loaded again.
  const visibility::ChangeTable again = visibility::decode_text(encode_text(table), "table 1");
  recorder.add("lost_in_the_file", "", again == table ? 0 : 1);
  const ProfileSheet drawn = profile_sheet(table1_profile(), steps);
  recorder.add("drawn_fine_segments", "", drawn.fine_segments);
  recorder.add("drawn_coarse_segments", "", drawn.coarse_segments);
  recorder.add("drawn_cells", "", drawn.cells);
  recorder.add("drawn_dark_cells", "", drawn.dark_cells);
  drawn.sheet.write(recorder.figure(
      "mrbsp.F2",
      "Figure 2 of the paper: fine segments (black) and coarse ones (grey), "
      "with their numbers in the tree, and cells. Cells next to a change of visibility are dark, "
      "with the coarse segments that change."));
  table_sheet(table1(), steps)
      .write(recorder.figure("mrbsp.T1",
                             "Table 1 of the paper, cell-to-cell changes in visibility, beside those that we "
                             "compute on figure 2's profile extruded sideways, by triangles that face an eye "
                             "at a corner of the cell. Coarse changes are as stored, fine ones as drawn."));
}

}  // namespace

extern const Experiment kProfile{
    "mrbsp.profile", "Table 1 and figure 2: visibility of a profile", {}, cases, measure};

}  // namespace terrabench::mrbsp
