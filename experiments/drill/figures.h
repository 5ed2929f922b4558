// The drill paper's figures in its layout.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiments/drill/factorial.h"
#include "experiments/figures/sheet.h"
#include "experiments/recorder.h"

namespace terrabench::drill {

struct Study {
  const Heightfield& ground;
  const FlowNetwork& network;  // variant.route(ground)
  const Variant& variant;
  std::string name;    // for captions
  std::string suffix;  // of figure ids; empty for the main ground and shapes as printed
};

// Figure 1: four panels with every channel pixel at a threshold each.
struct ChannelsSheet {
  figures::Sheet sheet;
  std::vector<Image> maps;  // the panels' pictures
};
inline constexpr std::array<std::uint32_t, 4> kDrawnTaus{25, 50, 100, 200};
ChannelsSheet channels_sheet(const Study&);
// Figure 2 shows this channel pixel, in a clear valley. The ground is more than 2 · 24 samples wide and deep.
std::uint32_t example_pixel(const Study&);
// Figure 3.
struct BestSheet {
  figures::Sheet sheet;
  std::array<Outcome, 2> drawn;  // of the two terrains, compared with the ground again
};
BestSheet best_sheet(const Study&, const Outcome& least_rmse, const Outcome& least_ahd);
// Figure 4.
figures::Sheet error_matrices_sheet(const std::vector<Outcome>&);

// What the maps of figure 1 show, read back from their pixels: whether they are channel networks of their
// thresholds. Networks drawn at random, or of another ground, are told from them.
struct DrawnChannels {
  std::vector<std::size_t> pixels;  // channel pixels of each map
  // Channel pixels that are none in the map before, which has a lower threshold: 0, since flow that exceeds a
  // threshold exceeds the lower ones.
  std::size_t outside_denser = 0;
  // Networks of neighbouring channel pixels that reach neither the border nor a sample without data: 0, since
  // all flow of a pixel goes to one neighbour and no pit stops it.
  std::size_t inland = 0;
  // Of the first map's channel pixels, and of all samples, the share that lies below the mean of the samples
  // around. About equal for pixels at random.
  double low_share = 0, low_share_of_ground = 0;
};

// The place of cell k of `cells` among `others` over the same length, by its middle. At least as many others:
// at_middle(at_middle(k, cells, others), others, cells) == k.
inline int at_middle(int k, int cells, int others) {
  return static_cast<int>((2 * static_cast<std::int64_t>(k) + 1) * others / (2 * cells));
}

// `maps` show all of the ground, channels in kChannel; those with a lower threshold come first. A map is read
// at the middle of each sample. O(samples)
DrawnChannels read_channels(const std::vector<Image>& maps, const Heightfield& ground);

// Draw and record them.
void draw_channels(const Study&, Recorder&);
void draw_cross_sections(const Study&, Recorder&);  // nothing on a smaller ground
void draw_best(const Study&, const Outcome& least_rmse, const Outcome& least_ahd, Recorder&);
void draw_error_matrices(const Study&, const std::vector<Outcome>&, Recorder&);

}  // namespace terrabench::drill
