#include "results/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace terrabench {
namespace {

using Replacement = std::pair<std::string_view, std::string_view>;

std::string replace(std::string_view text, std::span<const Replacement> replacements) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto it = std::find_if(replacements.begin(), replacements.end(),
                                 [&](const Replacement& r) { return text.starts_with(r.first); });
    const bool known = it != replacements.end();
    // Control characters become spaces: they would break a table's row or a terminal's line.
    const char c = text[0];
    if (known) {
      out += it->second;
    } else {
      out += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    }
    text.remove_prefix(known ? it->first.size() : 1);
  }
  return out;
}

std::string with_separators(std::string digits) {
  const std::size_t sign = digits.starts_with('-') ? 1 : 0;
  for (std::size_t at = digits.size(); at > sign + 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

}  // namespace

std::string format_number(double number) {
  if (number == std::trunc(number) && std::abs(number) < 1e15) {
    return with_separators(fmt::format("{:.0f}", number == 0 ? 0.0 : number));
  }
  if (std::abs(number) >= 1000 && std::abs(number) < 1e15)
    return with_separators(fmt::format("{:.0f}", number));
  return fmt::format("{:.4g}", number);
}

std::string format_quantity(double number, std::string_view unit) {
  return unit.empty() ? format_number(number) : format_number(number) + " " + std::string(unit);
}

std::string format_exact(double number) { return fmt::format("{}", number); }

std::string escape_html(std::string_view text) {
  constexpr Replacement kHtml[] = {
      {"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}};
  return replace(text, kHtml);
}

std::string escape_markdown(std::string_view text) {
  constexpr Replacement kMarkdown[] = {
      {"\\", "\\\\"}, {"|", "\\|"},  {"*", "\\*"}, {"_", "\\_"},   {"`", "\\`"}, {"[", "\\["}, {"]", "\\]"},
      {"<", "&lt;"},  {">", "&gt;"}, {"#", "\\#"}, {"&", "&amp;"}, {"~", "\\~"}, {"$", "\\$"}};
  return replace(text, kMarkdown);
}

std::string escape_csv(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace terrabench
