// LaTeX of tables, laid out for a page 174 mm wide: a table that is too wide gets a smaller font, is turned
// so that its columns become rows, or gets a landscape page, whichever helps first.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "results/report/report_tables.h"
#include "results/report/table.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

constexpr double kMillimetre = 72.27 / 25.4;  // in TeX points, as all widths here
constexpr double kPortrait = 174 * kMillimetre, kLandscape = 247 * kMillimetre;
constexpr double kGap = 6;            // between columns
constexpr std::size_t kNatural = 28;  // characters; columns of text with a longer cell are broken into lines
constexpr std::size_t kTurned = 12;   // rows of the largest table that is turned
constexpr int kFloating = 45;         // lines of the largest table that is not broken across pages

struct Font {
  const char* name;
  double character;  // a digit's width; letters are narrower on average
};
constexpr Font kFootnote{"footnotesize", 4.5}, kScript{"scriptsize", 4.2}, kTiny{"tiny", 3.5};

std::size_t characters(std::string_view utf8) {
  return static_cast<std::size_t>(std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) all.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return all;
}

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  for (const std::string& word : words(text)) longest = std::max(longest, characters(word));
  return longest;
}

// Lines of at most `width` characters, unless a word is longer.
std::vector<std::string> lines_of(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  for (const std::string& word : words(text)) {
    if (lines.empty() || characters(lines.back()) + 1 + characters(word) > width) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

// A number as people write it: 1.5e-07 as 1.5 × 10⁻⁷, -3 with a minus sign. Empty for other words.
std::string number(const std::string& word) {
  if (word.find_first_not_of("0123456789.,e+-") != word.npos) return "";
  const bool negative =
      word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) != 0;
  const std::string sign = negative ? "-" : "", rest = word.substr(sign.size());
  const std::size_t e = rest.find('e');
  const bool plain = !rest.empty() && std::isdigit(static_cast<unsigned char>(rest[0])) != 0 &&
                     rest.find_first_of("+-") >= e;
  if (!plain) return "";
  if (e == rest.npos) return negative ? "$-$" + rest : "";
  char* end = nullptr;
  const long power = std::strtol(rest.c_str() + e + 1, &end, 10);
  if (e + 1 == rest.size() || *end != 0) return "";
  return fmt::format("${}{}\\times10^{{{}}}$", sign, rest.substr(0, e), power);
}

// As printed: "1.5e-07" becomes longer.
std::size_t printed(std::string_view text) {
  std::size_t count = characters(text);
  for (const std::string& word : words(text)) {
    if (number(word).find("times") != std::string::npos) count += 3;
  }
  return count;
}

// `breakable`: lines may be broken inside ids and paths too.
std::string cell_latex(std::string_view text, bool breakable) {
  std::string out;
  for (const std::string& word : words(text)) {
    if (!out.empty()) out += ' ';
    const std::string figure = number(word);
    if (!figure.empty()) {
      out += figure;
      continue;
    }
    const bool split = breakable && characters(word) > 12;
    for (std::size_t begin = 0; begin < word.size();) {
      const std::size_t at = split ? word.find_first_of("./=-_,", begin) : word.npos;
      const std::size_t stop = at == word.npos ? word.size() : at + 1;
      out += escape_latex(std::string_view(word).substr(begin, stop - begin));
      if (stop < word.size()) out += "\\allowbreak{}";
      begin = stop;
    }
  }
  // After the end of a row, LaTeX would take these for its option.
  if (out.starts_with('[') || out.starts_with('*')) out.insert(0, "{}");
  return out;
}

// How one table is set in one font at one width.
class Setting {
 public:
  // Nothing if it does not fit. `anyhow`: then with columns as narrow as their words.
  static std::optional<Setting> fit(const Table& table, const Font& font, double width, bool anyhow = false) {
    Setting setting(table, font);
    return setting.fill(width) || anyhow ? std::optional(setting) : std::nullopt;
  }

  // `landscape`: on a page of its own.
  std::string latex(bool landscape) const {
    const std::string caption =
        fmt::format("  \\caption{{{}. {}}}\n  \\label{{tab:{}}}", escape_latex(table_.title),
                    escape_latex(table_.caption), file_name(table_.id));
    const std::string sizes =
        fmt::format("  \\{}\n  \\setlength{{\\tabcolsep}}{{{}pt}}\n", font_.name, kGap / 2);
    const bool floating = !landscape && height() <= kFloating;
    std::string text;
    if (floating) {
      text = "\\begin{table}[htbp]\n  \\centering\n" + caption + "\n" + sizes + "  \\begin{tabular}{" +
             columns() + "}\n  \\toprule\n" + headings() + "  \\midrule\n" + rows() +
             "  \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
    } else {
      text = "{\n" + sizes + "  \\begin{longtable}{" + columns() + "}\n" + caption + "\\\\\n  \\toprule\n" +
             headings() + "  \\midrule\n  \\endfirsthead\n  \\toprule\n" + headings() +
             "  \\midrule\n  \\endhead\n  \\bottomrule\n  \\endfoot\n" + rows() + "  \\end{longtable}\n}\n";
    }
    return landscape ? "\\begin{landscape}\n" + text + "\\end{landscape}\n" : text;
  }

 private:
  struct Width {
    std::size_t cell = 0, heading = 0;  // characters
    double text = 0;                    // square root of all characters, the column's claim to room
    bool broken = false;                // into lines of `points`
    double points = 0;
  };

  Setting(const Table& table, const Font& font) : table_(table), font_(font), widths_(table.columns.size()) {
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      Width& width = widths_[i];
      std::size_t all = 0;
      for (const auto& row : table.rows) {
        width.cell = std::max(width.cell, printed(row[i].text));
        all += characters(row[i].text);
      }
      width.heading = std::max({width.cell, longest_word(heading(table.columns[i])), std::size_t{4}});
      width.text = std::sqrt(static_cast<double>(all));
      width.broken = !table.columns[i].numeric && width.cell > kNatural;
    }
  }

  // Its longest cell takes about three lines, or more where that would leave no room for others.
  double narrowest(const Width& w) const {
    return std::clamp(static_cast<double>(w.cell) / 3, 13.0, 28.0) * font_.character;
  }

  bool fill(double width) {
    double left = width - kGap * static_cast<double>(widths_.size() - 1), claims = 0, least = 0;
    for (const Width& w : widths_) {
      if (w.broken) {
        claims += w.text;
        least += narrowest(w);
      } else {
        left -= static_cast<double>(w.heading) * font_.character;
      }
    }
    const bool fits = left >= least;
    const double share = std::max(0.0, left - least);
    for (Width& w : widths_) {
      if (!w.broken) continue;
      w.points = std::min(narrowest(w) + share * w.text / claims,
                          std::max(narrowest(w), static_cast<double>(w.cell) * font_.character));
    }
    return fits;
  }

  int height() const {
    double lines = 0;
    for (const auto& row : table_.rows) {
      double most = 1;
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (!widths_[i].broken) continue;
        most = std::max(most, std::ceil(static_cast<double>(characters(row[i].text)) * font_.character /
                                        widths_[i].points));
      }
      lines += most;
    }
    return static_cast<int>(lines);
  }

  std::string columns() const {
    std::string text = "@{}";
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      if (widths_[i].broken) {
        text += fmt::format(">{{\\raggedright\\arraybackslash}}p{{{:.1f}pt}}", widths_[i].points);
      } else {
        text += table_.columns[i].numeric ? "r" : "l";
      }
    }
    return text + "@{}";
  }

  std::string headings() const {
    std::string text = "  ";
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      if (i > 0) text += " & ";
      const Column& column = table_.columns[i];
      if (widths_[i].broken) {
        text += cell_latex(heading(column), false);
        continue;
      }
      std::string lines;
      for (const std::string& line : lines_of(heading(column), widths_[i].heading)) {
        lines += (lines.empty() ? "" : "\\\\") + cell_latex(line, false);
      }
      text += fmt::format("\\begin{{tabular}}[b]{{@{{}}{}@{{}}}}{}\\end{{tabular}}",
                          column.numeric ? "r" : "l", lines);
    }
    return text + " \\\\\n";
  }

  std::string rows() const {
    std::string text;
    for (const auto& row : table_.rows) {
      text += "  ";
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (i > 0) text += " & ";
        text += cell_latex(row[i].text, widths_[i].broken);
      }
      text += " \\\\\n";
    }
    return text;
  }

  const Table& table_;
  const Font& font_;
  std::vector<Width> widths_;
};

// The columns as rows, each led by its heading. The first column's cells become headings.
Table turned(const Table& table) {
  Table turned{table.id, table.title, table.caption, {{table.columns[0].title}}, {}};
  for (const auto& row : table.rows) turned.columns.push_back({row[0].text, "", true});
  for (std::size_t i = 1; i < table.columns.size(); ++i) {
    std::vector<Cell> cells = {{heading(table.columns[i])}};
    for (const auto& row : table.rows) cells.push_back(row[i]);
    turned.rows.push_back(std::move(cells));
  }
  return turned;
}

}  // namespace

std::string latex(const Table& table) {
  for (const Font* const font : {&kFootnote, &kScript}) {
    if (const auto setting = Setting::fit(table, *font, kPortrait)) return setting->latex(false);
  }
  if (table.rows.size() <= kTurned && table.columns.size() > 1) {
    const Table other = turned(table);
    for (const Font* const font : {&kFootnote, &kScript}) {
      if (const auto setting = Setting::fit(other, *font, kPortrait)) return setting->latex(false);
    }
  }
  if (const auto setting = Setting::fit(table, kScript, kLandscape)) return setting->latex(true);
  return Setting::fit(table, kTiny, kLandscape, true)->latex(true);
}

}  // namespace terrabench
