#include "terrain/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include "terrain/error.h"
#include "terrain/number.h"

namespace terrabench {
namespace {

// "between 1 and 512 samples", "at least 0 m", or nothing where any number will do.
std::string range_text(const ParameterSpec& spec) {
  std::string text;
  if (std::isfinite(spec.lowest) && std::isfinite(spec.highest)) {
    text = fmt::format("between {} and {}", spec.lowest, spec.highest);
  } else if (std::isfinite(spec.lowest)) {
    text = fmt::format("at least {}", spec.lowest);
  } else if (std::isfinite(spec.highest)) {
    text = fmt::format("at most {}", spec.highest);
  }
  return text.empty() || spec.unit.empty() ? text : fmt::format("{} {}", text, spec.unit);
}

Error wrong_value(const ParameterSpec& spec, std::string_view expected, std::string_view given) {
  return usage_error(fmt::format("{} must be {}, got {}", spec.name, expected, given), "",
                     fmt::format("{}: {}", spec.name, spec.help));
}

Error wrong_type(const ParameterSpec& spec, std::string_view given) {
  return wrong_value(spec, accepted_values(spec), fmt::format("'{}'", given));
}

void check(const ParameterSpec& spec, const Value& value) {
  const auto in_range = [&](double number) {  // false for NaN
    return number >= spec.lowest && number <= spec.highest;
  };
  const auto* const integer = std::get_if<std::int64_t>(&value);
  const auto* const real = std::get_if<double>(&value);
  if ((integer != nullptr && !in_range(static_cast<double>(*integer))) ||
      (real != nullptr && !in_range(*real))) {
    const std::string range = range_text(spec);
    throw wrong_value(spec, range.empty() ? "a number" : range, to_string(value));
  }
  if (const auto* const text = std::get_if<std::string>(&value);
      text != nullptr && !spec.allowed.empty() &&
      std::find(spec.allowed.begin(), spec.allowed.end(), *text) == spec.allowed.end()) {
    throw usage_error(invalid_value(spec.name, *text, spec.allowed), "",
                      fmt::format("{}: {}", spec.name, spec.help));
  }
}

}  // namespace

std::string to_string(const Value& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

ParameterSpec choice(std::string_view name, std::span<const std::string_view> allowed,
                     std::string_view help) {
  return {.name = name, .fallback = std::string(allowed[0]), .unit = "", .help = help, .allowed = allowed};
}

std::string accepted_values(const ParameterSpec& spec) {
  constexpr std::string_view kTypes[] = {"true or false", "a whole number", "a number", "text"};
  if (!spec.allowed.empty()) return alternatives(spec.allowed);
  const std::string range = range_text(spec);
  const std::string_view type = kTypes[spec.fallback.index()];
  if (!range.empty()) return fmt::format("{} {}", type, range);
  return spec.unit.empty() ? std::string(type) : fmt::format("{} in {}", type, spec.unit);
}

Parameters::Parameters(std::span<const ParameterSpec> specs,
                       std::initializer_list<std::pair<std::string_view, Value>> given)
    : specs_(specs) {
  for (const ParameterSpec& spec : specs) values_.push_back(spec.fallback);
  for (const auto& [name, value] : given) set(name, value);
}

std::size_t Parameters::find(std::string_view name) const {
  const auto it =
      std::find_if(specs_.begin(), specs_.end(), [&](const auto& spec) { return spec.name == name; });
  if (it != specs_.end()) return static_cast<std::size_t>(it - specs_.begin());
  std::vector<std::string_view> known;
  for (const ParameterSpec& spec : specs_) known.push_back(spec.name);
  throw unknown_name("parameter", name, known);
}

bool Parameters::has(std::string_view name) const {
  return std::any_of(specs_.begin(), specs_.end(), [&](const auto& spec) { return spec.name == name; });
}

void Parameters::set(std::string_view name, const Value& value) {
  const std::size_t at = find(name);
  const ParameterSpec& spec = specs_[at];
  Value typed = value;
  if (std::holds_alternative<double>(spec.fallback) && std::holds_alternative<std::int64_t>(value)) {
    typed = static_cast<double>(std::get<std::int64_t>(value));
  }
  if (typed.index() != spec.fallback.index()) throw wrong_type(spec, to_string(value));
  check(spec, typed);
  values_[at] = std::move(typed);
}

void Parameters::set_from_text(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw usage_error(
        fmt::format("invalid assignment '{}': expected name=value", assignment), "",
        specs_.empty() ? "" : fmt::format("such as {}={}", specs_[0].name, to_string(specs_[0].fallback)));
  }
  const std::string_view name = assignment.substr(0, equals), text = assignment.substr(equals + 1);
  const ParameterSpec& spec = specs_[find(name)];
  Value value;
  if (std::holds_alternative<bool>(spec.fallback)) {
    if (text != "true" && text != "false") throw wrong_type(spec, text);
    value = text == "true";
  } else if (std::holds_alternative<std::int64_t>(spec.fallback)) {
    const auto integer = parse_number<std::int64_t>(text);
    if (!integer) throw wrong_type(spec, text);
    value = *integer;
  } else if (std::holds_alternative<double>(spec.fallback)) {
    const auto number = parse_number<double>(text);
    if (!number) throw wrong_type(spec, text);
    value = *number;
  } else {
    value = std::string(text);
  }
  set(name, value);
}

bool Parameters::flag(std::string_view name) const { return std::get<bool>(values_[find(name)]); }
std::int64_t Parameters::integer(std::string_view name) const {
  return std::get<std::int64_t>(values_[find(name)]);
}
double Parameters::number(std::string_view name) const { return std::get<double>(values_[find(name)]); }
const std::string& Parameters::text(std::string_view name) const {
  return std::get<std::string>(values_[find(name)]);
}
std::size_t Parameters::choice(std::string_view name) const {
  const std::span<const std::string_view> allowed = specs_[find(name)].allowed;
  return static_cast<std::size_t>(std::find(allowed.begin(), allowed.end(), text(name)) - allowed.begin());
}

std::vector<std::string> split_assignments(std::span<const std::string> texts,
                                           std::span<const ParameterSpec> specs) {
  std::vector<std::string> all;
  for (const std::string& text : texts) {
    bool first = true, more = true, value_is_text = false;
    for (std::string_view rest = text; more;) {
      const std::string_view part = rest.substr(0, rest.find(','));
      more = part.size() < rest.size();
      rest.remove_prefix(part.size() + (more ? 1 : 0));
      const std::size_t equals = part.find('=');
      const auto spec = std::find_if(specs.begin(), specs.end(), [&](const ParameterSpec& s) {
        return equals != part.npos && s.name == part.substr(0, equals);
      });
      if (first || spec != specs.end() || (equals != part.npos && !value_is_text)) {
        all.emplace_back(part);
        value_is_text = spec != specs.end() && std::holds_alternative<std::string>(spec->fallback);
      } else {
        all.back().append(",").append(part);
      }
      first = false;
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto name = [](const std::string& assignment) {
      return std::string_view(assignment).substr(0, assignment.find('='));
    };
    const auto same = [&](const std::string& other) { return name(other) == name(all[i]); };
    if (std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i), same)) {
      throw usage_error(fmt::format("'{}' is set twice", name(all[i])), "--set", "leave out one");
    }
  }
  return all;
}

namespace {

// Where the adjustments begin: at a comma with "word=" behind it.
std::size_t end_of_file_name(std::string_view text) {
  for (std::size_t at = text.find(','); at != text.npos; at = text.find(',', at + 1)) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", at + 1);
    if (end != text.npos && end > at + 1 && text[end] == '=') return at;
  }
  return text.size();
}

}  // namespace

NamedFile parse_named_file(std::string_view text, std::span<const ParameterSpec> specs) {
  std::error_code ignored;
  const bool whole = std::filesystem::exists(std::filesystem::path(text), ignored);
  const std::size_t end = whole ? text.size() : end_of_file_name(text);
  NamedFile named{std::string(text.substr(0, end)), Parameters(specs)};
  std::vector<std::string_view> given;
  for (std::string_view rest = text.substr(end); !rest.empty();) {
    rest.remove_prefix(1);  // the comma
    const std::string_view assignment = rest.substr(0, rest.find(','));
    const std::string_view name = assignment.substr(0, assignment.find('='));
    if (std::ranges::find(given, name) != given.end()) {
      throw usage_error(fmt::format("'{}' is set twice", name), text, "leave out one");
    }
    given.push_back(name);
    named.options.set_from_text(assignment);
    rest.remove_prefix(assignment.size());
  }
  return named;
}

}  // namespace terrabench
