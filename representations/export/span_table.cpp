#include "representations/export/span_table.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "terrain/error.h"
#include "terrain/new_file.h"

namespace terrabench {
namespace {

void append_row(const Representation& built, const LineGrid& lines, int j, std::string& text) {
  const auto width = static_cast<std::size_t>(lines.width);
  std::vector<float> x(width);
  const std::vector<float> z(width, lines.z(j));
  for (int i = 0; i < lines.width; ++i) x[static_cast<std::size_t>(i)] = lines.x(i);
  SpanSink sink;
  built.spans({x, z}, sink);
  for (std::size_t i = 0; i < width; ++i) {
    for (const Span& span : sink.column(i)) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", x[i], z[i], span.bottom, span.top,
                     static_cast<unsigned>(span.material));
    }
  }
}

// Numbers of the table, row by row.
class Reader {
 public:
  Reader(std::string_view text, const std::string& origin) : text_(text), origin_(origin) {}

  bool next_line() {
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    line_ = text_.substr(0, end);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
    return true;
  }
  std::string_view line() const { return line_; }

  // The next number of the line, and the comma behind it unless it is the last.
  template <class Number>
  Number number(const char* what, bool last = false) {
    Number value{};
    const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
    if (error != std::errc()) fail(fmt::format("{} is not a number", what));
    line_.remove_prefix(static_cast<std::size_t>(end - line_.data()));
    if (last ? !line_.empty() : !line_.starts_with(','))
      fail(fmt::format("{} is not followed by {}", what, last ? "the end of the line" : "a comma"));
    if (!last) line_.remove_prefix(1);
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) fail(fmt::format("{} is not finite", what));
    }
    return value;
  }
  [[noreturn]] void fail(std::string_view what) const {
    throw bad_input(what, fmt::format("{}:{}", origin_, number_),
                    "give a table of spans as `terrabench represent --save NAME.csv` writes it");
  }

 private:
  std::string_view text_, line_;
  const std::string& origin_;
  std::size_t number_ = 0;
};

// The number of the line at `at`; -1 if none stands there.
int line_at(float at, double origin, double cell, int count, const auto& position) {
  const double nearest = std::round((at - origin) / cell);
  if (!(nearest >= 0 && nearest < count)) return -1;
  const int index = static_cast<int>(nearest);
  return position(index) == at ? index : -1;
}

}  // namespace

void write_spans(const std::filesystem::path& path, const Representation& built, const LineGrid& lines,
                 Progress& progress) {
  constexpr int kRows = 64;
  NewFile file(path);
  file.append(std::string(kSpanHeader) + "\n");
  progress.begin("writing " + path.string(), static_cast<std::uint64_t>(lines.depth));
  std::vector<std::string> texts;
  for (int first = 0; first < lines.depth; first += kRows) {
    texts.assign(static_cast<std::size_t>(std::min(kRows, lines.depth - first)), {});
    tbb::parallel_for(std::size_t{0}, texts.size(), [&](std::size_t row) {
      append_row(built, lines, first + static_cast<int>(row), texts[row]);
      progress.advance();
    });
    for (const std::string& text : texts) file.append(text);
  }
  progress.end();
  file.keep();
}

SpanTable parse_spans(std::string_view text, const std::string& origin) {
  Reader reader(text, origin);
  if (!reader.next_line() || reader.line() != kSpanHeader) {
    reader.fail(fmt::format("the first line is not '{}'", kSpanHeader));
  }
  SpanTable table;
  while (reader.next_line()) {
    table.x.push_back(reader.number<float>("x"));
    table.z.push_back(reader.number<float>("z"));
    Span span{};
    span.bottom = reader.number<float>("the bottom");
    span.top = reader.number<float>("the top");
    if (!(span.bottom < span.top)) reader.fail("the bottom is not below the top");
    const auto material = reader.number<unsigned>("the material", true);
    if (material < 1 || material > 255) reader.fail(fmt::format("there is no material {}", material));
    span.material = static_cast<Material>(material);
    table.spans.push_back(span);
  }
  return table;
}

SpanTable read_spans(const std::filesystem::path& path, std::uint64_t limit) {
  return parse_spans(read_file(path, limit), path.string());
}

Heightfield heights_of(const SpanTable& table, const LineGrid& lines) {
  Heightfield field = Heightfield::zeros(lines.width, lines.depth, static_cast<float>(lines.cell_x),
                                         static_cast<float>(lines.cell_z));
  std::ranges::fill(field.heights, Heightfield::kNoData);
  for (std::size_t r = 0; r < table.spans.size(); ++r) {
    const int i = line_at(table.x[r], lines.origin_x, lines.cell_x, lines.width,
                          [&](int index) { return lines.x(index); }),
              j = line_at(table.z[r], lines.origin_z, lines.cell_z, lines.depth,
                          [&](int index) { return lines.z(index); });
    if (i < 0 || j < 0) continue;
    float& height = field.at(i, j);
    if (!(height >= table.spans[r].top)) height = table.spans[r].top;
  }
  return field;
}

}  // namespace terrabench
