#include "results/claims/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "results/claims/conditions.h"
#include "results/claims/embedded.h"
#include "results/claims/toml_reader.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::string_view kVerdicts[] = {
    "reproduced", "reproduced (shape)", "differs", "not comparable", "not run", "missing"};
constexpr std::string_view kGroupNames[] = {"stated in the paper", "figures drawn", "beyond the paper"};
constexpr std::string_view kVariations[] = {"claim", "reading", "setting", "ground"};
constexpr std::string_view kAllProfiles[] = {"quick", "paper"};

// All profiles if the entry names none.
std::vector<std::string> profiles_from(TomlTable& entry) {
  std::vector<std::string> profiles;
  for (const TomlValue& value : entry.list("profiles")) {
    // Empty for a member of `each` that is not measured in that profile.
    if (const std::string profile = value.text("profiles"); !profile.empty()) profiles.push_back(profile);
  }
  if (profiles.empty()) profiles.assign(std::begin(kAllProfiles), std::end(kAllProfiles));
  return profiles;
}

// Patterns for conditions. Empty ones are those of members of `each` that need none.
std::vector<std::string> patterns_from(TomlTable& entry, std::string_view key) {
  std::vector<std::string> patterns;
  for (const TomlValue& value : entry.list(key)) {
    if (std::string pattern = value.text(key); !pattern.empty()) patterns.push_back(std::move(pattern));
  }
  return patterns;
}

// Whether an entry, or a whole file, is beyond the paper.
bool is_beyond(TomlTable& entry, bool usual) {
  if (!entry.has("about")) return usual;
  const std::string about = entry.text("about");
  if (about != "paper" && about != "beyond") entry.refuse("'about' is one of paper, beyond");
  return about == "beyond";
}

// What a claim is a sub-row of, if it is one. `first`: the claim that an earlier member of this claim's
// `each` stands for; null if there is none.
void read_sub_row(TomlTable& entry, const Claim* first, Claim& claim) {
  const std::string each_is = entry.text_or("each_is", "setting");
  constexpr std::string_view kEach[] = {"claim", "reading", "setting"};
  const auto* const kind = std::ranges::find(kEach, each_is);
  if (kind == std::end(kEach)) entry.refuse("'each_is' is one of claim, reading, setting");
  if (first != nullptr && kind != kEach) {
    claim.of = first->of.empty() ? first->id : first->of;
    claim.varies = each_is == "reading" ? Variation::kReading : Variation::kSetting;
  }
  for (const auto& [key, varies] :
       {std::pair{"reading_of", Variation::kReading}, std::pair{"setting_of", Variation::kSetting}}) {
    // Empty for a member of `each` that is a claim of its own.
    std::string of = entry.text_or(key, "");
    if (of.empty()) continue;
    if (claim.varies != Variation::kNone && key == std::string_view("setting_of") && entry.has("reading_of"))
      entry.refuse("a claim has either 'reading_of' or 'setting_of'");
    claim.of = std::move(of);
    claim.varies = varies;
  }
}

// `first`: see read_sub_row().
Claim claim_from(const TomlValue& node, bool usually_beyond, const Claim* first) {
  TomlTable entry(node);
  Claim claim;
  claim.id = entry.text("id");
  claim.line = static_cast<int>(node.node->source().begin.line);
  const bool beyond = is_beyond(entry, usually_beyond);
  read_sub_row(entry, first, claim);
  claim.where = entry.text("where");
  claim.statement = entry.text("statement");
  const std::string type = entry.text("class");
  if (type.size() != 1 || std::string_view("ETSFQ").find(type[0]) == std::string_view::npos) {
    entry.refuse("'class' is one of E, T, S, F, Q");
  }
  claim.claim_class = type[0];
  claim.group = beyond ? Group::kBeyond : type == "F" ? Group::kFigure : Group::kStated;
  for (const TomlValue& value : entry.list("reported")) claim.reported.push_back(value.number("reported"));
  claim.unit = entry.text_or("unit", "");
  claim.tolerance = entry.text_or("tolerance", "");
  claim.note = entry.text_or("note", "");
  claim.not_comparable = entry.text_or("not_comparable", "");
  claim.machine = entry.text_or("machine", "");
  claim.profiles = profiles_from(entry);
  for (const TomlValue& condition : entry.list("check"))
    claim.conditions.push_back(condition_from(condition));
  if (claim.not_comparable.empty() == claim.conditions.empty())
    entry.refuse(fmt::format("{} needs either 'check' or a reason in 'not_comparable'", claim.id));
  claim.fails = patterns_from(entry, "fails");
  claim.may_fail = patterns_from(entry, "may_fail");
  claim.matches = entry.text_or("matches", "");
  claim.cause = entry.text_or("cause", "");
  claim.vague = entry.text_or("vague", "");
  entry.refuse_unknown();
  return claim;
}

Cause cause_from(const TomlValue& node) {
  TomlTable entry(node);
  Cause cause{entry.text("id"), entry.text("title"), entry.text("text")};
  entry.refuse_unknown();
  return cause;
}

Cover cover_from(const TomlValue& node) {
  TomlTable entry(node);
  Cover cover{entry.text("figure"), entry.text("shows")};
  entry.refuse_unknown();
  return cover;
}

Reference reference_from(const TomlValue& node) {
  TomlTable entry(node);
  Reference reference;
  for (const TomlValue& author : entry.list("authors")) reference.authors.push_back(author.text("authors"));
  reference.title = entry.text_or("title", "");
  reference.subject = entry.text_or("subject", "");
  reference.institution = entry.text_or("institution", "");
  if (entry.has("year")) reference.year = static_cast<int>(entry.get("year").number("year"));
  if (reference.title.empty() == reference.subject.empty()) {
    entry.refuse("a reference has either a 'title' or a 'subject'");
  }
  entry.refuse_unknown();
  return reference;
}

// Another ground for claims: the same conditions, read from other cases.
struct OtherGround {
  std::string name;   // appended to the id of each claim and of its figures
  std::string of;     // the ground that the claims' conditions name: the case, or its first part
  std::string label;  // appended to where the claim stands in the paper
  std::vector<std::string> profiles;
};

OtherGround ground_from(const TomlValue& node) {
  TomlTable entry(node);
  OtherGround ground{entry.text("name"), entry.text("of"), entry.text("label"), profiles_from(entry)};
  entry.refuse_unknown();
  return ground;
}

// Makes the claim's conditions read this ground in place of `of`. False if none of them reads `of`.
bool move_to(const OtherGround& ground, Claim& claim) {
  bool moved = false;
  for (Condition& condition : claim.conditions) {
    if (condition.kind == Condition::Kind::kFigure) {
      condition.figure += "." + ground.name;
      moved = true;
    }
    for (std::vector<Operand>* const operands : {&condition.operands, &condition.brightness}) {
      for (Operand& operand : *operands) {
        std::string& name = operand.case_name;
        if (name != ground.of && !name.starts_with(ground.of + "/")) continue;
        name.replace(0, ground.of.size(), ground.name);
        moved = true;
      }
    }
  }
  return moved;
}

// All claims; after each claim that is measured on a ground's `of`, its copy for that ground.
std::vector<Claim> on_further_grounds(const std::vector<Claim>& claims,
                                      const std::vector<OtherGround>& grounds) {
  std::vector<Claim> all;
  for (const Claim& claim : claims) {
    all.push_back(claim);
    for (const OtherGround& ground : grounds) {
      Claim again = claim;
      if (!move_to(ground, again)) continue;
      again.of = claim.of.empty() ? claim.id : claim.of;
      again.varies = Variation::kGround;
      again.id += "." + ground.name;
      again.where += ", on " + ground.label;
      again.profiles = ground.profiles;
      all.push_back(std::move(again));
    }
  }
  return all;
}

void read_layouts(TomlTable& entry, Paper& paper) {
  for (const TomlValue& page : entry.list("page")) paper.pages.push_back(parse_page(page));
  for (const TomlValue& table : entry.list("table")) paper.tables.push_back(parse_table(table, paper.pages));
  for (const TomlValue& plot : entry.list("plot")) paper.plots.push_back(parse_plot(plot, paper.pages));
  for (const TomlValue& ranking : entry.list("ranking")) paper.rankings.push_back(parse_ranking(ranking));
}

// Ids become file names and anchors.
void check_ids(const Paper& paper, const std::string& origin) {
  std::set<std::string_view> seen;
  const auto check = [&](std::string_view id) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-";
    if (id.empty() || id[0] == '.' || id.find_first_not_of(kPlain) != id.npos) {
      throw bad_input(fmt::format("invalid id '{}': expected letters, digits, '.', '_' and '-' only", id),
                      origin, "correct the claims file");
    }
    if (!seen.insert(id).second) {
      throw bad_input(fmt::format("the id '{}' is used twice", id), origin, "correct the claims file");
    }
  };
  check(paper.id);
  for (const Claim& claim : paper.claims) check(claim.id);
  for (const Cause& cause : paper.causes) check(cause.id);
  for (const TableLayout& table : paper.tables) check(table.id);
  for (const PlotLayout& plot : paper.plots) check(plot.id);
  for (const PageLayout& page : paper.pages) check(page.id);
}

// A sub-row names a claim and is of its group; `matches` names a claim that is known to hold, or is a
// sentence; each cause is that of a claim.
void check_references(Paper& paper, const std::string& origin) {
  const auto fail = [&](const std::string& id, std::string_view what) {
    throw bad_input(fmt::format("{}: {}", id, what), origin, "correct the claims file");
  };
  const auto claim_of = [&](const std::string& id) {
    return std::ranges::find(paper.claims, id, &Claim::id);
  };
  for (Claim& claim : paper.claims) {
    if (!claim.of.empty()) {
      const auto whole = claim_of(claim.of);
      if (whole == paper.claims.end())
        fail(claim.id, fmt::format("is a {} of the unknown claim '{}'", name(claim.varies), claim.of));
      if (!whole->of.empty())
        fail(claim.id,
             fmt::format("is a {} of '{}', which is a sub-row itself", name(claim.varies), claim.of));
      claim.group = whole->group;
    }
    if (!claim.cause.empty()) {
      const auto cause = std::ranges::find(paper.causes, claim.cause, &Cause::id);
      if (cause == paper.causes.end()) fail(claim.id, fmt::format("unknown cause '{}'", claim.cause));
      claim.cause_title = cause->title;
    }
    if (claim.matches.empty() || claim.matches.find(' ') != std::string::npos) continue;
    const auto match = claim_of(claim.matches);
    if (match == paper.claims.end()) {
      fail(claim.id, fmt::format("'matches' is neither a claim's id nor a sentence: '{}'", claim.matches));
    }
    if (!holds(match->expected())) fail(claim.id, fmt::format("'{}' is not known to hold", match->id));
  }
  for (const Cause& cause : paper.causes) {
    if (std::ranges::count(paper.claims, cause.id, &Claim::cause) == 0)
      fail(cause.id, "no claim names this cause");
  }
}

}  // namespace

std::string_view name(Verdict verdict) { return kVerdicts[static_cast<std::size_t>(verdict)]; }
std::string_view name(Group group) { return kGroupNames[static_cast<std::size_t>(group)]; }
std::string_view name(Variation varies) { return kVariations[static_cast<std::size_t>(varies)]; }

Verdict Claim::expected() const {
  if (!not_comparable.empty()) return Verdict::kNotComparable;
  if (std::ranges::count(conditions, Condition::Expected::kFails, &Condition::expected) > 0)
    return Verdict::kDiffers;
  return claim_class == 'S' ? Verdict::kShape : Verdict::kReproduced;
}

std::vector<std::string_view> Claim::experiments() const {
  std::vector<std::string_view> found;
  for (const Condition& condition : conditions) {
    for (const std::vector<Operand>* const operands : {&condition.operands, &condition.brightness}) {
      for (const Operand& operand : *operands) {
        if (!operand.is_number() && std::ranges::count(found, operand.experiment) == 0)
          found.push_back(operand.experiment);
      }
    }
  }
  return found;
}

std::string Claim::reason() const {
  if (expected() != Verdict::kDiffers && !machine.empty()) return machine;
  if (note.empty()) return cause_title.empty() ? "" : cause_title + ".";
  const std::size_t end = note.find(". ");
  return end == std::string::npos ? note : note.substr(0, end + 1);
}

Paper parse_claims(std::string_view text, const std::string& origin) {
  const toml::table table = parse_toml(text, origin, "correct the claims file");
  TomlFile file{origin, {}};
  read_sets(table, file);
  TomlTable entry({&table, &file, {}});
  entry.has("sets");
  Paper paper{entry.text("paper"), entry.text("title"), {}, "", {}, {}, {}};
  if (entry.has("reference")) paper.reference = reference_from(entry.get("reference"));
  paper.source = paper.reference ? entry.text_or("source", "") : entry.text("source");
  if (entry.has("cover")) paper.cover = cover_from(entry.get("cover"));
  const bool beyond = is_beyond(entry, false);
  const toml::node* of_last = nullptr;  // elements of one `each` follow each other
  std::size_t first = 0;
  for (const TomlValue& claim : entry.list("claim")) {
    if (claim.node != of_last) first = paper.claims.size();
    of_last = claim.node;
    const bool again = first < paper.claims.size();
    paper.claims.push_back(claim_from(claim, beyond, again ? &paper.claims[first] : nullptr));
  }
  std::vector<OtherGround> grounds;
  for (const TomlValue& ground : entry.list("ground")) grounds.push_back(ground_from(ground));
  paper.claims = on_further_grounds(paper.claims, grounds);
  expect_failures(paper.claims, origin);
  for (const TomlValue& cause : entry.list("cause")) paper.causes.push_back(cause_from(cause));
  read_layouts(entry, paper);
  if (entry.has("further")) paper.further = ClaimsFile{std::string(text), origin};
  entry.refuse_unknown();
  check_ids(paper, origin);
  check_references(paper, origin);
  return paper;
}

Paper layouts_of(const Paper& named, const UnnamedGround& ground,
                 const std::function<bool(std::string_view metric)>& has) {
  const auto& [text, origin] = *named.further;
  const toml::table table = parse_toml(text, origin, "correct the claims file");
  TomlFile file{origin, {}};
  read_sets(table, file);
  replace_sets(table, SetMember{{{"name", ground.id}, {"label", ground.label}}}, has, file);
  file.ground_id = ground.id;
  file.ground_name = ground.name;
  TomlTable entry({&table, &file, {}});
  Paper paper{named.id, named.title, {}, "", {}, {}, {}};
  paper.pages = named.pages;  // tables may stand on these
  read_layouts(entry, paper);
  const auto elsewhere = [&](const auto& layout) { return layout.page != ground.id; };
  std::erase_if(paper.pages, [&](const PageLayout& page) { return page.id != ground.id; });
  std::erase_if(paper.tables, elsewhere);
  std::erase_if(paper.plots, elsewhere);
  std::erase_if(paper.rankings, [&](const RankingLayout& ranking) {
    return ranking.entries.empty() ||
           std::ranges::any_of(ranking.entries, [&](const RankingLayout::Entry& entry) {
             return entry.case_name != ground.name && !entry.case_name.starts_with(ground.name + "/");
           });
  });
  if (paper.pages.size() != 1) entry.refuse("[further] must leave one [[page]] for a further ground");
  paper.pages[0].label = ground.label;
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

}  // namespace terrabench
