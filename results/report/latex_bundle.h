// The report for a paper of one's own: main.tex, tables/*.tex, figures/*.pdf, pictures/*.png and
// references.bib in one folder, which `latexmk -pdf` compiles (Debian: latexmk, texlive-latex-recommended,
// lmodern). Takes seconds; measures nothing.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "results/claims/claims.h"
#include "results/store/store.h"

namespace terrabench {

struct WrittenBundle {
  std::filesystem::path main;  // main.tex
  // Pictures that the bundle should show but that are missing, altered or not readable: their files, relative
  // to the results folder.
  std::vector<std::string> left_out = {};
  std::vector<std::string> faults = {};  // why its results cannot be trusted; empty if they can
};

// Writes the tables, plots and pictures of `results`, a results folder, into the folder `target`, which
// appears whole or not at all and replaces an earlier bundle. Each plot is there twice: figures/ID.pdf, a
// column wide (84 mm), and figures/ID-page.pdf, a page wide (174 mm), letters about 8 pt high, fonts
// embedded. The pictures are those that claims judge and that pages of grounds show, byte for byte as they
// were drawn; main.tex names those that are left out. Each ground that no claims file names, such as a user's
// DEM, has a section (further_grounds.h). Equal measurements give equal bytes. O(bytes of the
// measurements + pixels of the pictures). Throws bad_input when `results` holds no measurements
// of the profile (as Store::open()), environment_error when `target` holds anything else or cannot be
// written. Not thread-safe.
WrittenBundle write_latex_bundle(const std::filesystem::path& results, const std::filesystem::path& target,
                                 const std::string& profile = "");
WrittenBundle write_latex_bundle(const Store&, std::span<const Paper>, const std::filesystem::path& target);

}  // namespace terrabench
