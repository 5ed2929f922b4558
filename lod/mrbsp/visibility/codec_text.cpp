#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include "lod/mrbsp/visibility/codec.h"
#include "terrain/error.h"

namespace terrabench::mrbsp::visibility {
namespace {

constexpr std::string_view kFirstLine = "terrabench-visibility 3";

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
    text += label(first_node(depth) + e);
  }
  return text;
}

bool rises_strictly(std::span<const std::uint32_t> elements, int depth) {
  return std::adjacent_find(elements.begin(), elements.end(), std::greater_equal<>()) == elements.end() &&
         (elements.empty() || elements.back() < 1U << depth);
}

std::string step_name(const CellGrid& cells, glm::ivec2 from, glm::ivec2 to) {
  return cell_name(cells, from) + "-" + cell_name(cells, to);
}

}  // namespace

std::string cell_name(const CellGrid& cells, glm::ivec2 cell) {
  return cells.rows == 1 ? column_name(cell.x) : fmt::format("{}{}", column_name(cell.x), cell.y + 1);
}

std::string encode_text(const ChangeTable& table) {
  std::string text =
      fmt::format("{}\ncells {} {}\nside {}\ndepth {}\neye-height {}\nsurface {}\nsets {}\nstart {}\n",
                  kFirstLine, table.cells.columns, table.cells.rows, table.cells.side, table.depth,
                  table.eye_height, std::string_view(table.ground.data(), table.ground.size()),
                  name_of(table.mode), labels(table.start, table.depth));
  each_step(table.cells, [&](int step, glm::ivec2 from, glm::ivec2 to) {
    if (table.step(step).empty()) return;
    text += fmt::format("{} {}\n", step_name(table.cells, from, to), labels(table.step(step), table.depth));
  });
  return text;
}

namespace {

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& origin) : text_(text), origin_(origin) {}

  ChangeTable read() {
    if (!next() || line_ != kFirstLine) fail("not a file of visibility changes");
    const auto cells = numbers<int>("cells", 2);
    table_.cells.columns = cells[0];
    table_.cells.rows = cells[1];
    table_.cells.side = numbers<int>("side", 1)[0];
    table_.depth = numbers<int>("depth", 1)[0];
    table_.eye_height = numbers<float>("eye-height", 1)[0];
    const std::string_view sum = value_of("surface");
    if (sum.size() != table_.ground.size()) {
      fail(fmt::format("'surface' must have {} digits, got {}", table_.ground.size(), sum.size()));
    }
    std::copy(sum.begin(), sum.end(), table_.ground.begin());
    if (const std::string_view error = header_error(table_); !error.empty()) fail(error);
    const auto mode = std::find(kModeNames.begin(), kModeNames.end(), value_of("sets"));
    if (mode == kModeNames.end()) fail(fmt::format("'sets' must be one of {}", fmt::join(kModeNames, ", ")));
    table_.mode = static_cast<Mode>(mode - kModeNames.begin());
    table_.start = elements(value_of("start"));
    read_steps();
    if (!is_consistent(table_)) fail("the changes around a corner of four cells do not cancel out");
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::string_view what) const {
    throw bad_input(what, fmt::format("{}, line {}", origin_, number_),
                    "give a complete file that terrabench wrote");
  }
  bool next() {
    if (text_.empty()) return false;
    ++number_;
    const std::size_t end = text_.find('\n');
    if (end == std::string_view::npos) fail("the last line has no end");
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
      if (error != std::errc()) break;
      numbers.push_back(number);
      value.remove_prefix(static_cast<std::size_t>(end - value.data()));
      if (value.empty() || value[0] != ' ' || numbers.size() == count) break;
      value.remove_prefix(1);
    }
    if (!value.empty() || numbers.size() != count)
      fail(fmt::format("'{}' must have {} number(s)", key, count));
    return numbers;
  }
  std::vector<std::uint32_t> elements(std::string_view list) const {
    std::vector<std::uint32_t> elements;
    while (!list.empty()) {
      const std::size_t end = std::min(list.find(", "), list.size());
      NodeNumber node = 0;
      if (!parse_label(list.substr(0, end), node) || depth_of(node) != table_.depth) {
        fail(fmt::format("each number must have {} digits 0 or 1", table_.depth));
      }
      elements.push_back(static_cast<std::uint32_t>(node - first_node(table_.depth)));
      list.remove_prefix(std::min(end + 2, list.size()));
    }
    if (!rises_strictly(elements, table_.depth)) fail("the numbers must rise strictly");
    return elements;
  }
  // Lines come in the order of the steps, so one pass over the steps finds them all.
  void read_steps() {
    table_.first.reserve(static_cast<std::size_t>(table_.steps()) + 1);
    bool more = next();
    std::string_view name = more ? line_.substr(0, line_.find(' ')) : std::string_view();
    each_step(table_.cells, [&](int, glm::ivec2 from, glm::ivec2 to) {
      table_.first.push_back(static_cast<std::uint32_t>(table_.changes.size()));
      if (!more || step_name(table_.cells, from, to) != name) return;
      if (line_.size() <= name.size() + 1) fail("a step has no changes");
      const auto list = elements(line_.substr(name.size() + 1));
      table_.changes.insert(table_.changes.end(), list.begin(), list.end());
      more = next();
      name = more ? line_.substr(0, line_.find(' ')) : std::string_view();
    });
    if (more) fail("unknown step, or steps out of order");
    table_.first.push_back(static_cast<std::uint32_t>(table_.changes.size()));
  }

  std::string_view text_, line_;
  const std::string& origin_;
  int number_ = 0;
  ChangeTable table_;
};

}  // namespace

ChangeTable decode_text(std::string_view text, const std::string& origin) {
  return TextReader(text, origin).read();
}

}  // namespace terrabench::mrbsp::visibility
