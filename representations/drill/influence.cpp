// An influence for every drill (Stuetzle & Franklin 2012, §4.1).
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "representations/drill/extract.h"
#include "representations/drill/regenerate.h"

namespace terrabench {
namespace {

std::vector<int> candidates(int most) {
  std::vector<int> list;
  for (int k = 2; k < most; k += std::max(1, k / 4)) list.push_back(k);
  list.push_back(most);
  return list;
}

// sums[(j + 1)·(width + 1) + i + 1]: the squared errors of all pixels up to column i and row j.
class ErrorSums {
 public:
  explicit ErrorSums(const Heightfield& truth)
      : truth_(truth),
        stride_(static_cast<std::size_t>(truth.width) + 1),
        sums_(stride_ * (static_cast<std::size_t>(truth.depth) + 1)) {}

  void update(const std::vector<float>& heights) {
    const auto width = static_cast<std::size_t>(truth_.width), depth = static_cast<std::size_t>(truth_.depth);
    tbb::parallel_for(std::size_t{0}, depth, [&](std::size_t j) {
      double sum = 0;
      for (std::size_t i = 0; i < width; ++i) {
        const double error = static_cast<double>(heights[j * width + i]) - truth_.heights[j * width + i];
        if (error == error) sum += error * error;
        sums_[(j + 1) * stride_ + i + 1] = sum;
      }
    });
    for (std::size_t j = 1; j <= depth; ++j) {
      for (std::size_t i = 1; i <= width; ++i) sums_[j * stride_ + i] += sums_[(j - 1) * stride_ + i];
    }
  }

  double around(std::uint32_t pixel, int reach) const {
    const int x = static_cast<int>(pixel) % truth_.width, z = static_cast<int>(pixel) / truth_.width;
    const auto left = static_cast<std::size_t>(std::max(x - reach, 0)),
               right = static_cast<std::size_t>(std::min(x + reach + 1, truth_.width));
    const std::size_t top = static_cast<std::size_t>(std::max(z - reach, 0)) * stride_,
                      bottom = static_cast<std::size_t>(std::min(z + reach + 1, truth_.depth)) * stride_;
    return sums_[bottom + right] - sums_[bottom + left] - sums_[top + right] + sums_[top + left];
  }

 private:
  const Heightfield& truth_;
  std::size_t stride_;
  std::vector<double> sums_;
};

}  // namespace

void choose_influence(const Heightfield& field, Drills& drills, Progress* progress) {
  const int most = drills.k;
  const std::vector<int> list = candidates(most);
  if (progress != nullptr) progress->begin("influence of each drill", list.size());
  drills.influence.clear();
  std::vector<float> heights(drills.pixels());
  std::vector<double> least(drills.count(), std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> chosen(drills.count());
  ErrorSums sums(field);
  for (const int k : list) {
    drills.k = k;
    regenerate(drills, heights);
    sums.update(heights);
    tbb::parallel_for(std::size_t{0}, drills.count(), [&](std::size_t i) {
      const double error = sums.around(drills.pixel[i], most);
      if (error >= least[i]) return;
      least[i] = error;
      chosen[i] = static_cast<std::uint8_t>(k);
    });
    if (progress != nullptr) progress->advance();
  }
  drills.influence = std::move(chosen);
  drills.k = most;
}

}  // namespace terrabench
