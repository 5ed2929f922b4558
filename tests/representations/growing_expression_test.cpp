// Expressions of models against an oracle that evaluates the tree it was printed from.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "representations/procedural_mesh/growing/expression.h"
#include "terrain/error.h"

namespace terrabench::growing {
namespace {

// A printed expression, its value, and how strongly its operator binds (8: needs no parentheses).
struct Tree {
  std::string text;
  double value;
  int level;
};

struct Sign {
  std::string_view text;
  int left, right, level;  // how strongly the operands must bind, and how strongly the whole does
  double (*value)(double, double);
};
constexpr Sign kSigns[] = {
    {"||", 1, 2, 1, [](double a, double b) { return a != 0 || b != 0 ? 1.0 : 0.0; }},
    {"&&", 2, 3, 2, [](double a, double b) { return a != 0 && b != 0 ? 1.0 : 0.0; }},
    {"<=", 4, 4, 3, [](double a, double b) { return a <= b ? 1.0 : 0.0; }},
    {"!=", 4, 4, 3, [](double a, double b) { return a != b ? 1.0 : 0.0; }},
    {"+", 4, 5, 4, [](double a, double b) { return a + b; }},
    {"-", 4, 5, 4, [](double a, double b) { return a - b; }},
    {"*", 5, 6, 5, [](double a, double b) { return a * b; }},
    {"/", 5, 6, 5, [](double a, double b) { return b == 0 ? std::nan("") : a / b; }},
    {"%", 5, 6, 5, [](double a, double b) { return b == 0 ? std::nan("") : a - b * std::floor(a / b); }},
    {"^", 8, 6, 6, [](double a, double b) { return std::pow(a, b); }}};

class RandomTrees {
 public:
  Tree make(int depth) {
    const int kind = depth == 0 ? 0 : pick(8);
    if (kind == 0) return leaf();
    const Tree a = valid(depth - 1);
    if (kind == 1) return {"-" + inside(a, 6), -a.value, 6};
    if (kind == 2) return {fmt::format("abs({})", a.text), std::abs(a.value), 8};
    if (kind == 3) {
      const Tree b = make(depth - 1), c = make(depth - 1);  // a value is asked only of the one that is chosen
      return {fmt::format("{} ? {} : {}", inside(a, 1), b.text, c.text), a.value != 0 ? b.value : c.value, 0};
    }
    const Tree b = valid(depth - 1);
    if (kind == 4) return {fmt::format("min({}, {})", a.text, b.text), std::min(a.value, b.value), 8};
    const Sign& sign = kSigns[pick(std::size(kSigns))];
    return {
        fmt::format("{}{}{}{}{}", inside(a, sign.left), space(), sign.text, space(), inside(b, sign.right)),
        sign.value(a.value, b.value), sign.level};
  }

 private:
  int pick(std::size_t n) { return static_cast<int>(random_() % n); }
  std::string_view space() { return pick(2) == 0 ? "" : " "; }

  Tree leaf() {
    if (pick(3) == 0) return {"x", 1.75, 8};
    if (pick(3) == 0) return {fmt::format("t[{}]", pick(2)), 0, 8};
    const double number = pick(100) / 8.0;
    return {fmt::format("{}", number), number, 8};
  }

  // Where a part has no value, the whole has none; such trees are replaced by a number.
  Tree valid(int depth) {
    const Tree tree = make(depth);
    return std::isfinite(tree.value) ? tree : Tree{"0.5", 0.5, 8};
  }

  // Parentheses where the grammar needs them, and sometimes where it does not.
  std::string inside(const Tree& tree, int least) {
    return tree.level >= least && pick(4) != 0 ? tree.text : "(" + tree.text + ")";
  }

  std::mt19937 random_{1};
};

class GrowingExpression : public testing::Test {
 protected:
  GrowingExpression() {
    names_.add_variable("x", "test", {});
    names_.add_table("t", {0, 0}, "test", {});
    names_.add_table("half", {0.5}, "test", {});
  }
  double value(std::string_view text, std::uint64_t random = 1) {
    const double x = 1.75;
    return evaluate(compile(text, "test", {3, 5}, names_, number_), {{&x, 1}, names_.tables(), random});
  }
  std::string error(std::string_view text) {
    try {
      value(text);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
  Names names_;
  std::uint32_t number_ = 0;
};

TEST_F(GrowingExpression, AgreesWithTheTreeItWasPrintedFrom) {
  RandomTrees trees;
  int without_value = 0;
  for (int i = 0; i < 5000; ++i) {
    const Tree tree = trees.make(1 + i % 5);
    const double found = value(tree.text);
    without_value += std::isfinite(tree.value) ? 0 : 1;
    EXPECT_TRUE(std::isfinite(tree.value) ? found == tree.value : std::isnan(found)) << tree.text;
  }
  EXPECT_GT(without_value, 10);
}

TEST_F(GrowingExpression, DividingByZeroHasNoValueButOnlyWhereItIsEvaluated) {
  for (const char* const none :
       {"1/0 > 0 ? 1 : 2", "0*(1/0)", "5 % 0", "log(0)", "sqrt(-1)", "10^400", "t[2]", "t[-1]"}) {
    EXPECT_TRUE(std::isnan(value(none))) << none;
  }
  EXPECT_EQ(value("0 && 1/0"), 0);
  EXPECT_EQ(value("1 || 1/0"), 1);
  EXPECT_EQ(value("1 ? 3 : 1/0"), 3);
}

TEST_F(GrowingExpression, AnglesAreDegreesAndPowersBindFirst) {
  EXPECT_NEAR(value("sin(30)"), 0.5, 1e-15);
  EXPECT_NEAR(value("atan2(1, 1)"), 45, 1e-13);
  const std::pair<const char*, double> known[] = {{"-2^2", -4},  {"2^3^2", 512}, {"7 - 2 - 1", 4},
                                                  {"-1 % 3", 2}, {"half*4", 2},  {"!0 + 1", 2}};
  for (const auto& [text, expected] : known) EXPECT_EQ(value(text), expected) << text;
}

TEST_F(GrowingExpression, RandomNumbersDependOnKeyAndPlaceAndFillTheirRange) {
  number_ = 7;
  const double first = value("random()", 5);
  number_ = 7;
  EXPECT_EQ(value("random()", 5), first);
  EXPECT_NE(value("random()", 5), first);  // another place
  double sum = 0, least = 1, most = -1;
  for (std::uint64_t key = 0; key < 4000; ++key) {
    number_ = 0;
    const double r = value("random(-1, 1)", key);
    sum += r;
    least = std::min(least, r);
    most = std::max(most, r);
  }
  EXPECT_GE(least, -1);
  EXPECT_LT(least, -0.99);
  EXPECT_LT(most, 1);
  EXPECT_GT(most, 0.99);
  EXPECT_NEAR(sum / 4000, 0, 0.05);  // 5 standard deviations: 5 · 0.577/√4000
}

TEST_F(GrowingExpression, ErrorsNameLineAndColumn) {
  std::string sum = "1";
  for (int i = 0; i < 4000; ++i) sum += "+1";
  const std::pair<std::string, const char*> refused[] = {{"1 + unknown", "test:3:9: unknown name 'unknown'"},
                                                         {"1 +", "test:3:8: the expression ends too early"},
                                                         {"(1", "test:3:7: expected ')'"},
                                                         {"1 2", "test:3:7: expected the end"},
                                                         {"1 < 2 < 3", "test:3:11: expected the end"},
                                                         {"sin(1, 2)", "test:3:5: 'sin' does not take 2"},
                                                         {"cosh(1)", "test:3:5: unknown function"},
                                                         {"1e999", "not valid"},
                                                         {std::string(5000, '('), "nested too deeply"},
                                                         {std::string(5000, '-'), "nested too deeply"},
                                                         {sum, "at most 4096 operations"}};
  for (const auto& [text, what] : refused) EXPECT_THAT(error(text), testing::HasSubstr(what)) << text;
}

TEST(GrowingNoise, IsContinuousBoundedAndZeroOnTheLattice) {
  double most = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = 0.37 * i, y = 0.011 * i - 20, z = 1.7 * i;
    const double here = gradient_noise(x, y, z);
    most = std::max(most, std::abs(here));
    EXPECT_NEAR(gradient_noise(x + 1e-7, y, z), here, 1e-6);
    EXPECT_EQ(gradient_noise(i, 3, -i), 0);
  }
  EXPECT_GT(most, 0.5);
  EXPECT_LE(most, 1);
}

}  // namespace
}  // namespace terrabench::growing
