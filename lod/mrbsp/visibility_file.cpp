#include "lod/mrbsp/visibility_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>

#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::string_view kFirstLine = "terrabench-visibility 1";
constexpr std::array<char, 8> kMagic = {'T', 'e', 'r', 'r', 'a', 'V', 'i', 's'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kChecksum = 32;
constexpr int kMostCells = 1 << 20, kDeepest = 24, kLargestSide = 1 << 15;

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

// Why a table's head cannot be; empty when it can.
std::string_view head_fault(const VisibilityTable& table) {
  const CellGrid& c = table.cells;
  if (c.columns < 1 || c.rows < 1 || c.columns > kMostCells || c.rows > kMostCells / c.columns) {
    return "the number of cells cannot be";
  }
  if (c.side < 1 || c.side > kLargestSide || (c.side & (c.side - 1)) != 0) {
    return "the side of a cell is not a power of two";
  }
  if (table.depth < 1 || table.depth > kDeepest) return "the depth cannot be";
  if (!(table.eye_height >= 0 && table.eye_height <= 1e6F)) return "the eye height cannot be";
  for (const char c : table.surface) {
    if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'))) return "the surface's checksum is none";
  }
  return {};
}

// Strictly rising numbers of triangles.
bool is_list(std::span<const std::uint32_t> elements, int depth) {
  return std::adjacent_find(elements.begin(), elements.end(), std::greater_equal<>()) == elements.end() &&
         (elements.empty() || elements.back() < 1U << depth);
}

// Going around each corner of four cells must toggle everything back.
bool is_consistent(const VisibilityTable& table) {
  std::vector<std::uint32_t> around;
  for (int row = 0; row + 1 < table.cells.rows; ++row) {
    for (int column = 0; column + 1 < table.cells.columns; ++column) {
      around.clear();
      for (const int step : {table.step_right(column, row), table.step_down(column + 1, row),
                             table.step_right(column, row + 1), table.step_down(column, row)}) {
        around.insert(around.end(), table.step(step).begin(), table.step(step).end());
      }
      std::sort(around.begin(), around.end());
      for (std::size_t k = 0; k < around.size(); k += 2) {
        if (k + 1 == around.size() || around[k] != around[k + 1]) return false;
      }
    }
  }
  return true;
}

}  // namespace

std::string cell_name(const CellGrid& cells, int column, int row) {
  return cells.rows == 1 ? column_name(column) : fmt::format("{}{}", column_name(column), row + 1);
}

namespace {

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

std::string visibility_text(const VisibilityTable& table) {
  std::string text = fmt::format(
      "{}\ncells {} {}\nside {}\ndepth {}\neye-height {}\nsurface {}\nstart {}\n", kFirstLine,
      table.cells.columns, table.cells.rows, table.cells.side, table.depth, table.eye_height,
      std::string_view(table.surface.data(), table.surface.size()), labels(table.start, table.depth));
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

namespace {

// Seven bits a byte, low ones first, the eighth set when more follow.
void put_number(ByteSink& out, std::uint32_t number) {
  for (; number >= 0x80; number >>= 7) out.put(static_cast<std::uint8_t>(number | 0x80));
  out.put(static_cast<std::uint8_t>(number));
}

std::uint32_t get_number(ByteSource& in) {
  std::uint64_t number = 0;
  for (int shift = 0; shift < 35; shift += 7) {
    const auto byte = in.get<std::uint8_t>();
    number |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) {
      if (number > 0xFFFFFFFFU || (byte == 0 && shift > 0)) break;
      return static_cast<std::uint32_t>(number);
    }
  }
  in.fail("a number is too long");
}

void put_list(ByteSink& out, std::span<const std::uint32_t> elements) {
  put_number(out, static_cast<std::uint32_t>(elements.size()));
  std::uint32_t next = 0;
  for (const std::uint32_t e : elements) {
    put_number(out, e - next);
    next = e + 1;
  }
}

void get_list(ByteSource& in, int depth, std::vector<std::uint32_t>& out) {
  const std::uint32_t count = get_number(in);
  if (count > in.left()) in.fail("a list is longer than the file");
  std::uint64_t next = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint64_t e = next + get_number(in);
    if (e >= std::uint64_t{1} << depth) in.fail("a triangle's number cannot be");
    out.push_back(static_cast<std::uint32_t>(e));
    next = e + 1;
  }
}

void put_lists(const VisibilityTable& table, ByteSink& out) {
  put_list(out, table.start);
  for (int step = 0; step < table.steps(); ++step) put_list(out, table.step(step));
}

}  // namespace

void save_visibility(const VisibilityTable& table, ByteSink& out) {
  ByteSink file;
  file.put(kMagic);
  file.put(kVersion);
  file.put(static_cast<std::int32_t>(table.cells.columns));
  file.put(static_cast<std::int32_t>(table.cells.rows));
  file.put(static_cast<std::int32_t>(table.cells.side));
  file.put(static_cast<std::int32_t>(table.depth));
  file.put(table.eye_height);
  file.put(table.surface);
  put_lists(table, file);
  const std::string sum = checksum(file.bytes());
  file.put_array(std::span<const char>(sum));
  out.put_array(file.bytes());
}

VisibilityTable load_visibility(std::span<const std::byte> file, const std::string& origin) {
  ByteSource whole(file, origin);
  if (whole.left() < kMagic.size() || whole.get<std::array<char, 8>>() != kMagic) {
    throw bad_input("is no file of visibility changes", origin, "give a file that terrabench wrote");
  }
  if (whole.left() < kChecksum) whole.fail("the file ends too early");
  const auto content = file.first(file.size() - kChecksum);
  const std::string sum = checksum(content);
  if (!std::equal(sum.begin(), sum.end(), reinterpret_cast<const char*>(file.data()) + content.size())) {
    whole.fail("the checksum does not fit the content");
  }
  ByteSource in(content, origin);
  (void)in.get<std::array<char, 8>>();
  if (in.get<std::uint32_t>() != kVersion) in.fail("the format's version is another");
  VisibilityTable table;
  table.cells.columns = in.get<std::int32_t>();
  table.cells.rows = in.get<std::int32_t>();
  table.cells.side = in.get<std::int32_t>();
  table.depth = in.get<std::int32_t>();
  table.eye_height = in.get<float>();
  table.surface = in.get<SurfaceChecksum>();
  if (const std::string_view fault = head_fault(table); !fault.empty()) in.fail(fault);
  get_list(in, table.depth, table.start);
  // A step takes a byte at least, so that a short file cannot ask for many.
  if (static_cast<std::size_t>(table.steps()) > in.left()) in.fail("the file ends too early");
  table.first.reserve(static_cast<std::size_t>(table.steps()) + 1);
  table.first.push_back(0);
  for (int step = 0; step < table.steps(); ++step) {
    get_list(in, table.depth, table.changes);
    table.first.push_back(static_cast<std::uint32_t>(table.changes.size()));
  }
  if (in.left() > 0) in.fail("bytes are left over after the changes");
  if (!is_consistent(table)) in.fail("the changes around a corner of cells do not cancel out");
  return table;
}

void write_visibility(const std::filesystem::path& path, const VisibilityTable& table) {
  if (path.extension() == ".txt") {
    write_file(path, visibility_text(table));
    return;
  }
  ByteSink file;
  save_visibility(table, file);
  write_file(path, file.bytes());
}

VisibilityTable read_visibility(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;
  const std::string file = read_file(path, kLargestFile);
  if (path.extension() == ".txt") return parse_visibility(file, path.string());
  return load_visibility(std::as_bytes(std::span(file)), path.string());
}

VisibilityBytes visibility_bytes(const VisibilityTable& table) {
  VisibilityBytes bytes;
  ByteSink changes, lists;
  put_lists(table, changes);
  bytes.changes = changes.bytes().size();
  const VisibleSets sets = sets_of(table);
  std::vector<std::uint32_t> list;
  for (int cell = 0; cell < sets.cells.count(); ++cell) {
    list.clear();
    for (std::uint32_t e = 0; e < 1U << sets.depth; ++e) {
      if (sets.sees(cell, e)) list.push_back(e);
    }
    put_list(lists, list);
  }
  bytes.lists = lists.bytes().size();
  bytes.bits = static_cast<std::size_t>(sets.cells.count()) * (((std::size_t{1} << sets.depth) + 7) / 8);
  return bytes;
}

std::string fine_changes(std::span<const std::uint32_t> elements, int coarse_depth, int fine_depth) {
  std::vector<std::uint32_t> fine;
  const int finer = fine_depth - coarse_depth;
  for (const std::uint32_t e : elements) {
    for (std::uint32_t k = 0; k < 1U << finer; ++k) fine.push_back((e << finer) + k);
  }
  return labels(fine, fine_depth);
}

}  // namespace terrabench
