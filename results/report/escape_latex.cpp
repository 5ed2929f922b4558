#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "results/store/format.h"

namespace terrabench {
namespace {

// Characters, each followed by what its replacement has between `before` and `after`.
struct Form {
  std::string_view before, characters, after;
};
constexpr Form kForms[] = {
    {"\\", "{{ }} $$ && ## %% __", ""},
    {"\\",
     "\\textbackslash ~textasciitilde ^textasciicircum <textless >textgreater |textbar \"textquotedbl "
     "`textasciigrave °textdegree §S ·textperiodcentered …ldots “textquotedblleft ”textquotedblright "
     "‘textquoteleft ’textquoteright",
     "{}"},
    {"\\textsuperscript{", "⁰0 ¹1 ²2 ³3 ⁴4 ⁵5 ⁶6 ⁷7 ⁸8 ⁹9 ⁻$-$ ⁿn", "}"},
    {"\\textsubscript{", "₀0 ₁1 ₂2 ₃3", "}"},
    {"$\\",
     "×times ÷div ≥geq ≤leq ≠neq ≈approx ±pm √surd ∞infty →to ↔leftrightarrow µmu αalpha βbeta γgamma δdelta "
     "ΔDelta εvarepsilon θtheta λlambda μmu πpi ρrho σsigma τtau φvarphi ωomega",
     "$"},
    {"", "\u00a0~ –-- —--- ″$''$ ′$'$ −$-$", ""}};

std::map<std::string, std::string, std::less<>> replacements() {
  std::map<std::string, std::string, std::less<>> all;
  for (const auto& [before, characters, after] : kForms) {
    for (const std::string& word : wrap(characters, 0)) {
      const std::size_t length = decode(word)->bytes;
      all.emplace(word.substr(0, length), fmt::format("{}{}{}", before, word.substr(length), after));
    }
  }
  return all;
}

// Latin letters that LaTeX's T1 encoding has; it knows them in UTF-8.
bool in_t1(char32_t code) {
  constexpr char32_t kMissing[] = {0x126, 0x127, 0x138, 0x13F, 0x140, 0x149, 0x166, 0x167};
  return code >= 0xC0 && code < 0x17F && std::ranges::count(kMissing, code) == 0;
}

}  // namespace

std::string escape_latex(std::string_view utf8) {
  const std::string plain = printable(utf8);
  std::string_view text = plain;
  std::string out;
  static const auto kReplacements = replacements();
  while (!text.empty()) {
    const auto [code, length] = decode(text).value_or(Character{0xFFFD, 1});
    const auto known = kReplacements.find(text.substr(0, length));
    if (text.starts_with("--")) {
      out += "-{}";  // LaTeX would join two, as in options
    } else if (known != kReplacements.end()) {
      out += known->second;
    } else if (code < 0x80 || in_t1(code)) {
      out += text.substr(0, length);
    } else {
      out += code == 0xFFFD
                 ? "?"
                 : fmt::format("[U+{:04X}]", static_cast<unsigned>(code));  // LaTeX would stop at it
    }
    text.remove_prefix(length);
  }
  return out;
}

}  // namespace terrabench
