#include "results/ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "results/embedded.h"
#include "results/fill.h"
#include "results/format.h"
#include "results/toml_reader.h"

namespace terrabench {
namespace {

RankingLayout layout_from(const TomlValue& node) {
  TomlTable entry(node);
  RankingLayout layout;
  layout.id = entry.text("id");
  layout.task = entry.text("task");
  layout.where = entry.text("where");
  layout.experiment = entry.text("experiment");
  layout.metric = entry.text("metric");
  layout.unit = entry.text_or("unit", "");
  const std::string best = entry.text("best");
  if (best != "most" && best != "least") entry.refuse("'best' is either most or least");
  layout.most = best == "most";
  if (entry.has("needs")) {
    TomlTable needs(entry.get("needs"));
    layout.needs = needs.text("metric");
    layout.needs_text = needs.text("text");
    const auto [low, high] = needs.get("range").pair("range");
    layout.needs_low = low.number("range");
    layout.needs_high = high.number("range");
    needs.refuse_unknown();
  }
  for (const TomlValue& value : entry.list("entries")) {
    TomlTable one(value);
    layout.entries.push_back({one.text("label"), one.text("case")});
    one.refuse_unknown();
  }
  entry.refuse_unknown();
  return layout;
}

struct Candidate {
  const std::string* label;
  const Record* record;
  const Metric* metric;
  double median;
};

// The measured entries; those that lack what is needed are noted in `left_out`.
std::vector<Candidate> candidates(const RankingLayout& layout, const Store& store, const std::string& profile,
                                  std::vector<std::string>& left_out) {
  std::vector<Candidate> all;
  for (const RankingLayout::Entry& entry : layout.entries) {
    const Record* const record = store.find(layout.experiment, entry.case_name, profile);
    const Metric* const metric = record == nullptr ? nullptr : record->find(layout.metric);
    if (metric != nullptr) all.push_back({&entry.label, record, metric, median(metric->samples)});
  }
  const auto has = [&](const Candidate& c) { return c.record->find(layout.needs) != nullptr; };
  if (layout.needs.empty() || std::ranges::none_of(all, has)) return all;
  std::erase_if(all, [&](const Candidate& c) {
    const Metric* const needed = c.record->find(layout.needs);
    const double value = needed == nullptr ? layout.needs_low - 1 : median(needed->samples);
    if (value >= layout.needs_low && value <= layout.needs_high) return false;
    left_out.push_back(*c.label);
    return true;
  });
  return all;
}

bool same_machine(const std::vector<Candidate>& all, const Store& store) {
  const Provenance* first = nullptr;
  for (const Candidate& c : all) {
    const Provenance* const run = store.run(c.record->run);
    if (run == nullptr) continue;  // the store reports this as a fault
    if (first != nullptr && !comparable(*first, *run)) return false;
    first = run;
  }
  return true;
}

std::string joined(const std::vector<std::string>& parts, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? last : ", ";
    text += parts[i];
  }
  return text;
}

// "1.3 [1.2, 1.4]"; the interval is left out where there is none.
std::string factor_text(const Summary& factor) {
  // Of 1.002, three digits would be 1.
  const std::string median = fmt::format("{:.{}g}", factor.median, factor.median < 1.1 ? 4 : 3);
  if (factor.low == factor.high) return median;
  return fmt::format("{} [{:.3g}, {:.3g}]", median, factor.low, factor.high);
}

}  // namespace

std::string Ranking::clause() const {
  const auto with_value = [&](const Place& p) {
    const double rounded = std::strtod(fmt::format("{:.4g}", p.value).c_str(), nullptr);
    return fmt::format("{} ({})", p.label, format_quantity(rounded, layout->unit));
  };
  const std::string text = layout->where + ": ";
  if (places.empty()) return text + "none";
  if (incomparable) return text + "not compared, as the times are of different machines or builds";
  if (tied > 1) {
    std::vector<std::string> best;
    for (std::size_t i = 0; i < tied; ++i) best.push_back(with_value(places[i]));
    const Summary& last = places[tied - 1].factor;
    return text +
           fmt::format("{} are tied{}", joined(best, " and "),
                       last.median != 1 ? fmt::format(", within a factor of {}", factor_text(last)) : "");
  }
  if (places.size() == 1) return text + with_value(places[0]) + " alone";
  const std::string first = with_value(places[0]), second = with_value(places[1]),
                    factor = factor_text(places[1].factor);
  if (single) {
    return text +
           fmt::format("undecided, as each was measured once: {}, {}, a factor of {}", first, second, factor);
  }
  return text + fmt::format("{}, ahead of {} by a factor of {}", first, second, factor);
}

std::vector<RankingLayout> parse_rankings(std::string_view text, const std::string& origin) {
  const toml::table table = parse_toml(text, origin, "correct the claims file");
  TomlFile file{origin, {}};
  read_sets(table, file);
  TomlTable entry({&table, &file, {}});
  std::vector<RankingLayout> layouts;
  for (const TomlValue& value : entry.list("ranking")) layouts.push_back(layout_from(value));
  return layouts;
}

std::span<const RankingLayout> ranking_layouts() {
  static const std::vector<RankingLayout> kLayouts = [] {
    std::vector<RankingLayout> all;
    for (const EmbeddedFile& file : embedded_claims()) {
      for (RankingLayout& layout : parse_rankings(file.text, std::string(file.name))) {
        all.push_back(std::move(layout));
      }
    }
    return all;
  }();
  return kLayouts;
}

std::optional<Ranking> rank(const RankingLayout& layout, const Store& store, const std::string& profile) {
  Ranking ranking;
  ranking.layout = &layout;
  std::vector<Candidate> all = candidates(layout, store, profile, ranking.left_out);
  if (all.size() + ranking.left_out.size() < 2) return std::nullopt;
  if (all.empty()) return ranking;
  std::ranges::stable_sort(all, [&](const Candidate& a, const Candidate& b) {
    return layout.most ? a.median > b.median : a.median < b.median;
  });
  const Candidate& best = all[0];
  const bool timing = is_timing(best.metric->unit);
  ranking.incomparable = timing && !same_machine(all, store);
  ranking.single =
      timing && all.size() > 1 && std::min(best.metric->samples.size(), all[1].metric->samples.size()) == 1;
  for (const Candidate& c : all) {
    const double to_unit = conversion(c.metric->unit, layout.unit, layout.metric, store.where(*c.record));
    const bool equal = c.median == best.median;  // two zeros have no ratio
    const Summary factor = equal         ? Summary{1, 1, 1, 1}
                           : layout.most ? summarise_ratio(best.metric->samples, c.metric->samples)
                                         : summarise_ratio(c.metric->samples, best.metric->samples);
    ranking.places.push_back({*c.label, c.median * to_unit, factor});
    if (std::ranges::count(ranking.runs, c.record->run) == 0) ranking.runs.push_back(c.record->run);
  }
  while (ranking.tied < all.size() && ranking.places[ranking.tied].factor.low <= 1) ++ranking.tied;
  return ranking;
}

std::vector<Ranking> rank(std::span<const RankingLayout> layouts, const Store& store,
                          const std::string& profile) {
  std::vector<Ranking> rankings;
  for (const RankingLayout& layout : layouts) {
    if (std::optional<Ranking> ranking = rank(layout, store, profile))
      rankings.push_back(std::move(*ranking));
  }
  return rankings;
}

Facts findings(std::span<const Ranking> rankings) {
  Facts facts;
  const std::string* task = nullptr;
  for (const Ranking& ranking : rankings) {
    if (task == nullptr || *task != ranking.layout->task) {
      task = &ranking.layout->task;
      const std::string& needs = ranking.layout->needs_text;
      facts.lines.emplace_back(*task, needs.empty() ? "" : needs + ", ");
    } else {
      facts.lines.back().second += "; ";
    }
    facts.lines.back().second += ranking.clause();
  }
  for (auto& [name, text] : facts.lines) {
    text += ".";
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  }
  return facts;
}

std::string findings_json(std::span<const Ranking> rankings) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const Ranking& ranking : rankings) {
    const RankingLayout& layout = *ranking.layout;
    Json places = Json::array();
    for (const Ranking::Place& p : ranking.places) {
      places.push_back({{"label", p.label},
                        {"value", p.value},
                        {"factor", p.factor.median},
                        {"factor_low", p.factor.low},
                        {"factor_high", p.factor.high}});
    }
    list.push_back({{"id", layout.id},
                    {"task", layout.task},
                    {"where", layout.where},
                    {"experiment", layout.experiment},
                    {"metric", layout.metric},
                    {"unit", layout.unit},
                    {"best", layout.most ? "most" : "least"},
                    {"needs", layout.needs_text},
                    {"left_out", ranking.left_out},
                    {"places", places},
                    {"tied", ranking.places.empty() ? 0 : ranking.tied},
                    {"measured_once", ranking.single},
                    {"comparable", !ranking.incomparable},
                    {"finding", ranking.clause()},
                    {"runs", ranking.runs}});
  }
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace terrabench
