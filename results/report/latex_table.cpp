// LaTeX of tables, laid out for a page 174 mm wide: a table that is too wide gets a smaller font, or a
// landscape page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>

#include "results/report/report_tables.h"
#include "results/report/table.h"
#include "results/store/format.h"

namespace terrabench {
namespace {

constexpr double kMillimetre = 72.27 / 25.4;  // in TeX points, as all widths here
constexpr double kPortrait = 174 * kMillimetre, kLandscape = 247 * kMillimetre;
constexpr double kGap = 6;            // between columns
constexpr std::size_t kNatural = 28;  // characters; columns of text with a longer cell are broken into lines

struct Font {
  const char* name;
  double character;  // a digit's width; letters are narrower on average
};
constexpr Font kFootnote{"footnotesize", 4.5}, kScript{"scriptsize", 4.2}, kTiny{"tiny", 3.5};

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  for (const std::string& word : wrap(text, 0)) longest = std::max(longest, characters(word));
  return longest;
}

// A number as people write it: 1.5e-07 as 1.5 × 10⁻⁷, -3 with a minus sign. Empty for other words.
std::string number(const std::string& word) {
  static const std::regex kNumber("(-?)([0-9][0-9.,]*)(?:e[+]?(-?)0*([0-9]+))?");
  std::smatch part;
  if (!std::regex_match(word, part, kNumber)) return "";
  if (part[4].matched) {
    return fmt::format("${}{}\\times10^{{{}{}}}$", part[1].str(), part[2].str(), part[3].str(),
                       part[4].str());
  }
  return part[1].length() > 0 ? "$-$" + part[2].str() : "";
}

// As printed: "1.5e-07" becomes longer.
std::size_t printed(std::string_view text) {
  std::size_t count = characters(text);
  for (const std::string& word : wrap(text, 0)) {
    if (number(word).find("times") != std::string::npos) count += 3;
  }
  return count;
}

// `breakable`: lines may be broken inside ids and paths too.
std::string cell_latex(std::string_view text, bool breakable) {
  std::string out;
  for (const std::string& word : wrap(text, 0)) {
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

  std::string latex() const {
    return fmt::format(
        "{{\n  \\{0}\n  \\setlength{{\\tabcolsep}}{{{1}pt}}\n  \\begin{{longtable}}{{{2}}}\n"
        "  \\caption{{{3}. {4}}}\n  \\label{{tab:{5}}}\\\\\n  \\toprule\n{6}  \\midrule\n  \\endfirsthead\n"
        "  \\toprule\n{6}  \\midrule\n  \\endhead\n  \\bottomrule\n  \\endfoot\n{7}  "
        "\\end{{longtable}}\n}}\n",
        font_.name, kGap / 2, columns(), escape_latex(table_.title), escape_latex(table_.caption),
        file_name(table_.id), headings(), rows());
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
    const double share = std::max(0.0, left - least);
    for (Width& w : widths_) {
      if (!w.broken) continue;
      w.points = std::min(narrowest(w) + share * w.text / claims,
                          std::max(narrowest(w), static_cast<double>(w.cell) * font_.character));
    }
    return left >= least;
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
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      const Column& column = table_.columns[i];
      if (widths_[i].broken) {
        cells.push_back(cell_latex(heading(column), false));
        continue;
      }
      std::vector<std::string> lines = wrap(heading(column), widths_[i].heading);
      for (std::string& line : lines) line = cell_latex(line, false);
      cells.push_back(fmt::format("\\begin{{tabular}}[b]{{@{{}}{}@{{}}}}{}\\end{{tabular}}",
                                  column.numeric ? "r" : "l", fmt::join(lines, "\\\\")));
    }
    return fmt::format("  {} \\\\\n", fmt::join(cells, " & "));
  }

  std::string rows() const {
    std::string text;
    for (const auto& row : table_.rows) {
      std::vector<std::string> cells;
      for (std::size_t i = 0; i < row.size(); ++i)
        cells.push_back(cell_latex(row[i].text, widths_[i].broken));
      text += fmt::format("  {} \\\\\n", fmt::join(cells, " & "));
    }
    return text;
  }

  const Table& table_;
  const Font& font_;
  std::vector<Width> widths_;
};

}  // namespace

std::string latex(const Table& table) {
  for (const Font* const font : {&kFootnote, &kScript}) {
    if (const auto setting = Setting::fit(table, *font, kPortrait)) return setting->latex();
  }
  std::optional<Setting> setting = Setting::fit(table, kScript, kLandscape);
  if (!setting) setting.emplace(*Setting::fit(table, kTiny, kLandscape, true));
  return "\\begin{landscape}\n" + setting->latex() + "\\end{landscape}\n";
}

}  // namespace terrabench
