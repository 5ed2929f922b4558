// Arithmetic expressions of models: parameters, conditions and displacements of "meshgrow" (Tobler,
// Maierhofer and Wilkie, §3 and §4). A text is compiled once to code for a stack machine and evaluated many
// times.
//
//   expression = either ["?" expression ":" expression]
//   either = both {"||" both}          both = comparison {"&&" comparison}
//   comparison = sum [("<" | "<=" | ">" | ">=" | "==" | "!=") sum]
//   sum = product {("+" | "-") product}          product = unary {("*" | "/" | "%") unary}
//   unary = ("-" | "!") unary | power          power = primary ["^" unary]
//   primary = number | name | name "[" expression "]" | name "(" [expression {"," expression}] ")"
//           | "(" expression ")"
//
// Angles are degrees. Truth is any number but 0; comparisons give 1 or 0. a % b has the sign of b. What is
// not chosen by "?", "&&" or "||" is not evaluated. random() is in [0, 1), random(a, b) in [a, b): a function
// of Values::random and of where in the text it stands, so that results depend on no order and on no thread.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace terrabench::growing {

// Where a text begins in a file; both count from 1.
struct Place {
  std::uint32_t line = 1, column = 1;
};

// What names mean. Names, such as "size", are slots of Values::variables; constants are numbers or tables.
// Looking a name up takes O(log names).
class Names {
 public:
  Names() = default;
  // The names of `outer`, which must outlive this and not change, and variables of its own.
  explicit Names(const Names* outer) : outer_(outer), variables_(outer->variables_) {}
  // Throws bad_input at `place` where the name is taken or not an identifier.
  std::uint32_t add_variable(std::string_view name, const std::string& file, Place place);
  void add_table(std::string_view name, std::vector<double> values, const std::string& file, Place place);

  struct Entry {
    bool table;
    std::uint32_t first, count;  // the slot, or where the table lies in tables()
  };
  const Entry* find(std::string_view name) const;
  std::uint32_t variables() const { return variables_; }
  std::span<const double> tables() const { return outer_ != nullptr ? outer_->tables() : tables_; }
  std::vector<std::string_view> known() const;

 private:
  void check(std::string_view name, const std::string& file, Place place) const;
  const Names* outer_ = nullptr;
  std::map<std::string, Entry, std::less<>> entries_;
  std::vector<double> tables_;
  std::uint32_t variables_ = 0;
};

enum class Code : std::uint16_t {
  kNumber,
  kVariable,
  kTable,      // replaces an index by the entry
  kJump,       // always
  kJumpIfNot,  // pops
  kRandom,
  kRandomBetween,
  kAdd,  // the commonest signs need no call
  kSubtract,
  kMultiply,
  kCall,  // of a function of the topmost numbers, which its value replaces
};
struct Operation {
  Code code = Code::kNumber;
  std::uint16_t arguments = 0;
  std::uint32_t where = 0;  // slot, first entry of a table, jump target or number of a random()
  union {
    double value = 0;  // a number; the size of a table
    double (*call)(const double* arguments);
  };
};

// What an expression may call, by a name or by a sign between two numbers. Signs of a higher level bind
// first; those of a level from left to right.
struct Function {
  std::string_view name;
  std::uint16_t arguments;
  double (*call)(const double* arguments);
  Code code = Code::kCall;
  int level = -1;  // of a sign: 0 to kLevels - 1
};
inline constexpr int kLevels = 3;
std::span<const Function> functions();
std::span<const Function> signs();

struct Expression {
  std::vector<Operation> code;  // empty: not given
  Place place;
  bool given() const { return !code.empty(); }
};

// An expression that is one number.
Expression constant(double value, Place place = {});

struct Values {
  std::span<const double> variables, tables;
  std::uint64_t random = 0;
};

// What is said of a value that is none.
inline constexpr std::string_view kNotFinite = "the value is not a finite number",
                                  kKeepInRange = "check the divisors, and keep every value in its range";

// The value, or NaN where any operation on the way divides by zero, overflows, leaves a function's domain or
// a table's range. O(operations), no allocation.
double evaluate(const Expression&, const Values&);

// Most operations of one expression, and most levels of nesting.
inline constexpr std::size_t kMostOperations = 4096;
inline constexpr int kMostNesting = 100;
// Depth of the stack that any accepted expression needs at most.
inline constexpr int kMostStack = 256;

// Reads text that holds expressions, from left to right. Every failure throws bad_input with file, line and
// column, and what was expected.
class Reader {
 public:
  // `random_number` numbers the random()s of a model.
  Reader(std::string_view text, const std::string& file, Place place, const Names& names,
         std::uint32_t& random_number)
      : text_(text), file_(file), place_(place), names_(names), random_number_(random_number) {}

  Expression expression();
  Expression condition();         // what may stand before "?": an `either`
  std::string_view identifier();  // empty where there is none
  bool take(std::string_view symbol);
  void expect(std::string_view symbol);
  bool at_end();
  void expect_end();
  std::size_t position() const { return at_; }
  void go_to(std::size_t position) { at_ = position; }
  Place place() const { return {place_.line, place_.column + static_cast<std::uint32_t>(at_)}; }
  [[noreturn]] void fail(std::string_view what, std::string_view advice) const;

 private:
  void choice();
  void either();
  void both();
  void binary(int level);
  void unary();
  void primary();
  void number();
  void function(std::string_view name, std::size_t begin);
  std::size_t emit(Operation, int pushes);
  void call(double (*)(const double*), std::uint16_t arguments);
  std::size_t jump(Code code) { return emit({.code = code, .value = 0}, -1); }
  void jump_here(std::size_t from) { code_[from].where = static_cast<std::uint32_t>(code_.size()); }
  Expression read(void (Reader::*rule)());
  void skip_space();

  std::string_view text_;
  const std::string& file_;
  Place place_;
  const Names& names_;
  std::uint32_t& random_number_;
  std::size_t at_ = 0;
  std::vector<Operation> code_;
  int nesting_ = 0, stack_ = 0;
};

// The whole text as one expression.
Expression compile(std::string_view text, const std::string& file, Place place, const Names& names,
                   std::uint32_t& random_number);

// Gradient noise in [-1, 1], 0 at points with whole coordinates (Perlin 2002): what noise(x, y, z) gives.
double gradient_noise(double x, double y, double z);

}  // namespace terrabench::growing
