// The comparison of compare.h in words.
#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "results/compare/compare.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

// What differs although only the machine should: exact figures, with both machines.
std::string machines_text(const Comparison& comparison) {
  std::string text;
  std::size_t count = 0;
  for (const MetricChange& m : comparison.metrics) {
    if (m.machine_before.empty() || m.change != Change::kDiffers) continue;
    ++count;
    text += fmt::format("differs between machines: {} {} {}: {} on {}; {} on {}\n", m.experiment, m.case_name,
                        m.metric, format_quantity(m.before, m.unit), m.machine_before,
                        format_quantity(m.after, m.unit), m.machine_after);
  }
  if (count > 0) {
    text += fmt::format("{} exact figures differ between machines: they should be the same on any\n", count);
  }
  return text;
}

// A change of the program or of what was measured, and not of the machine.
bool marked(const MetricChange& m) {
  return m.change != Change::kSame && m.change != Change::kUnresolved && m.change != Change::kElsewhere;
}

std::string title_of(const MetricChange& m) {
  return fmt::format("{} {} ({})", m.experiment, m.case_name, m.profile);
}

std::string line_of(const MetricChange& m, bool colour) {
  const std::string_view paint = !colour || !marked(m) ? "" : "\x1b[33m",
                         plain = paint.empty() ? "" : "\x1b[0m";
  std::string text =
      fmt::format("  {} {:<26} {}{:<11}{}", marked(m) ? '*' : ' ', m.metric, paint, name(m.change), plain);
  const auto show = [&](double value) { return format_quantity(printed(value, m.timed), m.unit); };
  if (m.one_sided()) {
    return text + fmt::format("  {}\n", show(m.change == Change::kOnlyBefore ? m.before : m.after));
  }
  text += fmt::format("  {} → {}", show(m.before), show(m.after));
  const bool has_interval = m.ratio.low < m.ratio.high;  // not NaN
  if (m.before != 0 && m.timed && has_interval && m.change != Change::kElsewhere) {
    text += fmt::format("  × {:.3g} [{:.3g}, {:.3g}]", m.ratio.median, m.ratio.low, m.ratio.high);
  } else if (m.before != 0 && m.before != m.after) {
    text += fmt::format("  × {:.4f}", m.ratio.median);
  }
  return text + '\n';
}

// The metrics by case: all, or those of both folders that changed.
std::string lines_of(const Comparison& comparison, bool colour, bool all) {
  std::string text, heading;
  for (const MetricChange& m : comparison.metrics) {
    if (!all && (m.one_sided() || !marked(m))) continue;
    const std::string title = title_of(m) + (m.same_ground ? "" : ": seed, terrain or parameters differ");
    if (title != heading) text += title + "\n";
    heading = title;
    text += line_of(m, colour);
  }
  return text;
}

// A line per experiment for what only one folder has.
std::string unmatched_text(const Comparison& comparison) {
  struct Count {
    std::set<std::string_view> cases;
    std::size_t metrics = 0;
  };
  std::map<std::pair<Change, std::string>, Count> counts;
  for (const MetricChange& m : comparison.metrics) {
    if (!m.one_sided()) continue;
    Count& count = counts[{m.change, fmt::format("{} ({})", m.experiment, m.profile)}];
    count.cases.insert(m.case_name);
    ++count.metrics;
  }
  std::string text;
  for (const auto& [key, count] : counts) {
    text += fmt::format("{}: {}, cases: {}, metrics: {}\n", name(key.first), key.second, count.cases.size(),
                        count.metrics);
  }
  return text;
}

std::string other_ground_text(const Comparison& comparison) {
  std::set<std::string> cases;
  for (const MetricChange& m : comparison.metrics) {
    if (!m.same_ground) cases.insert(title_of(m));
  }
  if (cases.empty()) return "";
  return fmt::format("seed, terrain or parameters differ in {} cases, the first {}\n", cases.size(),
                     *cases.begin());
}

std::string tally_of(const Comparison& comparison) {
  std::string tally;
  for (const Change change :
       {Change::kSame, Change::kRose, Change::kFell, Change::kDiffers, Change::kUnresolved,
        Change::kElsewhere, Change::kOnlyBefore, Change::kOnlyAfter}) {
    const std::size_t count = comparison.count(change);
    if (count > 0) tally += fmt::format("{}{} {}", tally.empty() ? "" : ", ", count, name(change));
  }
  return (tally.empty() ? "no metrics to compare" : tally) + "\n";
}

}  // namespace

std::string compare_text(const Comparison& comparison, bool colour, bool all) {
  std::string text = tally_of(comparison);
  if (std::isfinite(comparison.median_ratio)) {
    text += fmt::format("times: median ratio × {:.3g}; a change below × {} counts as none\n",
                        comparison.median_ratio, kTimingMargin);
  }
  if (comparison.count(Change::kUnresolved) > 0) {
    text += fmt::format(
        "unresolved: times with fewer than {} samples, with an interval that shows neither a change by that "
        "factor nor a smaller one, or with a ratio without a finite value\n",
        kFewestSamples);
  }
  if (comparison.count(Change::kElsewhere) > 0) {
    text += "elsewhere: times of different kinds of machine, which are not compared\n";
  }
  text += other_ground_text(comparison);
  if (!all) text += unmatched_text(comparison);
  text += lines_of(comparison, colour, all);
  text += machines_text(comparison);
  text += pictures_text(comparison.pictures, colour);
  for (const std::string& warning : comparison.warnings) text += fmt::format("warning: {}\n", warning);
  if (!comparison.faults.empty()) {
    text += fmt::format("{} faults: the results cannot be trusted\n", comparison.faults.size());
  }
  return text;
}

}  // namespace terrabench
