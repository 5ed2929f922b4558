#include "results/store/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <utility>

#include "terrain/number.h"
#include "terrain/separators.h"

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
    out += known ? it->second : text.substr(0, 1);
    text.remove_prefix(known ? it->first.size() : 1);
  }
  return out;
}

bool is_formula(std::string_view text) {
  constexpr std::string_view kBetween = " … ";
  if (text.empty() || std::string_view("=+-@\t\r").find(text[0]) == std::string_view::npos) return false;
  const std::size_t at = text.find(kBetween);
  if (at == text.npos) return !parse_number<double>(text);
  return !parse_number<double>(text.substr(0, at)) ||
         !parse_number<double>(text.substr(at + kBetween.size()));
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

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (lines.empty() || characters(lines.back()) + 1 + characters(word) > width) {
      lines.emplace_back(word);
    } else {
      lines.back().append(" ").append(word);
    }
  }
  return lines;
}

std::string list_of(const std::vector<std::string>& parts, std::string_view between, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? last : between;
    text += parts[i];
  }
  return text;
}

std::string escape_html(std::string_view text) {
  constexpr Replacement kHtml[] = {
      {"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}};
  return replace(printable(text), kHtml);
}

std::string escape_markdown(std::string_view text) {
  constexpr Replacement kMarkdown[] = {
      {"\\", "\\\\"}, {"|", "\\|"},  {"*", "\\*"}, {"_", "\\_"},   {"`", "\\`"}, {"[", "\\["}, {"]", "\\]"},
      {"<", "&lt;"},  {">", "&gt;"}, {"#", "\\#"}, {"&", "&amp;"}, {"~", "\\~"}, {"$", "\\$"}};
  return replace(printable(text), kMarkdown);
}

std::string escape_markdown_target(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        std::isalnum(byte) != 0 || std::string_view("-._~/#%").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return out;
}

std::string escape_csv(std::string_view text) {
  const std::string mark = is_formula(text) ? "'" : "";
  if (text.find_first_of(",\"\r\n") == text.npos) return mark + std::string(text);
  std::string out = "\"" + mark;
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace terrabench
