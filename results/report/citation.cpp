#include "results/report/citation.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "results/build_info.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

using Fields = std::vector<std::pair<std::string_view, std::string>>;

// BibTeX counts braces also after a backslash.
std::string escaped(std::string_view text) {
  std::string out;
  for (;;) {
    const std::size_t brace = std::min(text.find_first_of("{}"), text.size());
    out += escape_latex(text.substr(0, brace));
    if (brace == text.size()) return out;
    out += text[brace] == '{' ? "\\textbraceleft{}" : "\\textbraceright{}";
    text.remove_prefix(brace + 1);
  }
}

std::string joined(const std::vector<std::string>& authors, std::string_view between, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < authors.size(); ++i) {
    if (i > 0) text += i + 1 == authors.size() ? last : between;
    text += authors[i];
  }
  return text;
}

std::string title_of(const Reference& reference) {
  return reference.title.empty() ? "[" + reference.subject + "]" : reference.title;
}

std::string unstated(const Reference& reference) {
  std::vector<std::string> missing;
  if (reference.authors.empty()) missing.emplace_back("authors");
  if (reference.title.empty()) missing.emplace_back("title");
  if (reference.year == 0) missing.emplace_back("year");
  missing.emplace_back("place of publication");
  return "Not stated in the text that was reproduced: " + joined(missing, ", ", " and ");
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
    for (const std::string& author : reference.authors) authors.push_back(escaped(author));
    fields.emplace_back("author", joined(authors, " and ", " and "));
  } else {
    fields.emplace_back("key", paper.id);  // BibTeX sorts by it in place of authors
  }
  // Inner braces keep the title's capitals.
  fields.emplace_back("title", fmt::format("{{{}}}", escaped(title_of(reference))));
  if (!reference.institution.empty()) fields.emplace_back("howpublished", escaped(reference.institution));
  if (reference.year != 0) fields.emplace_back("year", std::to_string(reference.year));
  fields.emplace_back("note", escaped(unstated(reference)));
  return entry(citation_key(paper), fields);
}

std::string program_entry() {
  return entry("terrabench",
               {{"author", "{The terrabench authors}"},
                {"title", "{terrabench: five terrain papers, measured again and against each other}"},
                {"howpublished", "Computer program"},
                {"note", fmt::format("Version {}, git revision {}{}", TERRABENCH_VERSION, kGitRevision,
                                     kGitDirty ? " with uncommitted changes" : "")}});
}

}  // namespace

std::string reference_text(const Reference& reference) {
  std::string text = joined(reference.authors, ", ", " and ");
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
