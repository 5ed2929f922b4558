#include "results/claims/conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "results/store/glob.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

Operand operand_from(const TomlValue& node) {
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

bool is_count(double number, int most) {
  return number >= 1 && number <= most && number == std::floor(number);
}

// A count of panels, or their names in the order drawn.
void read_panels(TomlTable& entry, Condition& condition) {
  std::vector<std::string> names;
  if (entry.has("panels") && entry.get("panels").node->is_array()) {
    for (const TomlValue& name : entry.list("panels")) names.push_back(name.text("panels"));
    condition.panels = static_cast<int>(names.size());
  } else if (entry.has("panels")) {
    const double panels = entry.get("panels").number("panels");
    if (!is_count(panels, 1000)) entry.refuse("'panels' is a count, or a list of names");
    condition.panels = static_cast<int>(panels);
  }
  for (const TomlValue& node : entry.list("alike")) {
    const auto at = std::ranges::find(names, node.text("alike"));
    const int panel = static_cast<int>(at - names.begin()) + 1;
    if (at == names.end() || std::ranges::count(condition.alike, panel) > 0)
      entry.refuse("'alike' must list different names of 'panels'");
    condition.alike.push_back(panel);
  }
  if (condition.alike.size() == 1) entry.refuse("'alike' must list two panels or more");
}

void read_figure(TomlTable& entry, Condition& condition) {
  condition.kind = Condition::Kind::kFigure;
  condition.figure = entry.text("figure");
  read_panels(entry, condition);
  for (const TomlValue& metric : entry.list("prints")) condition.operands.push_back(operand_from(metric));
  if (entry.has("brightness")) condition.brightness.push_back(operand_from(entry.get("brightness")));
  const auto is_number = [](const Operand& operand) { return operand.is_number(); };
  if (std::ranges::any_of(condition.operands, is_number) ||
      std::ranges::any_of(condition.brightness, is_number)) {
    entry.refuse("a figure is compared with metrics, not with numbers");
  }
  entry.refuse_unknown();
}

std::string formula(const Operand& operand) {
  if (operand.is_number()) return fmt::format("{}", operand.number);
  return fmt::format("{}/{}/{}", operand.experiment, operand.case_name, operand.metric);
}

using Matched = std::set<std::pair<int, std::string>>;  // lines of claims, and patterns

bool named(const std::vector<std::string>& patterns, const std::string& text, int line, Matched& matched) {
  bool found = false;
  for (const std::string& pattern : patterns) {
    if (!matches_glob(pattern, text)) continue;
    matched.emplace(line, pattern);
    found = true;
  }
  return found;
}

}  // namespace

Condition condition_from(const TomlValue& node) {
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
  TomlTable entry(node);
  Condition condition;
  if (entry.has("figure")) {
    condition.kind = Kind::kFigure;
    read_figure(entry, condition);
    return condition;
  }
  const auto* const form =
      std::find_if(std::begin(kForms), std::end(kForms), [&](const Form& f) { return entry.has(f.key); });
  if (form == std::end(kForms)) {
    entry.refuse("a condition is one of equal, order, within, ratio, growth, figure");
  }
  condition.kind = form->kind;
  for (const TomlValue& operand : entry.list(form->key)) {
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
    if (condition.kind == Condition::Kind::kWithin && condition.low <= 0 && condition.high == 1) {
      entry.refuse("the range holds every share: no method could fail it");
    }
  }
  entry.refuse_unknown();
  return condition;
}

std::string formula(const Condition& condition) {
  using Kind = Condition::Kind;
  if (condition.kind == Kind::kFigure) return "figure " + condition.figure;
  std::vector<std::string> operands;
  for (const Operand& operand : condition.operands) operands.push_back(formula(operand));
  if (condition.kind == Kind::kGrowth) std::ranges::reverse(operands);
  if (condition.kind == Kind::kEqual) return fmt::format("{}", fmt::join(operands, " = "));
  if (condition.kind == Kind::kOrder) return fmt::format("{}", fmt::join(operands, " < "));
  return fmt::format("{} in [{}, {}]", fmt::join(operands, " / "), condition.low, condition.high);
}

void expect_failures(std::span<Claim> claims, const std::string& origin) {
  const auto fail = [&](const Claim& claim, std::string_view what) {
    throw bad_input(fmt::format("{}: {}", claim.id, what), fmt::format("{}:{}", origin, claim.line),
                    "correct the claims file");
  };
  Matched matched;
  for (Claim& claim : claims) {
    for (Condition& condition : claim.conditions) {
      const std::string text = formula(condition);
      const bool fails = named(claim.fails, text, claim.line, matched);
      const bool may_fail = named(claim.may_fail, text, claim.line, matched);
      if (fails && may_fail) fail(claim, fmt::format("'fails' and 'may_fail' both name '{}'", text));
      if (fails) condition.expected = Condition::Expected::kFails;
      if (may_fail) condition.expected = Condition::Expected::kEither;
    }
    const bool has_reason = !claim.note.empty() || !claim.cause.empty();
    if (claim.expected() == Verdict::kDiffers && (!has_reason || claim.matches.empty())) {
      fail(claim,
           "'fails' needs a 'cause' or a 'note' with the reason, and 'matches': a claim's id or a sentence");
    }
    if (claim.may_fail.empty() != claim.machine.empty())
      fail(claim, "'may_fail' and its reason, 'machine', need each other");
  }
  for (const Claim& claim : claims) {
    for (const auto* const patterns : {&claim.fails, &claim.may_fail}) {
      for (const std::string& pattern : *patterns) {
        if (!matched.contains({claim.line, pattern}))
          fail(claim, fmt::format("no condition matches '{}'", pattern));
      }
    }
  }
}

}  // namespace terrabench
