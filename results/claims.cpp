#include "results/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "results/claims_entry.h"
#include "results/embedded.h"
#include "results/further_grounds.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::string_view kVerdicts[] = {
    "reproduced", "reproduced (shape)", "differs", "not comparable", "pending", "not run", "missing"};
constexpr std::string_view kAllProfiles[] = {"quick", "paper"};

Operand operand_from(const ClaimsNode& node) {
  Operand operand;
  if (!node.node->is_string()) {
    operand.number = node.number("operand");
    return operand;
  }
  const std::string path = node.text("operand");
  const std::size_t first = path.find('/'), last = path.rfind('/');
  if (first == path.npos || first == last || first == 0 || last + 1 == path.size()) {
    node.fail("an operand is a number or \"experiment/case/metric\"");
  }
  operand.experiment = path.substr(0, first);
  operand.case_name = path.substr(first + 1, last - first - 1);
  operand.metric = path.substr(last + 1);
  return operand;
}

Condition condition_from(const ClaimsNode& node) {
  using Kind = Condition::Kind;
  struct Form {
    std::string_view key;
    Kind kind;
    std::size_t fewest, most;
    bool range;
  };
  constexpr Form kForms[] = {{"equal", Kind::kEqual, 2, 64, false},
                             {"order", Kind::kOrder, 2, 16, false},
                             {"within", Kind::kWithin, 1, 1, true},
                             {"ratio", Kind::kRatio, 2, 2, true},
                             {"growth", Kind::kGrowth, 2, 2, true}};
  ClaimsEntry entry(node);
  Condition condition;
  if (entry.has("figure")) {
    condition.kind = Kind::kFigure;
    condition.figure = entry.text("figure");
    entry.refuse_unknown();
    return condition;
  }
  const auto* const form =
      std::find_if(std::begin(kForms), std::end(kForms), [&](const Form& f) { return entry.has(f.key); });
  if (form == std::end(kForms)) {
    entry.refuse("a check is one of equal, order, within, ratio, growth, figure");
  }
  condition.kind = form->kind;
  for (const ClaimsNode& operand : entry.list(form->key)) {
    condition.operands.push_back(operand_from(operand));
  }
  if (condition.operands.size() < form->fewest || condition.operands.size() > form->most) {
    entry.refuse(fmt::format("'{}' takes {} to {} operands", form->key, form->fewest, form->most));
  }
  if (form->range) {
    const auto [low, high] = entry.get("range").pair("range");
    condition.low = low.number("range");
    condition.high = high.number("range");
    if (condition.low > condition.high) entry.refuse("the range is empty");
  }
  entry.refuse_unknown();
  return condition;
}

// All when none is named.
std::vector<std::string> profiles_from(ClaimsEntry& entry) {
  std::vector<std::string> profiles;
  for (const ClaimsNode& profile : entry.list("profiles")) profiles.push_back(profile.text("profiles"));
  if (profiles.empty()) profiles.assign(std::begin(kAllProfiles), std::end(kAllProfiles));
  return profiles;
}

Verdict known_verdict(const ClaimsEntry& entry, const std::string& known, const std::string& note) {
  const auto* const at = std::find(std::begin(kVerdicts), std::end(kVerdicts), known);
  const auto verdict = static_cast<Verdict>(at - std::begin(kVerdicts));
  // The others say what a run lacks, which nobody can know beforehand.
  if (verdict > Verdict::kNotComparable) {
    entry.refuse(fmt::format("'{}' is no verdict that a row can be known to have", known));
  }
  if (verdict == Verdict::kDiffers && note.empty()) {
    entry.refuse("a row known to differ needs a 'note' that says why");
  }
  return verdict;
}

Claim claim_from(const ClaimsNode& node) {
  ClaimsEntry entry(node);
  Claim claim;
  claim.id = entry.text("id");
  claim.where = entry.text("where");
  claim.statement = entry.text("statement");
  const std::string type = entry.text("class");
  if (type.size() != 1 || std::string_view("ETSFQ").find(type[0]) == std::string_view::npos) {
    entry.refuse("'class' is one of E, T, S, F, Q");
  }
  claim.type = type[0];
  for (const ClaimsNode& value : entry.list("reported")) claim.reported.push_back(value.number("reported"));
  claim.unit = entry.text_or("unit", "");
  claim.tolerance = entry.text_or("tolerance", "");
  claim.note = entry.text_or("note", "");
  claim.pending = entry.text_or("pending", "");
  claim.not_comparable = entry.text_or("not_comparable", "");
  claim.profiles = profiles_from(entry);
  for (const ClaimsNode& condition : entry.list("check"))
    claim.conditions.push_back(condition_from(condition));
  const bool measured = claim.pending.empty() && claim.not_comparable.empty();
  if (measured == claim.conditions.empty()) {
    entry.refuse(
        fmt::format("{} needs either 'check' or a reason in 'pending' or 'not_comparable'", claim.id));
  }
  const Verdict usual = !claim.not_comparable.empty() ? Verdict::kNotComparable
                        : claim.type == 'S'           ? Verdict::kShape
                                                      : Verdict::kReproduced;
  claim.known = known_verdict(entry, entry.text_or("known", std::string(name(usual))), claim.note);
  entry.refuse_unknown();
  return claim;
}

FurtherGround ground_from(const ClaimsNode& node, const std::vector<Claim>& claims) {
  ClaimsEntry entry(node);
  FurtherGround ground{entry.text("name"), entry.text("of"), entry.text("label"), profiles_from(entry), {}};
  for (const ClaimsNode& row : entry.list("known")) {
    ClaimsEntry known(row);
    const std::string id = known.text("claim"), verdict = known.text("verdict");
    const auto claim = std::find_if(claims.begin(), claims.end(), [&](const Claim& c) { return c.id == id; });
    if (claim == claims.end()) known.refuse(fmt::format("there is no row '{}'", id));
    const std::string note = known.text_or("note", "");
    ground.known.push_back({id, known_verdict(known, verdict, note.empty() ? claim->note : note), note});
    known.refuse_unknown();
  }
  entry.refuse_unknown();
  return ground;
}

TableLayout::Row row_from(const ClaimsNode& node) {
  ClaimsEntry entry(node);
  TableLayout::Row row{entry.text("label"), entry.text("case"), {}};
  for (const auto& [key, value] : entry.rest()) {
    if (value.node->is_string()) {
      row.values.emplace(key, value.text(key));
    } else {
      row.values.emplace(key, value.number(key));
    }
  }
  return row;
}

TableLayout::Column column_from(const ClaimsNode& node) {
  using Kind = TableLayout::Column::Kind;
  constexpr std::pair<std::string_view, Kind> kKinds[] = {
      {"reported", Kind::kReported}, {"metric", Kind::kMetric},    {"interval", Kind::kInterval},
      {"growth", Kind::kGrowth},     {"speed_up", Kind::kSpeedUp}, {"verdict", Kind::kVerdict}};
  ClaimsEntry entry(node);
  TableLayout::Column column;
  column.title = entry.text("title");
  column.unit = entry.text_or("unit", "");
  const auto* const kind =
      std::find_if(std::begin(kKinds), std::end(kKinds), [&](const auto& k) { return entry.has(k.first); });
  if (kind == std::end(kKinds)) {
    entry.refuse("a column is one of reported, metric, interval, growth, speed_up, verdict");
  }
  column.kind = kind->second;
  if (column.kind == Kind::kSpeedUp) {
    const auto [key, metric] = entry.get("speed_up").pair("speed_up");
    column.key = key.text("speed_up");
    column.metric = metric.text("speed_up");
  } else {
    const bool measured =
        column.kind == Kind::kMetric || column.kind == Kind::kInterval || column.kind == Kind::kGrowth;
    (measured ? column.metric : column.key) = entry.text(kind->first);
  }
  entry.refuse_unknown();
  return column;
}

TableLayout table_from(const ClaimsNode& node) {
  ClaimsEntry entry(node);
  TableLayout table;
  table.id = entry.text("id");
  table.title = entry.text("title");
  table.caption = entry.text("caption");
  table.experiment = entry.text("experiment");
  table.rows_title = entry.text("rows_title");
  for (const ClaimsNode& row : entry.list("rows")) table.rows.push_back(row_from(row));
  for (const ClaimsNode& column : entry.list("columns")) {
    table.columns.push_back(column_from(column));
  }
  if (table.rows.empty() || table.columns.empty()) entry.refuse("a table needs rows and columns");
  entry.refuse_unknown();
  return table;
}

PlotLayout::Axis axis_from(const ClaimsNode& node) {
  ClaimsEntry entry(node);
  PlotLayout::Axis axis{entry.text("label"), entry.text_or("unit", ""), entry.flag("log")};
  entry.refuse_unknown();
  return axis;
}

PlotLayout::Series series_from(const ClaimsNode& node) {
  ClaimsEntry entry(node);
  PlotLayout::Series series;
  series.label = entry.text("label");
  series.slope = entry.flag("slope");
  for (const ClaimsNode& point : entry.list("values")) {
    const auto [x, y] = point.pair("values");
    series.values.emplace_back(x.number("values"), y.number("values"));
  }
  series.x_metric = entry.text_or("x_metric", "");
  for (const ClaimsNode& point : entry.list("cases")) {
    if (!series.x_metric.empty()) {
      series.cases.emplace_back(0, point.text("cases"));
      continue;
    }
    const auto [x, case_name] = point.pair("cases");
    series.cases.emplace_back(x.number("cases"), case_name.text("cases"));
  }
  if (series.values.empty() == series.cases.empty()) entry.refuse("a series has either 'values' or 'cases'");
  if (!series.cases.empty()) {
    series.experiment = entry.text("experiment");
    series.metric = entry.text("metric");
  }
  entry.refuse_unknown();
  return series;
}

PlotLayout plot_from(const ClaimsNode& node) {
  ClaimsEntry entry(node);
  PlotLayout plot;
  plot.id = entry.text("id");
  plot.title = entry.text("title");
  plot.caption = entry.text("caption");
  plot.x = axis_from(entry.get("x"));
  plot.y = axis_from(entry.get("y"));
  for (const ClaimsNode& series : entry.list("series")) plot.series.push_back(series_from(series));
  if (plot.series.empty()) entry.refuse("a plot needs series");
  entry.refuse_unknown();
  return plot;
}

// Ids become file names and anchors.
void check_ids(const Paper& paper, const std::string& origin) {
  std::set<std::string_view> seen;
  const auto check = [&](std::string_view id) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
    if (id.empty() || id[0] == '.' || id.find_first_not_of(kPlain) != id.npos) {
      throw bad_input(fmt::format("'{}' is no id: letters, digits, '.', '_' and '-' only", id), origin,
                      "correct the claims file");
    }
    if (!seen.insert(id).second) {
      throw bad_input(fmt::format("the id '{}' is used twice", id), origin, "correct the claims file");
    }
  };
  check(paper.id);
  for (const Claim& claim : paper.claims) check(claim.id);
  for (const TableLayout& table : paper.tables) check(table.id);
  for (const PlotLayout& plot : paper.plots) check(plot.id);
}

}  // namespace

std::string_view name(Verdict verdict) { return kVerdicts[static_cast<std::size_t>(verdict)]; }

Paper parse_claims(std::string_view text, const std::string& origin) {
  const toml::table table = parse_toml(text, origin, "correct the claims file");
  ClaimsFile file{origin, {}};
  read_sets(table, file);
  ClaimsEntry entry({&table, &file, {}});
  entry.has("sets");
  Paper paper{entry.text("paper"), entry.text("title"), entry.text("source"), {}, {}, {}};
  for (const ClaimsNode& claim : entry.list("claim")) paper.claims.push_back(claim_from(claim));
  std::vector<FurtherGround> grounds;
  for (const ClaimsNode& ground : entry.list("ground")) grounds.push_back(ground_from(ground, paper.claims));
  paper.claims = on_further_grounds(paper.claims, grounds);
  for (const ClaimsNode& table : entry.list("table")) paper.tables.push_back(table_from(table));
  for (const ClaimsNode& plot : entry.list("plot")) paper.plots.push_back(plot_from(plot));
  entry.refuse_unknown();
  check_ids(paper, origin);
  return paper;
}

std::span<const Paper> papers() {
  static const std::vector<Paper> kPapers = [] {
    constexpr std::string_view kOrder[] = {"hybrid", "ght", "drill", "mrbsp", "meshgrow", "cross"};
    std::vector<Paper> all;
    for (const EmbeddedFile& file : embedded_claims())
      all.push_back(parse_claims(file.text, std::string(file.name)));
    const auto rank = [&](const Paper& paper) {
      return std::find(std::begin(kOrder), std::end(kOrder), paper.id) - std::begin(kOrder);
    };
    std::stable_sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    return all;
  }();
  return kPapers;
}

std::vector<const Claim*> claims() {
  std::vector<const Claim*> all;
  for (const Paper& paper : papers()) {
    for (const Claim& claim : paper.claims) all.push_back(&claim);
  }
  return all;
}

}  // namespace terrabench
