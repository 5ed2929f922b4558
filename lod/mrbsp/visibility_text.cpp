#include "lod/mrbsp/visibility_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::string_view kFirstLine = "terrabench-visibility 2", kSampled = "sampled",
                           kConservative = "conservative";

std::string column_name(int column) {
  std::string name;
  for (int left = column + 1; left > 0; left = (left - 1) / 26) {
    name.insert(name.begin(), static_cast<char>('a' + (left - 1) % 26));
  }
  return name;
}

std::string labels(std::span<const std::uint32_t> elements, int depth) {
  std::string text;
  for (const std::uint32_t e : elements) {
    if (!text.empty()) text += ", ";
    text += label((NodeNumber{1} << depth) + e);
  }
  return text;
}

// Strictly rising numbers of triangles.
bool is_list(std::span<const std::uint32_t> elements, int depth) {
  return std::adjacent_find(elements.begin(), elements.end(), std::greater_equal<>()) == elements.end() &&
         (elements.empty() || elements.back() < 1U << depth);
}

// Calls body(step, name) for every step in the table's order.
template <class Body>
void each_step(const VisibilityTable& table, const Body& body) {
  const CellGrid& cells = table.cells;
  const auto name = [&](int column, int row, int to_column, int to_row) {
    return cell_name(cells, column, row) + "-" + cell_name(cells, to_column, to_row);
  };
  for (int row = 0; row < cells.rows; ++row) {
    for (int column = 0; column + 1 < cells.columns; ++column) {
      body(table.step_right(column, row), [&] { return name(column, row, column + 1, row); });
    }
  }
  for (int row = 0; row + 1 < cells.rows; ++row) {
    for (int column = 0; column < cells.columns; ++column) {
      body(table.step_down(column, row), [&] { return name(column, row, column, row + 1); });
    }
  }
}

}  // namespace

std::string cell_name(const CellGrid& cells, int column, int row) {
  return cells.rows == 1 ? column_name(column) : fmt::format("{}{}", column_name(column), row + 1);
}

std::string visibility_text(const VisibilityTable& table) {
  std::string text =
      fmt::format("{}\ncells {} {}\nside {}\ndepth {}\neye-height {}\nsurface {}\nsets {}\nstart {}\n",
                  kFirstLine, table.cells.columns, table.cells.rows, table.cells.side, table.depth,
                  table.eye_height, std::string_view(table.surface.data(), table.surface.size()),
                  table.conservative ? kConservative : kSampled, labels(table.start, table.depth));
  each_step(table, [&](int step, const auto& name) {
    if (!table.step(step).empty())
      text += fmt::format("{} {}\n", name(), labels(table.step(step), table.depth));
  });
  return text;
}

namespace {

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& origin) : text_(text), origin_(origin) {}

  VisibilityTable read() {
    if (!next() || line_ != kFirstLine) fail("is no file of visibility changes");
    const auto cells = numbers<int>("cells", 2);
    table_.cells.columns = cells[0];
    table_.cells.rows = cells[1];
    table_.cells.side = numbers<int>("side", 1)[0];
    table_.depth = numbers<int>("depth", 1)[0];
    table_.eye_height = numbers<float>("eye-height", 1)[0];
    const std::string_view surface = value_of("surface");
    if (surface.size() != table_.surface.size()) {
      fail(fmt::format("'surface' takes {} digits", table_.surface.size()));
    }
    std::copy(surface.begin(), surface.end(), table_.surface.begin());
    if (const std::string_view fault = head_fault(table_); !fault.empty()) fail(fault);
    const std::string_view sets = value_of("sets");
    table_.conservative = sets == kConservative;
    if (!table_.conservative && sets != kSampled) fail("'sets' are sampled or conservative");
    table_.start = elements(value_of("start"));
    read_steps();
    if (!is_consistent(table_)) fail("the changes around a corner of cells do not cancel out");
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::string_view what) const {
    throw bad_input(what, fmt::format("{}, line {}", origin_, number_),
                    "give a file that terrabench wrote, whole");
  }
  bool next() {
    if (text_.empty()) return false;
    ++number_;
    const std::size_t end = text_.find('\n');
    if (end == std::string_view::npos) fail("the last line is cut off");
    line_ = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    return true;
  }
  std::string_view value_of(std::string_view key) {
    if (!next() || !line_.starts_with(key) || line_.size() <= key.size() || line_[key.size()] != ' ') {
      fail(fmt::format("'{}' is missing", key));
    }
    return line_.substr(key.size() + 1);
  }
  template <class T>
  std::vector<T> numbers(std::string_view key, std::size_t count) {
    std::string_view value = value_of(key);
    std::vector<T> numbers;
    for (;;) {
      T number{};
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
      if (error != std::errc()) fail(fmt::format("'{}' takes {} number(s)", key, count));
      numbers.push_back(number);
      value.remove_prefix(static_cast<std::size_t>(end - value.data()));
      if (value.empty() || value[0] != ' ' || numbers.size() == count) break;
      value.remove_prefix(1);
    }
    if (!value.empty() || numbers.size() != count) fail(fmt::format("'{}' takes {} number(s)", key, count));
    return numbers;
  }
  std::vector<std::uint32_t> elements(std::string_view list) const {
    std::vector<std::uint32_t> elements;
    while (!list.empty()) {
      const std::size_t end = std::min(list.find(", "), list.size());
      NodeNumber node = 0;
      if (!parse_label(list.substr(0, end), node) || depth_of(node) != table_.depth) {
        fail(fmt::format("a number does not have {} digits 0 and 1", table_.depth));
      }
      elements.push_back(static_cast<std::uint32_t>(node - (NodeNumber{1} << table_.depth)));
      list.remove_prefix(std::min(end + 2, list.size()));
    }
    if (!is_list(elements, table_.depth)) fail("the numbers do not rise");
    return elements;
  }
  // Lines come in the order of the steps, so each is looked for from where the last one was found.
  void read_steps() {
    table_.first.reserve(static_cast<std::size_t>(table_.steps()) + 1);
    bool more = next();
    std::string_view step_name = more ? line_.substr(0, line_.find(' ')) : std::string_view();
    each_step(table_, [&](int, const auto& name) {
      table_.first.push_back(static_cast<std::uint32_t>(table_.changes.size()));
      if (!more || name() != step_name) return;
      if (line_.size() <= step_name.size() + 1) fail("a step has no changes");
      const auto list = elements(line_.substr(step_name.size() + 1));
      table_.changes.insert(table_.changes.end(), list.begin(), list.end());
      more = next();
      step_name = more ? line_.substr(0, line_.find(' ')) : std::string_view();
    });
    if (more) fail("no step has this name here");
    table_.first.push_back(static_cast<std::uint32_t>(table_.changes.size()));
  }

  std::string_view text_, line_;
  const std::string& origin_;
  int number_ = 0;
  VisibilityTable table_;
};

}  // namespace

VisibilityTable parse_visibility(std::string_view text, const std::string& origin) {
  return TextReader(text, origin).read();
}

}  // namespace terrabench
