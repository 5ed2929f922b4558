// How the papers and this program are cited: the `[reference]` of each claims file, as BibTeX and as a line
// of text.
#pragma once

#include <span>
#include <string>

#include "results/claims/claims.h"

namespace terrabench {

// "A. Author and B. Author: Title. Institution." Of what the paper's text states; a supplied title is in
// brackets.
std::string reference_text(const Reference&);

// The key of a paper's BibTeX entry, such as "paper:drill".
std::string citation_key(const Paper&);
// "0.1.0, git revision 4dbc16f…", of the program, which says if it was built from uncommitted changes.
std::string version();
// An entry per paper that has a reference, and one for this program at the revision it was built from. Fields
// that a paper's text does not state are absent, and `note` names them. Needs BibTeX or biber, and UTF-8.
std::string bibtex(std::span<const Paper>);

}  // namespace terrabench
