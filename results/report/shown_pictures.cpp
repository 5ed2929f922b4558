#include "results/report/shown_pictures.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "results/report/ground_name.h"

namespace terrabench {
namespace {

// Whether a claim of class F is about this figure. Claims of other classes may have it as a condition too.
bool has_own_claim(std::span<const Judgement> judgements, const std::string& figure) {
  return std::ranges::any_of(judgements, [&](const Judgement& j) {
    return j.claim->claim_class == 'F' &&
           std::ranges::count(j.claim->conditions, figure, &Condition::figure) > 0;
  });
}

// "(a) ROAM" or "a) ROAM", with the letter that comes after `before` panels.
bool names_panel(std::string_view words, std::size_t before) {
  if (words.starts_with('(')) words.remove_prefix(1);
  return words.size() > 3 && words[0] == static_cast<char>('a' + before) && words.substr(1, 2) == ") ";
}

}  // namespace

std::vector<NamedPanel> comparable_panels(const FigureLayout& layout) {
  constexpr int kRounding = 2;  // pixels
  std::vector<NamedPanel> named;
  const std::vector<FigurePanel>& panels = layout.panels;
  for (const std::string& words : layout.words) {
    if (named.size() == panels.size() || !names_panel(words, named.size())) continue;
    const FigurePanel& p = panels[named.size()];
    if (std::abs(p.width - panels[0].width) > kRounding || std::abs(p.height - panels[0].height) > kRounding)
      return {};
    named.push_back({words, p.x, p.y, panels[0].width, panels[0].height});
  }
  return named.size() == panels.size() && named.size() > 1 ? named : std::vector<NamedPanel>();
}

std::vector<ShownPicture> claimed_pictures(const Store& store, const JudgedResults& results,
                                           const Paper& paper) {
  std::vector<ShownPicture> pictures;
  const auto judgements = results.of(paper);
  for (const Judgement& judgement : judgements) {
    const Claim& claim = *judgement.claim;
    for (const Condition& condition : claim.conditions) {
      const auto [record, figure] = store.find_figure(condition.figure, results.profile);
      if (figure == nullptr || (claim.claim_class != 'F' && has_own_claim(judgements, figure->id))) continue;
      pictures.push_back({record, figure, claim.where, claim.statement + " " + figure->caption});
    }
  }
  return pictures;
}

std::vector<ShownPicture> drawn_pictures(const Store& store, std::string_view profile,
                                         std::span<const PageLayout::Drawn> cases, std::string_view label) {
  std::vector<ShownPicture> pictures;
  for (const PageLayout::Drawn& drawn : cases) {
    const Record* const record = store.find(drawn.experiment, drawn.case_name, profile);
    if (record == nullptr) continue;
    for (const RecordedFigure& figure : record->figures) {
      const auto labelled = [&](std::string text) {
        return with_label(std::move(text), record->terrain, label);
      };
      pictures.push_back({record, &figure, labelled(record->experiment + " " + record->case_name),
                          labelled(figure.caption)});
    }
  }
  return pictures;
}

}  // namespace terrabench
