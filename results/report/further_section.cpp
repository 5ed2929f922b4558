#include "results/report/further_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "results/report/report_tables.h"

namespace terrabench {
namespace {

std::vector<Answer> answers_elsewhere(const Store* reference) {
  if (reference == nullptr) return {reference_answers().begin(), reference_answers().end()};
  return answers(rank(ranking_layouts(), *reference, reference->profile()));
}

// What its reader said, and what is to be known before the answers are believed.
Document about(const FurtherGround& ground, const Store& store) {
  Document about;
  const auto record = std::ranges::find(store.records(), ground.name, &Record::terrain);
  if (record != store.records().end() && !record->terrain_notes.empty())
    about.push_back(Paragraph{fmt::format("{}: {}.", ground.label, fmt::join(record->terrain_notes, "; "))});
  for (const std::string& warning : ground.warnings)
    about.push_back(Paragraph{fmt::format("Ground {}. {}", ground.label, warning), true});
  return about;
}

Document faults_of(const Store* reference) {
  if (reference == nullptr || reference->faults().empty()) return {};
  return {Paragraph{fmt::format("The results that these are compared with cannot be trusted: {} faults",
                                reference->faults().size()),
                    true}};
}

}  // namespace

FurtherSection further_section(const Store& store, const std::string& profile, const ReportOptions& options,
                               std::span<const FurtherGround> grounds, std::span<const PageLayout> pages,
                               ReportParts& parts) {
  FurtherSection section;
  for (const PageLayout& page : pages) {
    std::vector<PageLayout::Drawn> shown = page.sheets;
    if (!page.pictures.empty()) shown.insert(shown.begin(), page.pictures.front());
    for (const PageLayout::Drawn& drawn : shown) {
      append(section.pictures,
             parts.pictures(drawn_pictures(store, profile, std::span(&drawn, 1), page.label)));
    }
  }
  std::vector<FilledTable> tables = tables_of_further_grounds(
      grounds, {store, profile}, answers_elsewhere(options.reference), options.purpose);
  if (pages.empty() && tables.empty()) return section;
  if (!tables.empty()) append(section.blocks, faults_of(options.reference));
  for (const FurtherGround& ground : grounds) append(section.blocks, about(ground, store));
  for (FilledTable& filled : tables) {
    section.advice += advice_text(filled.table);
    section.blocks.push_back(parts.table(std::move(filled)));
  }
  if (!pages.empty())
    section.blocks.push_back(
        TableBlock{ground_table("further.grounds", "All that was measured there", pages), {}});
  return section;
}

}  // namespace terrabench
