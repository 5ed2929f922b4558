#include "representations/export/span_table.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "terrain/error.h"
#include "terrain/files.h"

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

SpanTable read_spans(const std::filesystem::path& path) {
  const std::string text = read_file(path, std::uint64_t{1} << 32);
  const auto fail = [&](const char* at) {
    throw bad_input(fmt::format("no table of spans from byte {} on", at - text.data()), path.string(),
                    "give a table as `terrabench represent --save NAME.csv` writes it");
  };
  if (!text.starts_with(kSpanHeader)) fail(text.data());
  const char* at = text.data() + std::min(kSpanHeader.size() + 1, text.size());
  const char* const end = text.data() + text.size();
  const auto read = [&](auto& number) {
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || next == end) fail(at);
    at = next + 1;  // behind the comma or the end of the line
  };
  SpanTable table;
  while (at < end) {
    read(table.x.emplace_back());
    read(table.z.emplace_back());
    Span& span = table.spans.emplace_back();
    read(span.bottom);
    read(span.top);
    unsigned material = 0;
    read(material);
    span.material = static_cast<Material>(material);
  }
  return table;
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
