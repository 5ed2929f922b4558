// The report's own tables, which no claims file lays out: verdicts, notes, provenance.
#pragma once

#include <span>
#include <string>

#include "results/claims/judge.h"
#include "results/report/document.h"

namespace terrabench {

// "Of 130 statements of the papers in numbers or comparisons, 100 hold as printed, …": a sentence per group.
std::string standings_sentence(const JudgedResults&);
// How many statements of each paper, and of all, hold: one row per paper.
Table summary_table(const JudgedResults&, std::span<const Paper>);
// The notes of one paper's claims.
Facts claim_notes(const JudgedResults&, const Paper&);

// "Table 1: memory grows …"; what the paper prints, with its unit, or a dash.
std::string where_and_statement(const Claim&);
std::string reported_text(const Claim&);

// The id as the name of a file or of a label: other characters than letters, digits, '.', '-', '_' become
// '_', and a digest follows, so that no two ids have the same name.
std::string file_name(std::string_view id);
// A relative path as part of a link: what is not a letter, a digit or one of "-._~/" is percent-encoded.
std::string url_path(std::string_view path);
// The name of the page of a ground or a paper, without its extension: "ground-caves", "paper-ght".
std::string ground_page(std::string_view ground);
inline std::string paper_page(const Paper& paper) { return "paper-" + paper.id; }
// The pages of grounds, with links.
Table ground_table(std::string id, std::string title, std::span<const PageLayout>);

// The picture, relative to the report's folder.
inline std::string picture_file(const RecordedFigure& figure) { return "../" + url_path(figure.file); }

// Where the numbers come from: each run that a record names, and every case of a profile with its seed,
// terrain and parameters.
Document provenance(const Store&);
// Cases without measurements and metrics without a value, by reason.
Table absence_table(const JudgedResults&);
Table input_table(const Store&, std::string_view profile);
// Runs are named by the start of their digest, and have an anchor in the page of runs.
std::string short_id(const std::string& run);
std::string run_anchor(const std::string& run);

}  // namespace terrabench
