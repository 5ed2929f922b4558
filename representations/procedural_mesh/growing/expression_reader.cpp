#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "representations/procedural_mesh/growing/expression.h"
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
  if (std::ranges::count(functions(), name, &Function::name) > 0 || find(name) != nullptr) {
    throw bad_input(fmt::format("the name '{}' is already in use", name), where, "choose another name");
  }
}

std::uint32_t Names::add_variable(std::string_view name, const std::string& file, Place place) {
  check(name, file, place);
  entries_.emplace(name, Entry{false, variables_, 1});
  return variables_++;
}

void Names::add_table(std::string_view name, std::vector<double> values, const std::string& file,
                      Place place) {
  check(name, file, place);
  entries_.emplace(name, Entry{true, static_cast<std::uint32_t>(tables_.size()),
                               static_cast<std::uint32_t>(values.size())});
  tables_.insert(tables_.end(), values.begin(), values.end());
}

const Names::Entry* Names::find(std::string_view name) const {
  const auto found = entries_.find(name);
  if (found != entries_.end()) return &found->second;
  return outer_ == nullptr ? nullptr : outer_->find(name);
}

std::vector<std::string_view> Names::known() const {
  std::vector<std::string_view> names;
  if (outer_ != nullptr) names = outer_->known();
  for (const auto& [name, entry] : entries_) names.push_back(name);
  return names;
}

Expression constant(double value, Place place) { return {{{.value = value}}, place}; }

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
std::size_t Reader::emit(Operation operation, int pushes) {
  if (code_.size() == kMostOperations) {
    fail(fmt::format("an expression must have at most {} operations", kMostOperations), "shorten it");
  }
  stack_ += pushes;
  if (stack_ > kMostStack) fail("the expression is nested too deeply", "shorten it");
  code_.push_back(operation);
  return code_.size() - 1;
}

void Reader::call(double (*function)(const double*), std::uint16_t arguments) {
  emit({.code = Code::kCall, .arguments = arguments, .call = function}, 1 - arguments);
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

void Reader::choice() {
  if (++nesting_ > kMostNesting) fail("the expression is nested too deeply", "shorten it");
  either();
  if (take("?")) {
    const std::size_t to_second = jump(Code::kJumpIfNot);
    choice();
    const std::size_t to_end = jump(Code::kJump);
    expect(":");
    jump_here(to_second);
    choice();
    jump_here(to_end);
  }
  --nesting_;
}

namespace {

double truth(const double* a) { return a[0] != 0 ? 1 : 0; }

}  // namespace

void Reader::either() {
  both();
  while (take("||")) {
    const std::size_t to_second = jump(Code::kJumpIfNot);
    emit({.value = 1}, 1);
    const std::size_t to_end = jump(Code::kJump);
    jump_here(to_second);
    both();
    call(truth, 1);
    jump_here(to_end);
  }
}

void Reader::both() {
  binary(0);
  while (take("&&")) {
    const std::size_t to_false = jump(Code::kJumpIfNot);
    binary(0);
    call(truth, 1);
    const std::size_t to_end = jump(Code::kJump);
    jump_here(to_false);
    emit({.value = 0}, 1);
    jump_here(to_end);
  }
}

// What is joined by the signs of this level or higher ones. Comparisons, of level 0, do not follow one
// another.
void Reader::binary(int level) {
  if (level == kLevels) return unary();
  binary(level + 1);
  const auto next = [&] {
    return std::ranges::find_if(signs(), [&](const Function& s) { return s.level == level && take(s.name); });
  };
  for (auto sign = next(); sign != signs().end(); sign = next()) {
    binary(level + 1);
    emit({.code = sign->code, .arguments = 2, .call = sign->call}, -1);
    if (level == 0) return;
  }
}

void Reader::unary() {
  if (++nesting_ > kMostNesting) fail("the expression is nested too deeply", "shorten it");
  skip_space();
  if (take("-")) {
    unary();
    call([](const double* a) { return -a[0]; }, 1);
  } else if (!text_.substr(at_).starts_with("!=") && take("!")) {
    unary();
    call([](const double* a) { return a[0] == 0 ? 1.0 : 0.0; }, 1);
  } else {
    primary();
    if (take("^")) {
      unary();
      call([](const double* a) { return std::pow(a[0], a[1]); }, 2);
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
  emit({.value = value}, 1);
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
  for (const Function& f : functions()) {
    if (f.name != name) continue;
    known = true;
    if (f.arguments != arguments) continue;
    if (f.code == Code::kCall) return call(f.call, f.arguments);
    emit({.code = f.code, .where = random_number_++, .value = 0}, 1 - arguments);
    return;
  }
  at_ = begin;
  if (known) fail(fmt::format("'{}' does not take {} arguments", name, arguments), "see docs/models.md");
  std::vector<std::string_view> names;
  for (const Function& f : functions()) names.push_back(f.name);
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
    emit({.code = Code::kVariable, .where = entry->first, .value = 0}, 1);
  } else if (entry->count == 1 && !text_.substr(at_).starts_with("[")) {
    emit({.value = names_.tables()[entry->first]}, 1);
  } else {
    expect("[");
    choice();
    expect("]");
    emit({.code = Code::kTable, .where = entry->first, .value = static_cast<double>(entry->count)}, 0);
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
