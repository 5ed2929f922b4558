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

class RandomTrees {
 public:
  explicit RandomTrees(unsigned seed) : random_(seed) {}

  Tree make(int depth) {
    if (depth == 0) return leaf();
    switch (pick(7)) {
      case 0:
        return leaf();
      case 1:
        return binary(make(depth - 1), make(depth - 1));
      case 2:
        return comparison(make(depth - 1), make(depth - 1));
      case 3:
        return logical(make(depth - 1), make(depth - 1));
      case 4:
        return choice(make(depth - 1), make(depth - 1), make(depth - 1));
      case 5:
        return function(make(depth - 1), make(depth - 1));
      default:
        return negated(make(depth - 1));
    }
  }

 private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  std::string space() { return pick(2) == 0 ? "" : " "; }

  Tree leaf() {
    if (pick(3) == 0) return {"x", 1.75, 8};
    if (pick(3) == 0) return {fmt::format("t[{}]", pick(2)), 0, 8};
    const double number = pick(100) / 8.0;
    return {fmt::format("{}", number), number, 8};
  }

  // Parentheses where the grammar needs them, and sometimes where it does not.
  std::string inside(const Tree& tree, int least) {
    return tree.level >= least && pick(4) != 0 ? tree.text : "(" + tree.text + ")";
  }
  std::string join(const Tree& a, std::string_view sign, const Tree& b, int left, int right) {
    return fmt::format("{}{}{}{}{}", inside(a, left), space(), sign, space(), inside(b, right));
  }

  Tree binary(Tree a, Tree b) {
    fix(a), fix(b);
    switch (pick(6)) {
      case 0:
        return {join(a, "+", b, 4, 5), a.value + b.value, 4};
      case 1:
        return {join(a, "-", b, 4, 5), a.value - b.value, 4};
      case 2:
        return {join(a, "*", b, 5, 6), a.value * b.value, 5};
      case 3:
        return {join(a, "/", b, 5, 6), b.value == 0 ? std::nan("") : a.value / b.value, 5};
      case 4:
        return {join(a, "%", b, 5, 6),
                b.value == 0 ? std::nan("") : a.value - b.value * std::floor(a.value / b.value), 5};
      default:
        return {join(a, "^", b, 8, 6), std::pow(a.value, b.value), 6};
    }
  }
  Tree comparison(Tree a, Tree b) {
    fix(a), fix(b);
    const bool less = pick(2) == 0;
    return {join(a, less ? "<=" : "!=", b, 4, 4),
            (less ? a.value <= b.value : a.value != b.value) ? 1.0 : 0.0, 3};
  }
  Tree logical(Tree a, Tree b) {
    fix(a), fix(b);
    if (pick(2) == 0) return {join(a, "&&", b, 2, 3), a.value != 0 && b.value != 0 ? 1.0 : 0.0, 2};
    return {join(a, "||", b, 1, 2), a.value != 0 || b.value != 0 ? 1.0 : 0.0, 1};
  }
  Tree choice(Tree a, const Tree& b, const Tree& c) {
    fix(a);
    return {fmt::format("{} ? {} : {}", inside(a, 1), b.text, c.text), a.value != 0 ? b.value : c.value, 0};
  }
  Tree function(Tree a, Tree b) {
    fix(a), fix(b);
    if (pick(2) == 0) return {fmt::format("min({}, {})", a.text, b.text), std::min(a.value, b.value), 8};
    return {fmt::format("abs({})", a.text), std::abs(a.value), 8};
  }
  Tree negated(Tree a) {
    fix(a);
    return {"-" + inside(a, 6), -a.value, 6};
  }
  // Where a part has no value, the whole has none; such trees are replaced by a number.
  void fix(Tree& tree) {
    if (!std::isfinite(tree.value)) tree = {"0.5", 0.5, 8};
  }

  std::mt19937 random_;
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
  RandomTrees trees(1);
  int without_value = 0;
  for (int i = 0; i < 5000; ++i) {
    const Tree tree = trees.make(1 + i % 5);
    const double found = value(tree.text);
    if (std::isfinite(tree.value)) {
      EXPECT_EQ(found, tree.value) << tree.text;
    } else {
      ++without_value;
      EXPECT_TRUE(std::isnan(found)) << tree.text;
    }
  }
  EXPECT_GT(without_value, 10);
}

TEST_F(GrowingExpression, DividingByZeroHasNoValueButOnlyWhereItIsEvaluated) {
  EXPECT_TRUE(std::isnan(value("1/0 > 0 ? 1 : 2")));
  EXPECT_TRUE(std::isnan(value("0*(1/0)")));
  EXPECT_TRUE(std::isnan(value("5 % 0")));
  EXPECT_TRUE(std::isnan(value("log(0)")));
  EXPECT_TRUE(std::isnan(value("sqrt(-1)")));
  EXPECT_TRUE(std::isnan(value("10^400")));
  EXPECT_TRUE(std::isnan(value("t[2]")));
  EXPECT_TRUE(std::isnan(value("t[-1]")));
  EXPECT_EQ(value("0 && 1/0"), 0);
  EXPECT_EQ(value("1 || 1/0"), 1);
  EXPECT_EQ(value("1 ? 3 : 1/0"), 3);
}

TEST_F(GrowingExpression, AnglesAreDegreesAndPowersBindFirst) {
  EXPECT_NEAR(value("sin(30)"), 0.5, 1e-15);
  EXPECT_NEAR(value("atan2(1, 1)"), 45, 1e-13);
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("7 - 2 - 1"), 4);
  EXPECT_EQ(value("-1 % 3"), 2);
  EXPECT_EQ(value("half*4"), 2);
  EXPECT_EQ(value("!0 + 1"), 2);
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
  EXPECT_THAT(error("1 + unknown"), testing::StartsWith("test:3:9: unknown name 'unknown'"));
  EXPECT_THAT(error("1 +"), testing::StartsWith("test:3:8: the expression ends too early"));
  EXPECT_THAT(error("(1"), testing::StartsWith("test:3:7: expected ')'"));
  EXPECT_THAT(error("1 2"), testing::StartsWith("test:3:7: expected the end"));
  EXPECT_THAT(error("sin(1, 2)"), testing::StartsWith("test:3:5: 'sin' does not take 2"));
  EXPECT_THAT(error("cosh(1)"), testing::StartsWith("test:3:5: unknown function"));
  EXPECT_THAT(error("1e999"), testing::HasSubstr("not valid"));
  EXPECT_THAT(error(std::string(5000, '(')), testing::HasSubstr("nested too deeply"));
  EXPECT_THAT(error(std::string(5000, '-')), testing::HasSubstr("nested too deeply"));
  std::string sum = "1";
  for (int i = 0; i < 4000; ++i) sum += "+1";
  EXPECT_THAT(error(sum), testing::HasSubstr("at most 4096 operations"));
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
