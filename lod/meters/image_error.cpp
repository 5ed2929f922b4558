#include "lod/meters/image_error.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr int kWindow = 11;
constexpr double kSigma = 1.5;

void require_same_size(const Image& a, const Image& b) {
  if (a.width == b.width && a.height == b.height && a.width > 0 && a.height > 0) return;
  throw usage_error(fmt::format("images must have the same size, got {} × {} and {} × {} pixels", a.width,
                                a.height, b.width, b.height),
                    "", "render both at the same size");
}

std::vector<double> luma_of(const Image& image) {
  std::vector<double> luma(image.rgb.size() / 3);
  for (std::size_t k = 0; k < luma.size(); ++k) {
    luma[k] = 0.299 * image.rgb[3 * k] + 0.587 * image.rgb[3 * k + 1] + 0.114 * image.rgb[3 * k + 2];
  }
  return luma;
}

// Weights of a window of n pixels, with sum 1: Gaussian, or equal when n is less than a whole window.
std::vector<double> window_of(int n) {
  std::vector<double> weights(static_cast<std::size_t>(n), 1.0 / n);
  if (n < kWindow) return weights;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double d = k - n / 2;
    sum += weights[static_cast<std::size_t>(k)] = std::exp(-d * d / (2 * kSigma * kSigma));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Weighted means of value(k) over every window; separable, columns first.
template <class Value>
std::vector<double> windowed(int width, int height, const Value& value) {
  const std::vector<double> across = window_of(std::min(width, kWindow));
  const std::vector<double> down = window_of(std::min(height, kWindow));
  const std::size_t w = static_cast<std::size_t>(width), out_w = w - across.size() + 1;
  const std::size_t out_h = static_cast<std::size_t>(height) - down.size() + 1;
  std::vector<double> half(w * out_h, 0.0), means(out_w * out_h, 0.0);
  for (std::size_t y = 0; y < out_h; ++y) {
    for (std::size_t k = 0; k < down.size(); ++k) {
      for (std::size_t x = 0; x < w; ++x) half[y * w + x] += down[k] * value((y + k) * w + x);
    }
    for (std::size_t k = 0; k < across.size(); ++k) {
      for (std::size_t x = 0; x < out_w; ++x) means[y * out_w + x] += across[k] * half[y * w + x + k];
    }
  }
  return means;
}

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

double ssim(const Image& a, const Image& b) {
  require_same_size(a, b);
  constexpr double kC1 = (0.01 * 255) * (0.01 * 255), kC2 = (0.03 * 255) * (0.03 * 255);
  const std::vector<double> x = luma_of(a), y = luma_of(b);
  const auto means = [&](const auto& value) { return windowed(a.width, a.height, value); };
  const std::vector<double> mx = means([&](std::size_t k) { return x[k]; });
  const std::vector<double> my = means([&](std::size_t k) { return y[k]; });
  const std::vector<double> mxx = means([&](std::size_t k) { return x[k] * x[k]; });
  const std::vector<double> myy = means([&](std::size_t k) { return y[k] * y[k]; });
  const std::vector<double> mxy = means([&](std::size_t k) { return x[k] * y[k]; });
  double sum = 0;
  for (std::size_t k = 0; k < mx.size(); ++k) {
    const double var_x = mxx[k] - mx[k] * mx[k], var_y = myy[k] - my[k] * my[k];
    const double covariance = mxy[k] - mx[k] * my[k];
    sum += (2 * mx[k] * my[k] + kC1) * (2 * covariance + kC2) /
           ((mx[k] * mx[k] + my[k] * my[k] + kC1) * (var_x + var_y + kC2));
  }
  return sum / static_cast<double>(mx.size());
}

}  // namespace terrabench
