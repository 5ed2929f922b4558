#include "terrain/metrics/image_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::size_t kWindow = 11;
constexpr double kSigma = 1.5;

void require_same_size(const Image& a, const Image& b) {
  if (a.width == b.width && a.height == b.height && a.width > 0 && a.height > 0) return;
  throw usage_error(fmt::format("images must have the same size, got {} × {} and {} × {} pixels", a.width,
                                a.height, b.width, b.height),
                    "", "render both at the same size");
}

// Row y of the luma into `to`, which holds a value per pixel of the row.
void luma_row(const Image& image, std::size_t y, std::span<double> to) {
  const std::uint8_t* from = image.rgb.data() + 3 * y * to.size();
  for (double& luma : to) {
    luma = 0.299 * from[0] + 0.587 * from[1] + 0.114 * from[2];
    from += 3;
  }
}

// Weights of a window along an axis of n pixels, with sum 1: Gaussian, or equal and as many as the axis has
// pixels when that is less than a whole window.
std::vector<double> window_of(std::size_t n) {
  if (n < kWindow) return std::vector<double>(n, 1.0 / static_cast<double>(n));
  std::vector<double> weights(kWindow);
  double sum = 0;
  for (std::size_t k = 0; k < kWindow; ++k) {
    const double d = static_cast<double>(k) - static_cast<double>(kWindow / 2);
    sum += weights[k] = std::exp(-d * d / (2 * kSigma * kSigma));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// The weighted means of a row of windows: value(k, x) is pixel x of the windows' row k. Separable, columns
// first.
class RowOfWindows {
 public:
  RowOfWindows(std::size_t width, std::size_t height)
      : across_(window_of(width)),
        down_(window_of(height)),
        half_(width),
        means_(width - across_.size() + 1) {}

  std::size_t height() const { return down_.size(); }
  std::size_t count() const { return means_.size(); }

  template <class Value>
  std::vector<double> means(const Value& value) {
    std::ranges::fill(half_, 0.0);
    std::ranges::fill(means_, 0.0);
    for (std::size_t k = 0; k < down_.size(); ++k) {
      for (std::size_t x = 0; x < half_.size(); ++x) half_[x] += down_[k] * value(k, x);
    }
    for (std::size_t k = 0; k < across_.size(); ++k) {
      for (std::size_t x = 0; x < means_.size(); ++x) means_[x] += across_[k] * half_[x + k];
    }
    return means_;
  }

 private:
  std::vector<double> across_, down_, half_, means_;
};

}  // namespace

double psnr(const Image& a, const Image& b) {
  require_same_size(a, b);
  double sum = 0;
  for (std::size_t k = 0; k < a.rgb.size(); ++k) {
    const double d = static_cast<double>(a.rgb[k]) - b.rgb[k];
    sum += d * d;
  }
  if (sum == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.rgb.size()) / sum);
}

std::size_t differing_pixels(const Image& a, const Image& b) {
  require_same_size(a, b);
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.rgb.size(); k += 3) {
    count += a.rgb[k] != b.rgb[k] || a.rgb[k + 1] != b.rgb[k + 1] || a.rgb[k + 2] != b.rgb[k + 2] ? 1 : 0;
  }
  return count;
}

double ssim(const Image& a, const Image& b) {
  require_same_size(a, b);
  constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
  const auto width = static_cast<std::size_t>(a.width), height = static_cast<std::size_t>(a.height);
  RowOfWindows row(width, height);
  // The rows of luma that the windows cover: y lies at y modulo their number.
  const std::size_t rows = row.height();
  std::vector<double> luma_a(rows * width), luma_b(rows * width);
  double sum = 0;
  for (std::size_t bottom = 0; bottom < height; ++bottom) {
    luma_row(a, bottom, std::span(luma_a).subspan(bottom % rows * width, width));
    luma_row(b, bottom, std::span(luma_b).subspan(bottom % rows * width, width));
    if (bottom + 1 < rows) continue;
    const auto x = [&](std::size_t k, std::size_t i) { return luma_a[(bottom + 1 + k) % rows * width + i]; };
    const auto y = [&](std::size_t k, std::size_t i) { return luma_b[(bottom + 1 + k) % rows * width + i]; };
    const std::vector<double> mx = row.means(x), my = row.means(y);
    const auto mxx = row.means([&](std::size_t k, std::size_t i) { return x(k, i) * x(k, i); });
    const auto myy = row.means([&](std::size_t k, std::size_t i) { return y(k, i) * y(k, i); });
    const auto mxy = row.means([&](std::size_t k, std::size_t i) { return x(k, i) * y(k, i); });
    for (std::size_t k = 0; k < mx.size(); ++k) {
      const double var_x = mxx[k] - mx[k] * mx[k], var_y = myy[k] - my[k] * my[k];
      const double covariance = mxy[k] - mx[k] * my[k];
      sum += (2 * mx[k] * my[k] + kC1) * (2 * covariance + kC2) /
             ((mx[k] * mx[k] + my[k] * my[k] + kC1) * (var_x + var_y + kC2));
    }
  }
  return sum / static_cast<double>(row.count() * (height - rows + 1));
}

}  // namespace terrabench
