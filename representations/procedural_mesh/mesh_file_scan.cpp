#include "representations/procedural_mesh/mesh_file_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

#include "terrain/error.h"
#include "terrain/number.h"

namespace terrabench {
namespace {

constexpr std::string_view kBlank = " \t\r\n\v\f";

// Takes the next word off the text; empty at its end.
std::string_view take_word(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(kBlank), text.size());
  const std::size_t end = std::min(text.find_first_of(kBlank, begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

template <class T>
std::optional<T> signed_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  return parse_number<T>(word);
}
// A number that a finite float can hold.
bool is_float(std::string_view word) {
  const auto value = signed_number<double>(word);
  return value && std::abs(*value) <= 3.4028234e38;
}

struct Type {
  std::size_t size;
  bool real;
};
std::optional<Type> type_of(std::string_view name) {
  struct Named {
    std::string_view name, other;
    Type type;
  };
  constexpr std::array<Named, 8> kTypes{{{"char", "int8", {1, false}},
                                         {"uchar", "uint8", {1, false}},
                                         {"short", "int16", {2, false}},
                                         {"ushort", "uint16", {2, false}},
                                         {"int", "int32", {4, false}},
                                         {"uint", "uint32", {4, false}},
                                         {"float", "float32", {4, true}},
                                         {"double", "float64", {8, true}}}};
  for (const Named& t : kTypes) {
    if (name == t.name || name == t.other) return t.type;
  }
  return std::nullopt;
}

class PlyScan {
 public:
  PlyScan(std::string_view bytes, const std::string& origin) : rest_(bytes), origin_(origin) {}

  ScannedMesh run() {
    header();
    check_elements();
    for (const Element& element : elements_) {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) body(element, i, property);
      }
    }
    return result_;
  }

 private:
  struct Property {
    std::string_view name;
    Type type;
    std::optional<Type> count;  // of a list
  };
  struct Element {
    std::string_view name;
    std::uint64_t count;
    std::vector<Property> properties;
  };

  [[noreturn]] void fail(const std::string& what, const std::string& where) const {
    throw bad_input(what, fmt::format("{}, {}", origin_, where), "write the file again as PLY 1.0");
  }

  void header() {
    if (take_line(rest_) != "ply") fail("not a PLY file", "line 1");
    for (int line = 2;; ++line) {
      if (rest_.empty()) fail("the header has no end", fmt::format("line {}", line));
      std::string_view text = take_line(rest_);
      const std::string_view key = take_word(text);
      if (key == "end_header") break;
      if (key == "comment" || key == "obj_info") continue;
      if (!header_line(key, text))
        fail(fmt::format("'{}' is not understood", key), fmt::format("line {}", line));
    }
    if (format_.empty()) fail("the header names no format", "header");
  }

  bool header_line(std::string_view key, std::string_view text) {
    if (key == "format") {
      format_ = take_word(text);
      ascii_ = format_ == "ascii";
      return ascii_ || format_ == "binary_little_endian" || format_ == "binary_big_endian";
    }
    if (key == "element") {
      const std::string_view name = take_word(text);
      const auto count = signed_number<std::uint64_t>(take_word(text));
      if (count) elements_.push_back({name, *count, {}});
      return count.has_value();
    }
    if (key != "property" || elements_.empty()) return false;
    std::string_view word = take_word(text);
    Property property{};
    if (word == "list") {
      property.count = type_of(take_word(text));
      if (!property.count || property.count->real) return false;
      word = take_word(text);
    }
    const auto type = type_of(word);
    property.name = take_word(text);
    if (!type || property.name.empty()) return false;
    property.type = *type;
    elements_.back().properties.push_back(property);
    return true;
  }

  static bool is_corners(const Property& p) { return p.name == "vertex_indices" || p.name == "vertex_index"; }

  void check_elements() {
    if (elements_.size() < 2 || elements_[0].name != "vertex" || elements_[1].name != "face") {
      fail("the elements are not 'vertex' and 'face', in this order", "header");
    }
    std::size_t axes = 0, u = 0, v = 0;
    for (const Property& p : elements_[0].properties) {
      if (p.count) fail("a list of numbers per vertex", "header");
      axes += p.name == "x" || p.name == "y" || p.name == "z";
      u += p.name == "u";
      v += p.name == "v";
    }
    if (axes != 3) fail("vertices without x, y and z", "header");
    result_.has_texture = u == 1 && v == 1;
    std::size_t lists = 0;
    for (const Property& p : elements_[1].properties) {
      lists += is_corners(p) && p.count && !p.type.real;
      // OpenMesh would store other lists in a mesh of its own.
      if (p.count && !is_corners(p)) fail(fmt::format("the list '{}' of faces", p.name), "header");
    }
    if (lists != 1) fail("faces without one list 'vertex_indices' of whole numbers", "header");
    for (const Element& element : elements_) {
      if (element.properties.empty() && element.count > 0) fail("an element without properties", "header");
    }
    result_.vertices = elements_[0].count;
    result_.faces = elements_[1].count;
  }

  void body(const Element& element, std::uint64_t index, const Property& property) {
    const auto where = [&] { return fmt::format("{} {}", element.name, index); };
    std::uint64_t values = 1;
    if (property.count) {
      values = list_length(*property.count, where);
      if (&element == &elements_[1]) {
        if (values < 3) fail(fmt::format("{} corners", values), where());
        result_.corners += values;
      }
    }
    if (!ascii_) {
      if (values > rest_.size() / property.type.size) fail("the file ends early", where());
      if (property.type.real) check_real(property.type, where);
      rest_.remove_prefix(values * property.type.size);
      return;
    }
    for (; values > 0; --values) {
      const std::string_view word = take_word(rest_);
      if (word.empty()) fail("the file ends early", where());
      if (!(property.type.real ? is_float(word) : signed_number<std::int64_t>(word).has_value())) {
        fail(fmt::format("'{}' is not a finite number of its type", word.substr(0, 40)), where());
      }
    }
  }

  // In a binary file, of a single value (lists of real numbers are refused).
  template <class Where>
  void check_real(Type type, const Where& where) const {
    char bytes[8];
    std::memcpy(bytes, rest_.data(), type.size);
    if (format_ == "binary_big_endian") std::reverse(bytes, bytes + type.size);
    double value = 0;
    if (type.size == 8) std::memcpy(&value, bytes, 8);
    if (type.size == 4) {
      float single;
      std::memcpy(&single, bytes, 4);
      value = single;
    }
    if (!(std::abs(value) <= 3.4028234e38)) fail("a number is not finite", where());
  }

  template <class Where>
  std::uint64_t list_length(Type type, const Where& where) {
    if (ascii_) {
      const auto count = signed_number<std::uint64_t>(take_word(rest_));
      if (!count || *count > rest_.size()) fail("a list has no proper length", where());
      return *count;
    }
    if (rest_.size() < type.size) fail("the file ends early", where());
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < type.size; ++i) {
      const std::size_t at = format_ == "binary_big_endian" ? i : type.size - 1 - i;
      count = count << 8 | static_cast<unsigned char>(rest_[at]);
    }
    rest_.remove_prefix(type.size);
    return count;  // a negative one is larger than any file
  }

  std::string_view rest_;
  const std::string& origin_;
  std::string_view format_;
  bool ascii_ = false;
  std::vector<Element> elements_;
  ScannedMesh result_;
};

class ObjScan {
 public:
  ObjScan(std::string_view bytes, const std::string& origin) : bytes_(bytes), origin_(origin) {}

  ScannedMesh run() {
    each_line([&](std::string_view key, std::string_view) {
      vertices_ += key == "v";
      texture_ += key == "vt";
    });
    texture_of_.assign(vertices_, {});
    each_line([&](std::string_view key, std::string_view text) {
      if (key == "v") numbers(key, text, 3);
      if (key == "vt") numbers(key, text, 2);
      if (key == "f") face(text);
    });
    result_.vertices = vertices_;
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw bad_input(what, fmt::format("{}, line {}", origin_, line_),
                    "write the file again as Wavefront OBJ");
  }

  template <class Work>
  void each_line(const Work& work) {
    std::string_view rest = bytes_;
    for (line_ = 1; !rest.empty(); ++line_) {
      std::string_view text = take_line(rest);
      const std::string_view key = take_word(text);
      if ((key == "v" || key == "vt" || key == "f") && text.find('\\') != text.npos) fail("a continued line");
      work(key, text);
    }
  }

  void numbers(std::string_view key, std::string_view text, int count) {
    result_.text += key;
    for (int i = 0; i < count; ++i) {
      const std::string_view word = take_word(text);
      if (!is_float(word)) fail(fmt::format("'{}' is not a finite number", word.substr(0, 40)));
      result_.text += ' ';
      result_.text += word;
    }
    result_.text += '\n';
    ++(key == "v" ? vertices_so_far_ : texture_so_far_);
  }

  // From 0; a negative index counts back from the last one so far.
  std::size_t index(std::string_view word, std::size_t so_far, std::size_t all) const {
    const auto value = signed_number<std::int64_t>(word);
    if (!value) fail(fmt::format("'{}' is not an index", word.substr(0, 40)));
    const auto known = static_cast<std::int64_t>(*value < 0 ? so_far : all);
    if (*value == 0 || *value > known || *value < -known) {
      fail(fmt::format("index '{}' of {}", word.substr(0, 40), known));
    }
    return static_cast<std::size_t>(*value < 0 ? known + *value : *value - 1);
  }

  void face(std::string_view text) {
    result_.text += 'f';
    std::size_t corners = 0;
    for (std::string_view word; !(word = take_word(text)).empty(); ++corners) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::size_t v = index(word.substr(0, slash), vertices_so_far_, vertices_);
      result_.text += fmt::format(" {}", v + 1);
      if (slash + 1 >= word.size()) continue;
      const std::string_view more = word.substr(slash + 1);
      const std::string_view second = more.substr(0, std::min(more.find('/'), more.size()));
      if (second.empty()) continue;
      const std::size_t t = index(second, texture_so_far_, texture_);
      result_.text += fmt::format("/{}", t + 1);
      result_.has_texture = true;
      std::size_t& known = texture_of_[v];
      if (known != 0 && known != t + 1) {
        fail(fmt::format("vertex {} has texture coordinates {} and {}; a mesh keeps one per vertex", v + 1,
                         known, t + 1));
      }
      known = t + 1;
    }
    if (corners < 3) fail(fmt::format("a face with {} corners", corners));
    result_.text += '\n';
    ++result_.faces;
    result_.corners += corners;
  }

  std::string_view bytes_;
  const std::string& origin_;
  int line_ = 0;
  std::size_t vertices_ = 0, texture_ = 0, vertices_so_far_ = 0, texture_so_far_ = 0;
  std::vector<std::size_t> texture_of_;  // from 1, per vertex; 0: none
  ScannedMesh result_;
};

}  // namespace

ScannedMesh scan_ply(std::string_view bytes, const std::string& origin) {
  return PlyScan(bytes, origin).run();
}
ScannedMesh scan_obj(std::string_view bytes, const std::string& origin) {
  return ObjScan(bytes, origin).run();
}

}  // namespace terrabench
