// A small typed set of named values, shared by the command line, JSON records and the report.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace terrabench {

using Value = std::variant<bool, std::int64_t, double, std::string>;
std::string to_string(const Value&);

// One parameter that a method takes. The type is the type of `fallback`; numbers lie in [lowest, highest], a
// text is one of `allowed` unless that is empty.
struct ParameterSpec {
  std::string_view name;
  Value fallback;
  std::string_view unit;  // "m", "samples", "" for none
  std::string_view help;
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  std::span<const std::string_view> allowed = {};
};

// A text parameter that takes one of `allowed`, which must outlive the spec; the first is the fallback.
ParameterSpec choice(std::string_view name, std::span<const std::string_view> allowed, std::string_view help);

// What a parameter takes, for help texts: "true or false", "a whole number between 1 and 512 samples",
// "a number in m", "off, sampled or conservative", "text".
std::string accepted_values(const ParameterSpec&);

// Values for a list of specs; a value that is not set is the fallback. The specs are static tables: they must
// outlive the set.
class Parameters {
 public:
  Parameters() = default;
  // The fallbacks but for those given.
  Parameters(std::span<const ParameterSpec> specs,
             std::initializer_list<std::pair<std::string_view, Value>> given = {});

  // Throws usage_error for an unknown name (with the nearest), a value of another type, one out of range or
  // one that is not allowed (with the nearest); the value set before stays.
  void set(std::string_view name, const Value& value);
  // "key=value", as --set gives it.
  void set_from_text(std::string_view assignment);

  bool flag(std::string_view name) const;
  std::int64_t integer(std::string_view name) const;
  double number(std::string_view name) const;
  const std::string& text(std::string_view name) const;
  std::size_t choice(std::string_view name) const;  // the text's place in its spec's `allowed`

  bool has(std::string_view name) const;
  std::span<const ParameterSpec> specs() const { return specs_; }
  const Value& value(std::size_t spec) const { return values_[spec]; }

 private:
  std::size_t find(std::string_view name) const;  // throws unknown_name

  std::span<const ParameterSpec> specs_;
  std::vector<Value> values_;
};

// Splits the texts of --set such as "n=16,scale=2" into single assignments "n=16" and "scale=2". A comma ends
// a value where "name=" of one of the specs follows it, so that the value of a text parameter may contain
// other commas: "options=roam.a=1,clipmap.b=2". After a number, true or false, it ends the value before any
// "name=". Throws usage_error for a name that is set twice.
std::vector<std::string> split_assignments(std::span<const std::string> texts,
                                           std::span<const ParameterSpec> specs);

// A terrain's name that holds a file and adjustments: FILE[,NAME=VALUE…], as in
// "coast.png,sea_level=0.4,peak=1500".

struct NamedFile {
  std::string file;  // may hold commas
  Parameters options;
};
// Throws usage_error for an unknown adjustment and for a value that its spec does not take.
NamedFile parse_named_file(std::string_view text, std::span<const ParameterSpec> specs);

}  // namespace terrabench
