#include "experiments/cross/representations/ground_lines.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "representations/line_grid.h"
#include "terrain/metrics/nearest_point.h"
#include "terrain/splitmix.h"

namespace terrabench::cross {
namespace {

constexpr int kSamplesPerStep = 4;  // of solids, along a line
constexpr int kFiner = 16;          // samples between two of them that differ

double length(std::span<const Part> parts) {
  double sum = 0;
  for (const Part& part : parts) sum += static_cast<double>(part.top) - part.bottom;
  return sum;
}

// Runs `row(j, out)` for all rows in parallel and joins what they append, in order.
template <class Row>
LineParts in_rows(int depth, const Row& row) {
  std::vector<LineParts> rows(static_cast<std::size_t>(depth));
  tbb::parallel_for(0, depth, [&](int j) { row(j, rows[static_cast<std::size_t>(j)]); });
  LineParts all;
  for (const LineParts& one : rows) all.append(one);
  return all;
}

void sample_solid(const Solid& solid, float x, float z, float step, LineParts& out) {
  thread_local std::vector<Material> column;
  const Bounds& bounds = solid.bounds;
  const int n = std::max(1, static_cast<int>(std::lround(kSamplesPerStep * bounds.size().y / step)));
  const float dy = bounds.size().y / static_cast<float>(n);
  const auto height = [&](float k) { return bounds.low.y + k * dy; };
  column.resize(static_cast<std::size_t>(n));
  solid.column({x, z, height(0.5F), dy}, column);
  const auto add = [&](float k, float thick) { out.add({height(k), height(k + thick)}); };
  const auto is_solid = [&](int k) { return column[static_cast<std::size_t>(k)] != Material::kAir; };
  if (is_solid(0)) add(0, 0.5F);
  for (int k = 0; k + 1 < n; ++k) {
    const float from = static_cast<float>(k) + 0.5F;
    if (is_solid(k) && is_solid(k + 1)) {
      add(from, 1);
    } else if (is_solid(k) != is_solid(k + 1)) {
      std::array<Material, kFiner> between{};
      solid.column({x, z, height(from + 0.5F / kFiner), dy / kFiner}, between);
      for (std::size_t i = 0; i < between.size(); ++i) {
        if (between[i] != Material::kAir) add(from + static_cast<float>(i) / kFiner, 1.0F / kFiner);
      }
    }
  }
  if (is_solid(n - 1)) add(static_cast<float>(n) - 0.5F, 0.5F);
  out.end_line();
}

// Air below the top of a line, from `low` up.
std::vector<Part> cavities(std::span<const Part> solid, float low) {
  std::vector<Part> gaps;
  float from = low;
  for (const Part& part : solid) {
    if (part.bottom > from) gaps.push_back({from, part.bottom});
    from = part.top;
  }
  return gaps;
}

LineParts all_cavities(const LineParts& parts, float low) {
  LineParts all;
  for (std::size_t c = 0; c < parts.lines(); ++c) {
    for (const Part& gap : cavities(parts.line(c), low)) all.add(gap);
    all.end_line();
  }
  return all;
}

// The walls between two neighbouring lines: where exactly one of the two is solid. use(first, low, high) says
// whether it is the first one.
template <class Use>
void for_each_wall(std::span<const Part> a, std::span<const Part> b, const Use& use) {
  const auto solid = [](std::span<const Part> line, float y) {
    return std::ranges::any_of(line, [&](const Part& part) { return part.bottom <= y && y < part.top; });
  };
  std::vector<float> ends;
  for (const auto& line : {a, b}) {
    for (const Part& part : line) {
      ends.push_back(part.bottom);
      ends.push_back(part.top);
    }
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
    if (ends[k] < ends[k + 1]) use(solid(a, ends[k]), ends[k], ends[k + 1]);
  }
}

// Points on the surface: where lines enter and leave the solid, and on the walls between neighbouring lines,
// up to a step apart. A wall's points lie on its solid line, so that they vanish into that line's own ends as
// the wall gets lower.
std::vector<SpacePoint> surface_points(const GroundLines& at, const LineParts& parts) {
  std::vector<SpacePoint> points;
  const double step = at.step, lowest = at.bounds.low.y;
  const auto walls = [&](std::size_t c, std::size_t next) {
    for_each_wall(parts.line(c), parts.line(next), [&](bool first, float low, float high) {
      const std::size_t on = first ? c : next;
      points.push_back({at.x[on], low, at.z[on]});
      for (double y = lowest + step * std::ceil((low - lowest) / step); y < high; y += step) {
        points.push_back({at.x[on], y, at.z[on]});
      }
    });
  };
  for (int j = 0; j < at.depth; ++j) {
    for (int i = 0; i < at.width; ++i) {
      const std::size_t c = at.index(i, j);
      for (const Part& part : parts.line(c)) {
        if (part.bottom > lowest + 0.5 * step) points.push_back({at.x[c], part.bottom, at.z[c]});
        points.push_back({at.x[c], part.top, at.z[c]});
      }
      if (i + 1 < at.width) walls(c, c + 1);
      if (j + 1 < at.depth) walls(c, c + static_cast<std::size_t>(at.width));
    }
  }
  return points;
}

double farthest(const std::vector<SpacePoint>& from, const NearestPoint& to) {
  constexpr std::size_t kBlock = 4096;
  std::vector<double> largest((from.size() + kBlock - 1) / kBlock);
  tbb::parallel_for(std::size_t{0}, largest.size(), [&](std::size_t b) {
    for (std::size_t p = b * kBlock; p < std::min(from.size(), (b + 1) * kBlock); ++p) {
      largest[b] = std::max(largest[b], to.squared_distance(from[p]));
    }
  });
  return largest.empty() ? 0 : std::sqrt(*std::max_element(largest.begin(), largest.end()));
}

void compare_surfaces(const GroundLines& ground, const LineParts& built, Differences& found) {
  const std::vector<SpacePoint> a = surface_points(ground, ground.parts), b = surface_points(ground, built);
  if (a.empty() || b.empty()) return;
  found.distance = {farthest(a, NearestPoint(b)), farthest(b, NearestPoint(a))};
}

void compare_tops(std::vector<double> errors, Differences& found) {
  found.columns = errors.size();
  if (errors.empty()) return;
  double squares = 0;
  for (const double e : errors) squares += e * e;
  found.rmse = std::sqrt(squares / static_cast<double>(errors.size()));
  for (double& e : errors) e = std::abs(e);
  const std::size_t rank = (99 * errors.size() + 99) / 100 - 1;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank), errors.end());
  found.p99 = errors[rank];
  found.largest = *std::max_element(errors.begin() + static_cast<std::ptrdiff_t>(rank), errors.end());
}

void compare_tops(const Representation& built, const Heightfield& field, Differences& found) {
  std::vector<float> tops(field.heights.size());
  topmost(built, lines_of(field), 0, tops);
  std::vector<double> errors;
  for (std::size_t c = 0; c < tops.size(); ++c) {
    const bool lacking = Heightfield::is_no_data(field.heights[c]), empty = Heightfield::is_no_data(tops[c]);
    found.lost_columns += lacking != empty;
    if (!lacking && !empty) errors.push_back(static_cast<double>(tops[c]) - field.heights[c]);
  }
  compare_tops(std::move(errors), found);
}

void compare_tops(const GroundLines& ground, const LineParts& built, Differences& found) {
  std::vector<double> errors;
  for (std::size_t c = 0; c < built.lines(); ++c) {
    const auto a = ground.parts.line(c), b = built.line(c);
    found.lost_columns += a.empty() != b.empty();
    if (!a.empty() && !b.empty()) errors.push_back(static_cast<double>(b.back().top) - a.back().top);
  }
  compare_tops(std::move(errors), found);
}

// The cavities of a line without what is near a solid part of any line within the margin.
std::vector<Part> core(const GroundLines& ground, int i, int j, float margin) {
  const auto line = [&](int a, int b) { return ground.parts.line(ground.index(a, b)); };
  std::vector<Part> left = cavities(line(i, j), ground.bounds.low.y);
  const int reach = static_cast<int>(std::ceil(margin / ground.step));
  for (int b = std::max(0, j - reach); b <= std::min(ground.depth - 1, j + reach) && !left.empty(); ++b) {
    for (int a = std::max(0, i - reach); a <= std::min(ground.width - 1, i + reach); ++a) {
      left = without(left, line(a, b), margin);
    }
  }
  return left;
}

void compare_cavities(const GroundLines& ground, const LineParts& built, float margin, Differences& found) {
  const double area = static_cast<double>(ground.step) * ground.step;
  std::vector<Differences> rows(static_cast<std::size_t>(ground.depth));
  tbb::parallel_for(0, ground.depth, [&](int j) {
    Differences& row = rows[static_cast<std::size_t>(j)];
    for (int i = 0; i < ground.width; ++i) {
      const std::size_t c = ground.index(i, j);
      const std::vector<Part> gaps = cavities(ground.parts.line(c), ground.bounds.low.y);
      if (gaps.empty()) continue;
      const std::vector<Part> deep = core(ground, i, j, margin);
      row.cavities += area * length(gaps);
      row.cavities_filled += area * overlap(gaps, built.line(c));
      row.cores += area * length(deep);
      row.cores_filled += area * overlap(deep, built.line(c));
    }
  });
  for (const Differences& row : rows) {  // in order: the same sum for any number of threads
    found.cavities += row.cavities;
    found.cavities_filled += row.cavities_filled;
    found.cores += row.cores;
    found.cores_filled += row.cores_filled;
  }
}

std::optional<double> iou(const LineParts& a, const LineParts& b) {
  double both = 0, either = 0;
  for (std::size_t c = 0; c < a.lines(); ++c) {
    const double shared = overlap(a.line(c), b.line(c));
    both += shared;
    either += length(a.line(c)) + length(b.line(c)) - shared;
  }
  return either > 0 ? std::optional(both / either) : std::nullopt;
}

Differences tops_and_volume(const Representation& built, const TerrainSource& source,
                            const GroundLines& ground, const LineParts& parts) {
  Differences found;
  if (source.heights) {
    compare_tops(built, *source.heights, found);
  } else {
    compare_tops(ground, parts, found);
  }
  found.volume_iou = iou(ground.parts, parts);
  return found;
}

// A square per line, the line at its middle.
GroundLines squares(const TerrainSource& source, int along) {
  GroundLines lines;
  lines.bounds = source.bounds();
  const glm::vec3 low = lines.bounds.low, size = lines.bounds.size();
  lines.step = std::max(size.x, size.z) / static_cast<float>(along);
  lines.width = std::max(1, static_cast<int>(size.x / lines.step + 1e-3F));
  lines.depth = std::max(1, static_cast<int>(size.z / lines.step + 1e-3F));
  for (int j = 0; j < lines.depth; ++j) {
    for (int i = 0; i < lines.width; ++i) {
      lines.x.push_back(low.x + (static_cast<float>(i) + 0.5F) * lines.step);
      lines.z.push_back(low.z + (static_cast<float>(j) + 0.5F) * lines.step);
    }
  }
  return lines;
}

LineParts ground_parts(const TerrainSource& source, const GroundLines& lines) {
  const float low = lines.bounds.low.y;
  return in_rows(lines.depth, [&](int j, LineParts& out) {
    for (int i = 0; i < lines.width; ++i) {
      const std::size_t c = lines.index(i, j);
      if (source.solid) {
        sample_solid(*source.solid, lines.x[c], lines.z[c], lines.step, out);
        continue;
      }
      const float height = source.heights->sample(lines.x[c], lines.z[c]);
      if (height > low) out.add({low, height});
      out.end_line();
    }
  });
}

}  // namespace

void LineParts::add(Part part) {
  const std::size_t first = ends_.empty() ? 0 : ends_.back();
  if (parts_.size() > first && !(parts_.back().top < part.bottom)) {
    parts_.back().top = std::max(parts_.back().top, part.top);
  } else {
    parts_.push_back(part);
  }
}

void LineParts::append(const LineParts& more) {
  const auto before = static_cast<std::uint32_t>(parts_.size());
  parts_.insert(parts_.end(), more.parts_.begin(), more.parts_.end());
  for (const std::uint32_t end : more.ends_) ends_.push_back(before + end);
}

double overlap(std::span<const Part> a, std::span<const Part> b) {
  double sum = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const float low = std::max(a[i].bottom, b[j].bottom), high = std::min(a[i].top, b[j].top);
    if (high > low) sum += static_cast<double>(high) - low;
    if (a[i].top < b[j].top) {
      ++i;
    } else {
      ++j;
    }
  }
  return sum;
}

std::vector<Part> without(std::span<const Part> from, std::span<const Part> removed, float margin) {
  std::vector<Part> left;
  for (Part part : from) {
    for (const Part& r : removed) {
      const float low = r.bottom - margin, high = r.top + margin;
      if (high <= part.bottom || low >= part.top) continue;
      if (low > part.bottom) left.push_back({part.bottom, low});
      part.bottom = std::max(part.bottom, high);
      if (part.bottom >= part.top) break;
    }
    if (part.bottom < part.top) left.push_back(part);
  }
  return left;
}

GroundLines ground_lines(const TerrainSource& source, int along) {
  GroundLines lines = squares(source, along);
  lines.parts = ground_parts(source, lines);
  return lines;
}

GroundLines random_lines(const TerrainSource& source, int along, std::uint64_t seed) {
  GroundLines lines = squares(source, along);
  SplitMix random(seed);
  const float most = 0.99F * lines.step;  // rounding keeps them within the ground
  for (std::vector<float>* const places : {&lines.x, &lines.z}) {
    for (float& place : *places) place += static_cast<float>(unit_of(random.next()) - 0.5) * most;
  }
  lines.parts = ground_parts(source, lines);
  return lines;
}

LineParts lines_of(const Representation& built, const GroundLines& at) {
  const auto width = static_cast<std::size_t>(at.width);
  return in_rows(at.depth, [&](int j, LineParts& out) {
    thread_local SpanSink sink;
    sink.clear();
    const std::size_t first = static_cast<std::size_t>(j) * width;
    built.spans({std::span(at.x).subspan(first, width), std::span(at.z).subspan(first, width)}, sink);
    for (std::size_t i = 0; i < width; ++i) {
      for (const Span& span : sink.column(i)) {
        const Part part{std::max(span.bottom, at.bounds.low.y), std::min(span.top, at.bounds.high.y)};
        if (part.bottom < part.top) out.add(part);
      }
      out.end_line();
    }
  });
}

VolumeErrors volume_errors(const Representation& built, const GroundLines& ground) {
  const LineParts parts = lines_of(built, ground);
  const auto error = [](const LineParts& a, const LineParts& b) { return 1 - iou(a, b).value_or(1); };
  const float low = ground.bounds.low.y;
  return {error(ground.parts, parts), error(all_cavities(ground.parts, low), all_cavities(parts, low))};
}

Differences top_and_volume_differences(const Representation& built, const TerrainSource& source,
                                       const GroundLines& ground) {
  return tops_and_volume(built, source, ground, lines_of(built, ground));
}

Differences differences(const Representation& built, const TerrainSource& source, const GroundLines& ground,
                        float margin) {
  const LineParts parts = lines_of(built, ground);
  Differences found = tops_and_volume(built, source, ground, parts);
  compare_surfaces(ground, parts, found);
  compare_cavities(ground, parts, margin, found);
  return found;
}

}  // namespace terrabench::cross
