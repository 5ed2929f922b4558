// The report for a paper of one's own: main.tex, tables/*.tex, figures/*.pdf and references.bib in one
// folder, which `latexmk -pdf` compiles (Debian: latexmk, texlive-latex-recommended, lmodern). Takes seconds;
// measures nothing.
#pragma once

#include <filesystem>
#include <span>

#include "results/claims.h"
#include "results/store.h"

namespace terrabench {

// Writes the tables and plots of `results`, a results folder, into the folder `target`, which appears whole
// or not at all and replaces an earlier bundle. Each plot is there twice: figures/ID.pdf, a column wide (84
// mm), and figures/ID-page.pdf, a page wide (174 mm), letters about 8 pt high, fonts embedded. Equal
// measurements give equal bytes. Returns the path of main.tex. Throws bad_input when `results` holds none,
// environment_error when `target` holds anything else or cannot be written. Not thread-safe.
std::filesystem::path write_latex_bundle(const std::filesystem::path& results,
                                         const std::filesystem::path& target);
std::filesystem::path write_latex_bundle(const Store&, std::span<const Paper>,
                                         const std::filesystem::path& target);

}  // namespace terrabench
