#include "terrain/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "terrain/error.h"

namespace terrabench {
namespace {

template <class Number>
bool parse(std::string_view text, Number& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc() && end == text.data() + text.size();
}

std::string_view type_name(const Value& value) {
  constexpr std::string_view kNames[] = {"true or false", "a whole number", "a number", "text"};
  return kNames[value.index()];
}

Error wrong_value(const ParameterSpec& spec, std::string_view given) {
  std::string advice = fmt::format("'{}' takes {}", spec.name, type_name(spec.fallback));
  if (std::isfinite(spec.lowest) || std::isfinite(spec.highest)) {
    advice += fmt::format(" in [{}, {}]", spec.lowest, spec.highest);
  }
  if (!spec.unit.empty()) advice += fmt::format(" ({})", spec.unit);
  return usage_error(fmt::format("'{}' is not a value for it", given),
                     fmt::format("parameter '{}'", spec.name), fmt::format("{}: {}", advice, spec.help));
}

void check_range(const ParameterSpec& spec, const Value& value) {
  double number = 0;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    number = static_cast<double>(*integer);
  } else if (const auto* real = std::get_if<double>(&value)) {
    number = *real;
  } else {
    return;
  }
  // Written so that NaN fails too.
  if (!(number >= spec.lowest && number <= spec.highest)) throw wrong_value(spec, to_string(value));
}

}  // namespace

std::string to_string(const Value& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

Parameters::Parameters(std::span<const ParameterSpec> specs) : specs_(specs) {
  for (const ParameterSpec& spec : specs) values_.push_back(spec.fallback);
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
  if (typed.index() != spec.fallback.index()) throw wrong_value(spec, to_string(value));
  check_range(spec, typed);
  values_[at] = std::move(typed);
}

void Parameters::set_from_text(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw usage_error(fmt::format("'{}' is no assignment", assignment), "--set", "write name=value");
  }
  const std::string_view name = assignment.substr(0, equals), text = assignment.substr(equals + 1);
  const ParameterSpec& spec = specs_[find(name)];
  Value value;
  std::int64_t integer = 0;
  double number = 0;
  if (std::holds_alternative<bool>(spec.fallback)) {
    if (text != "true" && text != "false") throw wrong_value(spec, text);
    value = text == "true";
  } else if (std::holds_alternative<std::int64_t>(spec.fallback)) {
    if (!parse(text, integer)) throw wrong_value(spec, text);
    value = integer;
  } else if (std::holds_alternative<double>(spec.fallback)) {
    if (!parse(text, number)) throw wrong_value(spec, text);
    value = number;
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

}  // namespace terrabench
