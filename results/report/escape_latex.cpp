#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "results/store/format.h"

namespace terrabench {
namespace {

using Replacement = std::pair<std::string_view, std::string_view>;

constexpr Replacement kReplacements[] = {
    {"--", "-{}"},  // of the first dash alone: LaTeX would join two, as in options
    {"\\", "\\textbackslash{}"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"$", "\\$"},
    {"&", "\\&"},
    {"#", "\\#"},
    {"%", "\\%"},
    {"_", "\\_"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    {"\"", "\\textquotedbl{}"},
    {"`", "\\textasciigrave{}"},
    {"\u00a0", "~"},
    {"°", "\\textdegree{}"},
    {"§", "\\S{}"},
    {"·", "\\textperiodcentered{}"},
    {"⁰", "\\textsuperscript{0}"},
    {"¹", "\\textsuperscript{1}"},
    {"²", "\\textsuperscript{2}"},
    {"³", "\\textsuperscript{3}"},
    {"⁴", "\\textsuperscript{4}"},
    {"⁵", "\\textsuperscript{5}"},
    {"⁶", "\\textsuperscript{6}"},
    {"⁷", "\\textsuperscript{7}"},
    {"⁸", "\\textsuperscript{8}"},
    {"⁹", "\\textsuperscript{9}"},
    {"⁻", "\\textsuperscript{$-$}"},
    {"ⁿ", "\\textsuperscript{n}"},
    {"₀", "\\textsubscript{0}"},
    {"₁", "\\textsubscript{1}"},
    {"₂", "\\textsubscript{2}"},
    {"₃", "\\textsubscript{3}"},
    {"×", "$\\times$"},
    {"÷", "$\\div$"},
    {"–", "--"},
    {"—", "---"},
    {"…", "\\ldots{}"},
    {"“", "\\textquotedblleft{}"},
    {"”", "\\textquotedblright{}"},
    {"‘", "\\textquoteleft{}"},
    {"’", "\\textquoteright{}"},
    {"″", "$''$"},
    {"′", "$'$"},
    {"≥", "$\\geq$"},
    {"≤", "$\\leq$"},
    {"≠", "$\\neq$"},
    {"≈", "$\\approx$"},
    {"±", "$\\pm$"},
    {"√", "$\\surd$"},
    {"∞", "$\\infty$"},
    {"−", "$-$"},
    {"→", "$\\to$"},
    {"↔", "$\\leftrightarrow$"},
    {"µ", "$\\mu$"},
    {"α", "$\\alpha$"},
    {"β", "$\\beta$"},
    {"γ", "$\\gamma$"},
    {"δ", "$\\delta$"},
    {"Δ", "$\\Delta$"},
    {"ε", "$\\varepsilon$"},
    {"θ", "$\\theta$"},
    {"λ", "$\\lambda$"},
    {"μ", "$\\mu$"},
    {"π", "$\\pi$"},
    {"ρ", "$\\rho$"},
    {"σ", "$\\sigma$"},
    {"τ", "$\\tau$"},
    {"φ", "$\\varphi$"},
    {"ω", "$\\omega$"}};

// The first character of the text, with its length in bytes; 0xFFFD for a byte that begins none.
std::pair<std::uint32_t, std::size_t> first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead < 0x80 ? 1 : lead >= 0xF0 && lead < 0xF5 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (length == 1) return {lead, 1};
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return {0xFFFD, 1};
  std::uint32_t code = lead & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {0xFFFD, 1};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  return {code, length};
}

// Latin letters that LaTeX's T1 encoding has; it knows them in UTF-8.
bool in_t1(std::uint32_t code) {
  constexpr std::uint32_t kMissing[] = {0x126, 0x127, 0x138, 0x13F, 0x140, 0x149, 0x166, 0x167};
  return code >= 0xC0 && code < 0x17F && std::ranges::count(kMissing, code) == 0;
}

}  // namespace

std::string escape_latex(std::string_view utf8) {
  const std::string plain = printable(utf8);
  std::string_view text = plain;
  std::string out;
  while (!text.empty()) {
    const auto* const known =
        std::ranges::find_if(kReplacements, [&](const Replacement& r) { return text.starts_with(r.first); });
    if (known != std::end(kReplacements)) {
      out += known->second;
      text.remove_prefix(known->first == "--" ? 1 : known->first.size());
      continue;
    }
    const auto [code, length] = first_character(text);
    if (code < 0x80 || in_t1(code)) {
      out += text.substr(0, length);
    } else {
      out += code == 0xFFFD ? "?" : fmt::format("[U+{:04X}]", code);  // LaTeX would stop at it
    }
    text.remove_prefix(length);
  }
  return out;
}

}  // namespace terrabench
