#include "representations/layered_stack/thermal_erosion.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "terrain/error.h"

namespace terrabench {
namespace {

// One row of columns, the solid runs alone.
struct Row {
  std::vector<std::uint32_t> starts{0};
  std::vector<Run> runs;

  std::span<const Run> column(int i) const {
    return std::span(runs).subspan(starts[i], starts[i + 1] - starts[i]);
  }
  void clear() {
    starts.assign(1, 0);
    runs.clear();
  }
  void add(const Run& run) {  // joined with what it touches in this column
    if (runs.size() > starts.back() && runs.back().top == run.bottom &&
        runs.back().material == run.material) {
      runs.back().top = run.top;
    } else {
      runs.push_back(run);
    }
  }
  void end_column() { starts.push_back(static_cast<std::uint32_t>(runs.size())); }
  void add_column(std::span<const Run> column) {
    runs.insert(runs.end(), column.begin(), column.end());
    end_column();
  }
};

// One column while material moves: its open surfaces, bottom up, each the top of a solid stretch. The lowest
// is that of the ground, or the terrain's floor. What landed on a surface is a list from its top down.
class Pile {
 public:
  struct Surface {
    int base, floor, ceiling;  // levels: solid in [base, floor), air in [floor, ceiling)
    std::size_t first, end;    // the stretch's runs
    int landed;                // the topmost deposit, -1: none
  };

  void read(std::span<const Run> column) {
    runs_.assign(column.begin(), column.end());
    deposits_.clear();
    surfaces_.clear();
    surfaces_.push_back({0, 0, kOpen, 0, 0, -1});
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      if (runs_[r].bottom > surfaces_.back().floor) {
        surfaces_.back().ceiling = runs_[r].bottom;
        surfaces_.push_back({runs_[r].bottom, runs_[r].bottom, kOpen, r, r, -1});
      }
      surfaces_.back().floor = runs_[r].top;
      surfaces_.back().end = r + 1;
    }
  }

  const std::vector<Surface>& surfaces() const { return surfaces_; }

  // Takes `levels` off surface s and drops them on surface t of the other. True if the stretch is used up; it
  // is then gone, so that the surfaces above it count one less.
  bool slide(std::size_t s, int levels, Pile& other, std::size_t t) {
    Surface& from = surfaces_[s];
    from.floor -= levels;
    while (levels > 0) {
      if (from.landed >= 0) {
        Deposit& top = deposits_[static_cast<std::size_t>(from.landed)];
        const int taken = std::min(levels, top.levels);
        other.land(t, taken, top.material);
        levels -= taken;
        top.levels -= taken;
        if (top.levels == 0) from.landed = top.below;
      } else {
        Run& top = runs_[from.end - 1];
        const int taken = std::min(levels, top.top - top.bottom);
        other.land(t, taken, top.material);
        levels -= taken;
        top.top = static_cast<std::uint16_t>(top.top - taken);
        if (top.top == top.bottom) --from.end;
      }
    }
    if (s == 0 || from.floor > from.base) return false;
    surfaces_[s - 1].ceiling = from.ceiling;
    surfaces_.erase(surfaces_.begin() + static_cast<std::ptrdiff_t>(s));
    return true;
  }

  void write(Row& out) {
    for (const Surface& surface : surfaces_) {
      int top = surface.base;
      for (std::size_t r = surface.first; r < surface.end; ++r) {
        out.add(runs_[r]);
        top = runs_[r].top;
      }
      order_.clear();
      for (int d = surface.landed; d >= 0; d = deposits_[static_cast<std::size_t>(d)].below) {
        order_.push_back(d);
      }
      for (auto d = order_.rbegin(); d != order_.rend(); ++d) {
        const Deposit& deposit = deposits_[static_cast<std::size_t>(*d)];
        out.add({static_cast<std::uint16_t>(top), static_cast<std::uint16_t>(top + deposit.levels),
                 deposit.material});
        top += deposit.levels;
      }
    }
    out.end_column();
  }

 private:
  static constexpr int kOpen = std::numeric_limits<int>::max();
  struct Deposit {
    int levels, below;
    Material material;
  };

  void land(std::size_t t, int levels, Material material) {
    Surface& surface = surfaces_[t];
    surface.floor += levels;
    deposits_.push_back({levels, surface.landed, material});
    surface.landed = static_cast<int>(deposits_.size()) - 1;
  }

  std::vector<Run> runs_;
  std::vector<Deposit> deposits_;
  std::vector<Surface> surfaces_;
  std::vector<int> order_;
};

// From every surface of `from` to the highest surface of `to` below it that is open beside its topmost level.
// A move of m levels leaves a difference of at least `allowed` - 1 ≥ 0: what moves passes through air alone,
// and never comes back.
std::int64_t slide_over(Pile& from, Pile& to, int allowed, double share) {
  std::int64_t moved = 0;
  for (std::size_t s = 0, t = 0; s < from.surfaces().size();) {
    const Pile::Surface& source = from.surfaces()[s];
    while (t + 1 < to.surfaces().size() && to.surfaces()[t + 1].floor < source.floor) ++t;
    const Pile::Surface& target = to.surfaces()[t];
    const int excess = source.floor - target.floor - allowed;
    if (excess <= 0 || target.ceiling < source.floor) {
      ++s;
      continue;
    }
    const int levels = std::min(static_cast<int>(std::ceil(share * excess / 2)), source.floor - source.base);
    moved += levels;
    if (!from.slide(s, levels, to, t)) ++s;
  }
  return moved;
}

struct Scratch {
  Pile a, b;
  Row row, next;
};

class Eroder {
 public:
  Eroder(const LayeredStack& stack, const ThermalErosionOptions& options)
      : stack_(stack),
        width_(stack.grid().width),
        depth_(stack.grid().depth),
        share_(options.share),
        rows_(static_cast<std::size_t>(depth_)),
        versions_(rows_.size(), 0),
        rested_along_(rows_.size(), kNever),
        rested_across_(rows_.size(), kNever) {
    const ColumnGrid& grid = stack.grid();
    const double slope = std::tan(options.talus * std::numbers::pi / 180);
    const auto allowed = [&](double distance) {
      // A slope meant to be a whole number of levels must not lose one to rounding.
      const double levels = slope * distance / grid.step * (1 + 1e-9);
      return static_cast<int>(std::clamp(std::floor(levels), 1.0, static_cast<double>(grid.levels)));
    };
    along_ = allowed(grid.cell_x);
    across_ = allowed(grid.cell_z);
    diagonal_ = allowed(std::hypot(grid.cell_x, grid.cell_z));
    tbb::parallel_for(0, depth_, [&](int j) { read(j, rows_[static_cast<std::size_t>(j)]); });
  }

  // Every pair of neighbours once. Returns the levels moved.
  std::int64_t step() {
    std::atomic<std::int64_t> moved = 0;
    tbb::parallel_for(0, depth_, [&](int j) { moved += slide_along(static_cast<std::size_t>(j)); });
    for (const int odd : {0, 1}) {
      tbb::parallel_for(0, (depth_ - odd) / 2,
                        [&](int pair) { moved += slide_across(static_cast<std::size_t>(2 * pair + odd)); });
    }
    return moved;
  }

  // Writes the columns that changed; returns their number.
  std::size_t write(Representation& edited) const;

 private:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

  void read(int j, Row& row) const {
    row.clear();
    for (int i = 0; i < width_; ++i) {
      stack_.column(i, j).each_solid([&](std::uint16_t bottom, std::uint16_t top, Material material) {
        row.runs.push_back({bottom, top, material});
      });
      row.end_column();
    }
  }

  // Appends both columns after the exchange between them.
  std::int64_t exchange(std::span<const Run> p, std::span<const Run> q, int allowed, Scratch& scratch,
                        Row& p_out, Row& q_out) const {
    const auto ground = [](std::span<const Run> c) { return c.size() == 1 && c[0].bottom == 0; };
    std::int64_t moved = 0;
    if (!(ground(p) && ground(q) && std::abs(p[0].top - q[0].top) <= allowed)) {  // most pairs are at rest
      scratch.a.read(p);
      scratch.b.read(q);
      moved = slide_over(scratch.a, scratch.b, allowed, share_);
      moved += slide_over(scratch.b, scratch.a, allowed, share_);
    }
    if (moved == 0) {
      p_out.add_column(p);
      q_out.add_column(q);
    } else {
      scratch.a.write(p_out);
      scratch.b.write(q_out);
    }
    return moved;
  }

  std::int64_t slide_along(std::size_t j) {
    if (rested_along_[j] == versions_[j]) return 0;
    Scratch& scratch = scratches_.local();
    std::int64_t moved = 0;
    for (const int odd : {0, 1}) {
      const Row& row = rows_[j];
      scratch.row.clear();
      if (odd == 1) scratch.row.add_column(row.column(0));
      int i = odd;
      std::int64_t in_pass = 0;
      for (; i + 1 < width_; i += 2) {
        in_pass += exchange(row.column(i), row.column(i + 1), along_, scratch, scratch.row, scratch.row);
      }
      if (i < width_) scratch.row.add_column(row.column(i));
      if (in_pass > 0) std::swap(rows_[j], scratch.row);
      moved += in_pass;
    }
    if (moved > 0) ++versions_[j];
    if (moved == 0) rested_along_[j] = versions_[j];
    return moved;
  }

  // Between rows j and j + 1: straight, then along both diagonals. Each is a pairing of its own.
  std::int64_t slide_across(std::size_t j) {
    const std::uint64_t version = versions_[j] + versions_[j + 1];  // grow alone, so the sum tells
    if (rested_across_[j] == version) return 0;
    Scratch& scratch = scratches_.local();
    std::int64_t moved = 0;
    for (const int shift : {0, 1, -1}) {  // column i of row j meets i + shift of the next
      const Row &row = rows_[j], &next = rows_[j + 1];
      scratch.row.clear();
      scratch.next.clear();
      if (shift == 1) scratch.next.add_column(next.column(0));
      if (shift == -1) scratch.row.add_column(row.column(0));
      std::int64_t in_pass = 0;
      for (int i = std::max(0, -shift); i < width_ - std::max(0, shift); ++i) {
        in_pass += exchange(row.column(i), next.column(i + shift), shift == 0 ? across_ : diagonal_, scratch,
                            scratch.row, scratch.next);
      }
      if (shift == 1) scratch.row.add_column(row.column(width_ - 1));
      if (shift == -1) scratch.next.add_column(next.column(width_ - 1));
      if (in_pass > 0) {
        std::swap(rows_[j], scratch.row);
        std::swap(rows_[j + 1], scratch.next);
      }
      moved += in_pass;
    }
    if (moved > 0) {
      ++versions_[j];
      ++versions_[j + 1];
    } else {
      rested_across_[j] = version;
    }
    return moved;
  }

  const LayeredStack& stack_;
  int width_, depth_, along_ = 1, across_ = 1, diagonal_ = 1;
  double share_;
  std::vector<Row> rows_;
  std::vector<std::uint64_t> versions_;                      // per row, how often it changed
  std::vector<std::uint64_t> rested_along_, rested_across_;  // the version at which nothing moved
  tbb::enumerable_thread_specific<Scratch> scratches_;
};

std::size_t Eroder::write(Representation& edited) const {
  const ColumnGrid& grid = stack_.grid();
  std::vector<float> x, z;
  std::vector<Span> spans;
  std::size_t columns = 0;
  Row before;
  for (int j = 0; j < depth_; ++j) {
    if (versions_[static_cast<std::size_t>(j)] == 0) continue;
    read(j, before);
    const Row& after = rows_[static_cast<std::size_t>(j)];
    for (int i = 0; i < width_; ++i) {
      const auto old_runs = before.column(i), new_runs = after.column(i);
      if (std::equal(old_runs.begin(), old_runs.end(), new_runs.begin(), new_runs.end())) continue;
      ++columns;
      const auto add = [&](int bottom, int top, Material material) {
        x.push_back(grid.centre_x(i));
        z.push_back(grid.centre_z(j));
        spans.push_back({grid.edge_y(bottom), grid.edge_y(top), material});
      };
      add(0, grid.levels, Material::kAir);
      for (const Run& run : new_runs) add(run.bottom, run.top, run.material);
    }
  }
  edited.edit({x, z}, spans);  // at once, so that a failure changes nothing
  return columns;
}

void check(const ThermalErosionOptions& options) {
  if (!(options.talus >= 0 && options.talus < 90)) {
    throw usage_error(fmt::format("a talus angle of {} degrees", options.talus), "thermal erosion",
                      "choose an angle from 0 to below 90; sand rests at about 35");
  }
  if (!(options.share > 0 && options.share <= 1)) {
    throw usage_error(fmt::format("a share of {} moved per step", options.share), "thermal erosion",
                      "choose a share above 0 and at most 1");
  }
  if (options.steps < 0) {
    throw usage_error(fmt::format("{} steps", options.steps), "thermal erosion", "choose 0 or more");
  }
}

}  // namespace

ThermalErosion erode_thermally(const LayeredStack& stack, Representation& edited,
                               const ThermalErosionOptions& options, Progress& progress) {
  check(options);
  Eroder eroder(stack, options);
  ThermalErosion result;
  progress.begin("thermal erosion", static_cast<std::uint64_t>(options.steps));
  while (result.steps < options.steps) {
    const std::int64_t moved = eroder.step();
    progress.advance();
    if (moved == 0) {
      result.settled = true;
      break;
    }
    ++result.steps;
    result.moved += moved;
  }
  result.columns = eroder.write(edited);
  return result;
}

ThermalErosion LayeredStack::erode_to(double talus, Progress& progress) {
  return erode_thermally(*this, *this, {.talus = talus}, progress);
}

}  // namespace terrabench
