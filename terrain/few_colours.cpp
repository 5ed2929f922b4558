// Median cut (Heckbert 1982) by squared error instead of count, then a few rounds of nearest means (Lloyd).
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "terrain/image.h"

namespace terrabench {
namespace {

constexpr int kRounds = 3;

struct Counted {
  Rgb colour;
  double pixels;
};

std::uint32_t packed(const std::uint8_t* rgb) {
  return static_cast<std::uint32_t>(rgb[0]) << 16 | static_cast<std::uint32_t>(rgb[1]) << 8 | rgb[2];
}

// Every colour once, sorted, with how many pixels have it.
std::vector<Counted> histogram(const Image& image) {
  std::vector<std::uint32_t> all(image.rgb.size() / 3);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = packed(&image.rgb[3 * i]);
  std::sort(all.begin(), all.end());
  std::vector<Counted> colours;
  for (std::size_t i = 0; i < all.size();) {
    const std::size_t end =
        std::upper_bound(all.begin() + static_cast<std::ptrdiff_t>(i), all.end(), all[i]) - all.begin();
    colours.push_back({{static_cast<std::uint8_t>(all[i] >> 16), static_cast<std::uint8_t>(all[i] >> 8),
                        static_cast<std::uint8_t>(all[i])},
                       static_cast<double>(end - i)});
    i = end;
  }
  return colours;
}

using Mean = std::array<double, 3>;

// Colours [begin, end) of the list, and the channel of their largest spread.
struct Box {
  std::size_t begin, end;
  Mean mean{};
  int channel = 0;
  double error = 0;  // sum of squares along that channel
};

Box box_of(const std::vector<Counted>& colours, std::size_t begin, std::size_t end) {
  Box box{begin, end};
  double pixels = 0;
  Mean sum{}, squares{};
  for (std::size_t i = begin; i < end; ++i) {
    pixels += colours[i].pixels;
    for (int c = 0; c < 3; ++c) {
      const double v = colours[i].colour[c];
      sum[c] += colours[i].pixels * v;
      squares[c] += colours[i].pixels * v * v;
    }
  }
  for (int c = 0; c < 3; ++c) {
    box.mean[c] = sum[c] / pixels;
    const double error = end - begin == 1 ? 0 : squares[c] - sum[c] * sum[c] / pixels;
    if (error > box.error) {
      box.error = error;
      box.channel = c;
    }
  }
  return box;
}

std::vector<Mean> median_cut(std::vector<Counted>& colours, std::size_t most) {
  std::vector<Box> boxes{box_of(colours, 0, colours.size())};
  while (boxes.size() < most) {
    const auto worst = std::max_element(boxes.begin(), boxes.end(),
                                        [](const Box& a, const Box& b) { return a.error < b.error; });
    if (worst->error <= 0) break;
    const Box box = *worst;
    const auto first = colours.begin() + static_cast<std::ptrdiff_t>(box.begin),
               last = colours.begin() + static_cast<std::ptrdiff_t>(box.end);
    const auto middle = std::partition(
        first, last, [&](const Counted& c) { return c.colour[box.channel] <= box.mean[box.channel]; });
    const auto split = static_cast<std::size_t>(middle - colours.begin());
    if (split == box.begin || split == box.end) {  // one colour but for rounding
      worst->error = 0;
      continue;
    }
    *worst = box_of(colours, box.begin, split);
    boxes.push_back(box_of(colours, split, box.end));
  }
  std::vector<Mean> means;
  for (const Box& box : boxes) means.push_back(box.mean);
  return means;
}

std::size_t nearest(const std::vector<Mean>& means, const Rgb& colour) {
  std::size_t best = 0;
  double least = 1e30;
  for (std::size_t m = 0; m < means.size(); ++m) {
    const double r = means[m][0] - colour[0], g = means[m][1] - colour[1], b = means[m][2] - colour[2];
    const double distance = r * r + g * g + b * b;
    if (distance < least) {
      least = distance;
      best = m;
    }
  }
  return best;
}

// The palette entry of each colour, after moving each mean to the mean of the colours nearest to it.
std::vector<std::size_t> grouped(const std::vector<Counted>& colours, std::vector<Mean>& means) {
  std::vector<std::size_t> group(colours.size());
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Mean> sums(means.size(), Mean{});
    std::vector<double> pixels(means.size(), 0);
    for (std::size_t i = 0; i < colours.size(); ++i) {
      group[i] = nearest(means, colours[i].colour);
      pixels[group[i]] += colours[i].pixels;
      for (int c = 0; c < 3; ++c) sums[group[i]][c] += colours[i].pixels * colours[i].colour[c];
    }
    for (std::size_t m = 0; m < means.size(); ++m) {
      for (int c = 0; c < 3 && pixels[m] > 0; ++c) means[m][c] = sums[m][c] / pixels[m];
    }
  }
  return group;
}

// The most frequent colour of each group if more than half of its pixels have it, so that white paper and
// flat colours do not change; otherwise the group's mean.
std::vector<Rgb> palette(const std::vector<Counted>& colours, const std::vector<std::size_t>& group,
                         const std::vector<Mean>& means) {
  std::vector<double> pixels(means.size(), 0);
  std::vector<Counted> top(means.size(), Counted{{}, 0});
  for (std::size_t i = 0; i < colours.size(); ++i) {
    pixels[group[i]] += colours[i].pixels;
    if (colours[i].pixels > top[group[i]].pixels) top[group[i]] = colours[i];
  }
  std::vector<Rgb> palette(means.size());
  for (std::size_t m = 0; m < means.size(); ++m) {
    for (int c = 0; c < 3; ++c) palette[m][c] = static_cast<std::uint8_t>(means[m][c] + 0.5);
    if (2 * top[m].pixels > pixels[m]) palette[m] = top[m].colour;
  }
  return palette;
}

}  // namespace

Image with_few_colours(Image image, int most) {
  std::vector<Counted> colours = histogram(image);
  if (colours.size() <= static_cast<std::size_t>(most)) return image;
  std::vector<Mean> means = median_cut(colours, static_cast<std::size_t>(most));
  const std::vector<std::size_t> group = grouped(colours, means);
  const std::vector<Rgb> kept = palette(colours, group, means);
  std::vector<std::pair<Rgb, Rgb>> becomes;
  for (std::size_t i = 0; i < colours.size(); ++i) becomes.emplace_back(colours[i].colour, kept[group[i]]);
  std::sort(becomes.begin(), becomes.end());
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const Rgb colour{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
    const auto at = std::lower_bound(becomes.begin(), becomes.end(), colour,
                                     [](const auto& pair, const Rgb& c) { return pair.first < c; });
    std::copy(at->second.begin(), at->second.end(), image.rgb.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return image;
}

}  // namespace terrabench
