#include "experiments/cross/files/file_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "experiments/cross/files/temporary_folder.h"
#include "terrain/splitmix.h"

namespace terrabench::cross {
namespace {

using Setting = std::vector<double>;  // each in [0, 1]: the error to add, the resolution, the type's knobs

constexpr double kLeastError = 0x1p-14, kMostError = 0x1p-4;  // of the relief
constexpr double kCoarsest = 1.0 / 32;                        // of the ground's own resolution

double between(double low, double high, double at) {
  return low > 0 ? low * std::pow(high / low, at) : low + (high - low) * at;
}

// The inverse of between().
double place(double value, double low, double high) {
  return low > 0 ? std::log(std::max(value, low) / low) / std::log(high / low) : (value - low) / (high - low);
}

class Search {
 public:
  Search(const Scene& scene, const RepresentationType& type, Progress& progress)
      : scene_(scene), type_(type), progress_(progress), relief_(relief_of(scene)) {
    const auto& heights = scene.source.heights;
    columns_ = heights ? std::max(heights->width, heights->depth) : scene.options.resolution;
    samples_ = heights ? static_cast<double>(heights->heights.size())
                       : static_cast<double>(columns_) * static_cast<double>(columns_);
    for (const FileKnob& knob : type.file_knobs) {
      if (!heights || !knob.solids_only) knobs_.push_back(knob);
    }
  }

  const std::vector<FileKnob>& knobs() const { return knobs_; }

  // The type's own settings at the ground's own resolution, with metres to be added by encode() and by the
  // type.
  Setting own(double added, double built) const {
    const auto of_relief = [&](double metres, double low, double high) {
      return std::clamp(place(std::max(metres / relief_, low), low, high), 0.0, 1.0);
    };
    Setting at{of_relief(added, kLeastError, kMostError), 1};
    const Parameters fallback(type_.parameters);
    for (const FileKnob& knob : knobs_) {
      at.push_back(knob.of == FileKnob::kRelief ? of_relief(built / knob.error, knob.low, knob.high)
                                                : place_of_fallback(knob, fallback));
    }
    return at;
  }
  // What an error of interest is in metres: of a solid, about that share of its height.
  double metres(double aim) const { return scene_.source.heights ? aim : aim * relief_; }

  std::optional<BuiltFile> make(const Setting& at) const {
    BuiltFile file;
    file.within = between(kLeastError, kMostError, at[0]) * relief_;
    const auto columns = static_cast<std::int64_t>(std::lround(between(kCoarsest, 1, at[1]) * columns_));
    file.parameters =
        scene_.parameters(type_, columns < columns_ ? std::max<std::int64_t>(columns, 4) : std::int64_t{0});
    const double column = scene_.cell * static_cast<double>(columns_) / static_cast<double>(columns);
    for (std::size_t k = 0; k < knobs_.size(); ++k) set(knobs_[k], at[k + 2], column, file.parameters);
    try {
      const auto read = through_file(scene_, type_, file.parameters, file.within, file.bytes, progress_);
      const Differences found = top_and_volume_differences(*read, scene_.source, scene_.lines);
      // Errors of height leave out columns that the type lost or added.
      if (found.columns == 0 || (scene_.source.heights && found.lost_columns > 0)) return {};
      file.largest = found.largest;
      file.rmse = found.rmse;
      file.volume_error = 1 - found.volume_iou.value_or(1);
      return file;
    } catch (const Error& error) {
      if (!refuses(error)) throw;
      return {};
    }
  }

 private:
  double unit(const FileKnob& knob, double column) const {
    switch (knob.of) {
      case FileKnob::kRelief:
        return relief_;
      case FileKnob::kColumn:
        return column;
      case FileKnob::kSamples:
        return samples_;
      default:
        return 1;
    }
  }

  double place_of_fallback(const FileKnob& knob, const Parameters& fallback) const {
    const auto& specs = fallback.specs();
    const auto spec = std::ranges::find(specs, knob.parameter, &ParameterSpec::name);
    if (const bool* flag = std::get_if<bool>(&spec->fallback)) return *flag ? 1 : 0;
    if (std::holds_alternative<std::string>(spec->fallback)) return 0;  // the first of its choices
    const double number = std::holds_alternative<double>(spec->fallback)
                              ? std::get<double>(spec->fallback)
                              : static_cast<double>(std::get<std::int64_t>(spec->fallback));
    return std::clamp(place(number / unit(knob, scene_.cell), knob.low, knob.high), 0.0, 1.0);
  }

  void set(const FileKnob& knob, double at, double column, Parameters& parameters) const {
    const auto& specs = parameters.specs();
    const auto spec = std::ranges::find(specs, knob.parameter, &ParameterSpec::name);
    const double number = between(knob.low, knob.high, at) * unit(knob, column);
    const auto one_of = [&](std::size_t n) {
      return std::min(static_cast<std::size_t>(at * static_cast<double>(n)), n - 1);
    };
    if (std::holds_alternative<bool>(spec->fallback)) return parameters.set(knob.parameter, at >= 0.5);
    if (std::holds_alternative<std::string>(spec->fallback))
      return parameters.set(knob.parameter, std::string(spec->allowed[one_of(spec->allowed.size())]));
    if (std::holds_alternative<double>(spec->fallback))
      return parameters.set(knob.parameter, std::clamp(number, spec->lowest, spec->highest));
    parameters.set(knob.parameter,
                   static_cast<std::int64_t>(std::llround(std::clamp(number, spec->lowest, spec->highest))));
  }

  const Scene& scene_;
  const RepresentationType& type_;
  Progress& progress_;
  double relief_, samples_ = 0;
  std::int64_t columns_;
  std::vector<FileKnob> knobs_;
};

// Point k of a sequence that fills the cube evenly (Roberts 2018), the middle first.
Setting spread(std::size_t k, std::size_t dimensions) {
  double root = 2;  // of x^(d + 1) = x + 1
  for (int i = 0; i < 60; ++i) root = std::pow(1 + root, 1.0 / static_cast<double>(dimensions + 1));
  Setting at;
  for (std::size_t i = 0; i < dimensions; ++i) {
    const double x = 0.5 + static_cast<double>(k) * std::pow(root, -static_cast<double>(i + 1));
    at.push_back(x - std::floor(x));
  }
  return at;
}

struct Made {
  Setting at;
  BuiltFile file;
};

// The best of those made, as best_files().
std::vector<const Made*> best(const std::vector<Made>& all, FileError error) {
  std::vector<const Made*> order;
  for (const Made& made : all) order.push_back(&made);
  std::ranges::stable_sort(order, [&](const Made* a, const Made* b) {
    return a->file.bytes != b->file.bytes ? a->file.bytes < b->file.bytes : a->file.*error < b->file.*error;
  });
  double least = std::numeric_limits<double>::infinity();
  std::erase_if(order, [&](const Made* made) {
    const bool beaten = made->file.*error >= least;
    least = std::min(least, made->file.*error);
    return beaten;
  });
  return order;
}

class Variation {
 public:
  Variation(const std::vector<FileKnob>& knobs, std::uint64_t seed) : knobs_(knobs), random_(seed) {}

  // The one of the best files that is nearest to the aim, made finer or coarser by what it misses.
  Setting aim(std::vector<const Made*> best, const FileAim& aim) {
    const auto [nearest, coarser] =
        aim.of == FileAim::kBytes ? towards_bytes(best, aim) : towards_error(best, aim);
    Setting at = nearest->at;
    const bool near_enough = coarser > -0.02 && coarser < 0.05;
    if (near_enough || share() < 0.3) disturb(at, 0.3 * std::pow(0.05, share()));
    const auto move = [&](double& x, double log_range, double by) {
      x = std::clamp(x + by / log_range, 0.0, 1.0);
    };
    move(at[0], std::log(kMostError / kLeastError), coarser);
    if (coarser < 0) move(at[1], -std::log(kCoarsest), -0.5 * coarser);
    for (std::size_t k = 0; k < knobs_.size(); ++k) {
      const FileKnob& knob = knobs_[k];
      if (knob.of == FileKnob::kRelief) move(at[k + 2], std::log(knob.high / knob.low), coarser);
    }
    return at;
  }

 private:
  struct Step {
    const Made* nearest;
    double coarser;  // log of the factor of errors
  };

  // Files far below the error, such as those without any, say little about the settings.
  static Step towards_error(std::vector<const Made*>& best, const FileAim& aim) {
    const auto miss = [&](const Made* made) {
      return std::log(aim.most / std::max(made->file.*aim.error, 1e-3 * aim.most));
    };
    const auto far = [&](const Made* made) { return miss(made) > 2; };
    if (!std::ranges::all_of(best, far)) std::erase_if(best, far);
    const Made* const nearest =
        *std::ranges::min_element(best, {}, [&](const Made* m) { return std::abs(miss(m)); });
    return {nearest, miss(nearest) - 0.02};
  }

  // Turns the miss in bytes into a change of error, by the slope between the two files around the aim.
  static Step towards_bytes(const std::vector<const Made*>& best, const FileAim& aim) {
    const auto miss = [&](const Made* made) {
      return std::log(aim.most / static_cast<double>(made->file.bytes));
    };
    const auto nearest = std::ranges::min_element(best, {}, [&](const Made* m) { return std::abs(miss(m)); });
    const auto other = miss(*nearest) > 0 ? std::next(nearest) : nearest;  // the larger of the neighbours
    double errors_by_bytes = 1;
    if (other != best.begin() && other != best.end()) {
      const BuiltFile &larger = (*other)->file, &smaller = (*std::prev(other))->file;
      errors_by_bytes = std::log(smaller.*aim.error / std::max(larger.*aim.error, 1e-9)) /
                        std::log(static_cast<double>(larger.bytes) / static_cast<double>(smaller.bytes));
    }
    return {*nearest, -std::clamp(errors_by_bytes, 0.3, 3.0) * (miss(*nearest) - 0.01)};
  }

  double share() { return unit_of(random_.next()); }
  double normal() { return std::sqrt(-2 * std::log(1 - share())) * std::cos(2 * std::numbers::pi * share()); }
  void disturb(Setting& at, double spread) {
    for (std::size_t k = 0; k < at.size(); ++k) {
      const bool choice = k >= 2 && knobs_[k - 2].high == 0;
      if (choice && share() < spread) at[k] = share();
      if (!choice && share() < 0.6) at[k] = std::clamp(at[k] + spread * normal(), 0.0, 1.0);
    }
  }

  const std::vector<FileKnob>& knobs_;
  SplitMix random_;
};

}  // namespace

std::unique_ptr<Representation> through_file(const Scene& scene, const RepresentationType& type,
                                             const Parameters& parameters, double within, std::size_t& bytes,
                                             Progress& progress) {
  const auto built = type.build(scene.source, parameters, progress);
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "scratch";
  bytes = save_representation(path, type, *built, within);
  return load_representation(path).representation;
}

std::vector<BuiltFile> best_files(std::vector<BuiltFile> files, FileError error) {
  std::vector<Made> all;
  for (BuiltFile& file : files) all.push_back({{}, std::move(file)});
  std::vector<BuiltFile> front;
  for (const Made* made : best(all, error)) front.push_back(made->file);
  return front;
}

const BuiltFile* smallest_within(const std::vector<BuiltFile>& files, FileError error, double most) {
  const BuiltFile* found = nullptr;
  for (const BuiltFile& file : files) {
    if (file.*error <= most && (found == nullptr || file.bytes < found->bytes)) found = &file;
  }
  return found;
}

const BuiltFile* closest_within(const std::vector<BuiltFile>& files, FileError error, double most_bytes) {
  const BuiltFile* found = nullptr;
  for (const BuiltFile& file : files) {
    if (static_cast<double>(file.bytes) <= most_bytes && (found == nullptr || file.*error < found->*error))
      found = &file;
  }
  return found;
}

std::vector<BuiltFile> search_files(const Scene& scene, const RepresentationType& type, int builds,
                                    std::span<const FileAim> aims, Progress& progress) {
  Progress silent;  // each build is one step of the search
  const Search search(scene, type, silent);
  progress.begin(fmt::format("files of {}", type.name), static_cast<std::uint64_t>(builds));
  std::vector<FileAim> errors;
  std::ranges::copy_if(aims, std::back_inserter(errors),
                       [](FileAim aim) { return aim.of == FileAim::kError; });
  std::vector<Made> all;
  Variation variation(search.knobs(), scene.options.seed);
  for (std::size_t k = 0, aimed = 0; k < static_cast<std::size_t>(builds); ++k) {
    const auto next = [&]() -> Setting {
      const std::size_t evenly = (static_cast<std::size_t>(builds) + 3) / 4;
      if (k < evenly) return spread(k, 2 + search.knobs().size());
      if (k < evenly + 2 * errors.size()) {
        const double metres = search.metres(errors[(k - evenly) / 2].most),
                     built = (k - evenly) % 2 == 0 ? 0.05 : 0.6;
        return search.own((1 - built) * metres, built * metres);
      }
      if (all.empty()) return spread(k, 2 + search.knobs().size());
      const FileAim& aim = aims[aimed++ % aims.size()];
      return variation.aim(best(all, aim.error), aim);
    };
    const Setting at = next();
    if (std::optional<BuiltFile> file = search.make(at)) all.push_back({at, std::move(*file)});
    progress.advance();
  }
  std::vector<BuiltFile> files;
  for (Made& made : all) files.push_back(std::move(made.file));
  return files;
}

}  // namespace terrabench::cross
