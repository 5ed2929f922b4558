#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "representations/procedural_mesh/growing/expression.h"
#include "representations/procedural_mesh/growing/operations.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

void Names::check(std::string_view name, const std::string& file, Place place) const {
  const std::string where = fmt::format("{}:{}:{}", file, place.line, place.column);
  const bool identifier =
      !name.empty() && is_letter(name[0]) &&
      std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
  if (!identifier) {
    throw bad_input(fmt::format("'{}' cannot be a name", name), where, "use letters, digits and underscores");
  }
  const bool function = std::any_of(std::begin(kFunctions), std::end(kFunctions),
                                    [&](const FunctionName& f) { return f.name == name; });
  if (function || find(name) != nullptr) {
    throw bad_input(fmt::format("the name '{}' is already in use", name), where, "choose another name");
  }
}

std::uint32_t Names::add_variable(std::string_view name, const std::string& file, Place place) {
  check(name, file, place);
  numbers_.emplace(name, entries_.size());
  entries_.push_back({std::string(name), false, variables_, 1});
  return variables_++;
}

void Names::add_table(std::string_view name, std::vector<double> values, const std::string& file,
                      Place place) {
  check(name, file, place);
  numbers_.emplace(name, entries_.size());
  entries_.push_back({std::string(name), true, static_cast<std::uint32_t>(tables_.size()),
                      static_cast<std::uint32_t>(values.size())});
  tables_.insert(tables_.end(), values.begin(), values.end());
}

const Names::Entry* Names::find(std::string_view name) const {
  const auto found = numbers_.find(name);
  if (found != numbers_.end()) return &entries_[found->second];
  return outer_ == nullptr ? nullptr : outer_->find(name);
}

std::vector<std::string_view> Names::known() const {
  std::vector<std::string_view> names;
  if (outer_ != nullptr) names = outer_->known();
  for (const Entry& entry : entries_) names.push_back(entry.name);
  return names;
}

Expression constant(double value, Place place) {
  Expression result;
  result.code.push_back({static_cast<std::uint16_t>(Code::kNumber), 0, 0, value});
  result.place = place;
  return result;
}

void Reader::fail(std::string_view what, std::string_view advice) const {
  const Place here = place();
  throw bad_input(what, fmt::format("{}:{}:{}", file_, here.line, here.column), advice);
}

void Reader::skip_space() {
  while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
}

bool Reader::take(std::string_view symbol) {
  skip_space();
  if (!text_.substr(at_).starts_with(symbol)) return false;
  at_ += symbol.size();
  return true;
}

void Reader::expect(std::string_view symbol) {
  if (take(symbol)) return;
  const std::string found = at_ < text_.size() ? fmt::format("'{}'", text_[at_]) : "the end";
  fail(fmt::format("expected '{}', found {}", symbol, found), "correct the expression");
}

bool Reader::at_end() {
  skip_space();
  return at_ == text_.size();
}

void Reader::expect_end() {
  if (!at_end()) fail(fmt::format("expected the end, found '{}'", text_[at_]), "correct the expression");
}

std::string_view Reader::identifier() {
  skip_space();
  const std::size_t begin = at_;
  if (at_ < text_.size() && is_letter(text_[at_])) {
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

// The stack's depth is followed in the order of the code; both ways of a choice leave one number.
std::uint32_t Reader::emit(Operation operation, int pushes) {
  if (code_.size() == kMostOperations) {
    fail(fmt::format("an expression must have at most {} operations", kMostOperations), "shorten it");
  }
  stack_ += pushes;
  if (stack_ > kMostStack) fail("the expression is nested too deeply", "shorten it");
  code_.push_back(operation);
  return static_cast<std::uint32_t>(code_.size() - 1);
}

Expression Reader::read(void (Reader::*rule)()) {
  Expression result;
  skip_space();
  result.place = place();
  code_.clear();
  stack_ = nesting_ = 0;
  (this->*rule)();
  result.code = std::move(code_);
  return result;
}

Expression Reader::expression() { return read(&Reader::choice); }
Expression Reader::condition() { return read(&Reader::either); }

namespace {

Operation operation(Code code, int arguments = 0, std::uint32_t where = 0, double value = 0) {
  return {static_cast<std::uint16_t>(code), static_cast<std::uint16_t>(arguments), where, value};
}

}  // namespace

void Reader::choice() {
  if (++nesting_ > kMostNesting) fail("the expression is nested too deeply", "shorten it");
  either();
  if (take("?")) {
    const std::uint32_t to_second = emit(operation(Code::kJumpIfNot), -1);
    choice();
    const std::uint32_t to_end = emit(operation(Code::kJump), -1);
    expect(":");
    code_[to_second].where = static_cast<std::uint32_t>(code_.size());
    choice();
    code_[to_end].where = static_cast<std::uint32_t>(code_.size());
  }
  --nesting_;
}

void Reader::either() {
  both();
  while (take("||")) {
    const std::uint32_t to_second = emit(operation(Code::kJumpIfNot), -1);
    emit(operation(Code::kNumber, 0, 0, 1), 1);
    const std::uint32_t to_end = emit(operation(Code::kJump), -1);
    code_[to_second].where = static_cast<std::uint32_t>(code_.size());
    both();
    emit(operation(Code::kTruth, 1), 0);
    code_[to_end].where = static_cast<std::uint32_t>(code_.size());
  }
}

void Reader::both() {
  comparison();
  while (take("&&")) {
    const std::uint32_t to_false = emit(operation(Code::kJumpIfNot), -1);
    comparison();
    emit(operation(Code::kTruth, 1), 0);
    const std::uint32_t to_end = emit(operation(Code::kJump), -1);
    code_[to_false].where = static_cast<std::uint32_t>(code_.size());
    emit(operation(Code::kNumber), 1);
    code_[to_end].where = static_cast<std::uint32_t>(code_.size());
  }
}

void Reader::comparison() {
  sum();
  constexpr std::pair<std::string_view, Code> kSigns[] = {
      {"<=", Code::kLessOrEqual}, {">=", Code::kGreaterOrEqual},
      {"==", Code::kEqual},       {"!=", Code::kNotEqual},
      {"<", Code::kLess},         {">", Code::kGreater}};
  for (const auto& [sign, code] : kSigns) {
    if (!take(sign)) continue;
    sum();
    emit(operation(code, 2), -1);
    return;
  }
}

void Reader::sum() {
  product();
  while (true) {
    const bool plus = take("+");
    if (!plus && !take("-")) return;
    product();
    emit(operation(plus ? Code::kAdd : Code::kSubtract, 2), -1);
  }
}

void Reader::product() {
  unary();
  while (true) {
    const Code code = take("*")   ? Code::kMultiply
                      : take("/") ? Code::kDivide
                      : take("%") ? Code::kModulo
                                  : Code::kNumber;
    if (code == Code::kNumber) return;
    unary();
    emit(operation(code, 2), -1);
  }
}

void Reader::unary() {
  if (++nesting_ > kMostNesting) fail("the expression is nested too deeply", "shorten it");
  skip_space();
  if (take("-")) {
    unary();
    emit(operation(Code::kNegate, 1), 0);
  } else if (!text_.substr(at_).starts_with("!=") && take("!")) {
    unary();
    emit(operation(Code::kNot, 1), 0);
  } else {
    primary();
    if (take("^")) {
      unary();
      emit(operation(Code::kPower, 2), -1);
    }
  }
  --nesting_;
}

void Reader::number() {
  double value = 0;
  const char* const begin = text_.data() + at_;
  const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (error != std::errc() || !std::isfinite(value))
    fail("the number is not valid", "correct the expression");
  at_ += static_cast<std::size_t>(end - begin);
  emit(operation(Code::kNumber, 0, 0, value), 1);
}

void Reader::function(std::string_view name, std::size_t begin) {
  int arguments = 0;
  if (!take(")")) {
    do {
      choice();
      ++arguments;
    } while (take(","));
    expect(")");
  }
  bool known = false;
  for (const FunctionName& f : kFunctions) {
    if (f.name != name) continue;
    known = true;
    if (f.arguments != arguments) continue;
    const bool random = f.code == Code::kRandom || f.code == Code::kRandomBetween;
    emit(operation(f.code, f.arguments, random ? random_number_++ : 0), 1 - arguments);
    return;
  }
  at_ = begin;
  if (known) fail(fmt::format("'{}' does not take {} arguments", name, arguments), "see docs/models.md");
  std::vector<std::string_view> names;
  for (const FunctionName& f : kFunctions) names.push_back(f.name);
  fail(fmt::format("unknown function '{}'", name), fmt::format("known: {}", fmt::join(names, ", ")));
}

void Reader::primary() {
  skip_space();
  if (at_ == text_.size()) fail("the expression ends too early", "complete it");
  if (is_digit(text_[at_]) || text_[at_] == '.') return number();
  if (take("(")) {
    choice();
    return expect(")");
  }
  const std::size_t begin = at_;
  const std::string_view name = identifier();
  if (name.empty()) fail(fmt::format("unexpected '{}'", text_[at_]), "correct the expression");
  if (take("(")) return function(name, begin);
  const Names::Entry* const entry = names_.find(name);
  if (entry == nullptr) {
    at_ = begin;
    fail(fmt::format("unknown name '{}'", name), fmt::format("known: {}", fmt::join(names_.known(), ", ")));
  }
  if (!entry->table) {
    emit(operation(Code::kVariable, 0, entry->first), 1);
  } else if (entry->count == 1 && !text_.substr(at_).starts_with("[")) {
    emit(operation(Code::kNumber, 0, 0, names_.tables()[entry->first]), 1);
  } else {
    expect("[");
    choice();
    expect("]");
    emit(operation(Code::kTable, 1, entry->first, entry->count), 0);
  }
}

Expression compile(std::string_view text, const std::string& file, Place place, const Names& names,
                   std::uint32_t& random_number) {
  Reader reader(text, file, place, names, random_number);
  Expression result = reader.expression();
  reader.expect_end();
  return result;
}

}  // namespace terrabench::growing
