#include "results/report/citation.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "results/build_info.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

using Fields = std::vector<std::pair<std::string_view, std::string>>;

std::string title_of(const Reference& reference) {
  return reference.title.empty() ? "[" + reference.subject + "]" : reference.title;
}

std::string unstated(const Reference& reference) {
  std::vector<std::string> missing;
  if (reference.authors.empty()) missing.emplace_back("authors");
  if (reference.title.empty()) missing.emplace_back("title");
  if (reference.year == 0) missing.emplace_back("year");
  missing.emplace_back("place of publication");
  return "Not stated in the text that was reproduced: " + list_of(missing, ", ", " and ");
}

std::string entry(std::string_view key, const Fields& fields) {
  std::string text = fmt::format("@misc{{{},\n", key);
  for (const auto& [name, value] : fields) text += fmt::format("  {} = {{{}}},\n", name, value);
  return text + "}\n";
}

std::string paper_entry(const Paper& paper) {
  const Reference& reference = *paper.reference;
  Fields fields;
  if (!reference.authors.empty()) {
    std::vector<std::string> authors;
    for (const std::string& author : reference.authors) authors.push_back(escape_latex(author));
    fields.emplace_back("author", list_of(authors, " and ", " and "));
  } else {
    fields.emplace_back("key", paper.id);  // BibTeX sorts by it in place of authors
  }
  // Inner braces keep the title's capitals.
  fields.emplace_back("title", fmt::format("{{{}}}", escape_latex(title_of(reference))));
  if (!reference.institution.empty())
    fields.emplace_back("howpublished", escape_latex(reference.institution));
  if (reference.year != 0) fields.emplace_back("year", std::to_string(reference.year));
  fields.emplace_back("note", escape_latex(unstated(reference)));
  return entry(citation_key(paper), fields);
}

std::string program_entry() {
  return entry("terrabench",
               {{"author", "{The terrabench authors}"},
                {"title", "{terrabench: five terrain papers, measured again and against each other}"},
                {"howpublished", "Computer program"},
                {"note", "Version " + version()}});
}

}  // namespace

std::string version() {
  return fmt::format("{}, git revision {}{}", TERRABENCH_VERSION, kGitRevision,
                     kGitDirty ? " with uncommitted changes" : "");
}

std::string reference_text(const Reference& reference) {
  std::string text = list_of(reference.authors, ", ", " and ");
  text += fmt::format("{}{}.", text.empty() ? "" : ": ", title_of(reference));
  if (!reference.institution.empty()) text += fmt::format(" {}.", reference.institution);
  if (reference.year != 0) text += fmt::format(" {}.", reference.year);
  return text;
}

std::string citation_key(const Paper& paper) { return "paper:" + paper.id; }

std::string bibtex(std::span<const Paper> papers) {
  std::string text;
  for (const Paper& paper : papers) {
    if (paper.reference) text += paper_entry(paper) + "\n";
  }
  return text + program_entry();
}

}  // namespace terrabench
