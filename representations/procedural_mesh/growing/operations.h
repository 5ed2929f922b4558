// Codes of the stack machine of expression.h, and its functions by name.
#pragma once

#include <cstdint>
#include <string_view>

namespace terrabench::growing {

enum class Code : std::uint16_t {
  kNumber,
  kVariable,
  kTable,      // replaces an index by the entry
  kJump,       // always
  kJumpIfNot,  // pops
  kTruth,      // replaces a number by 1 or 0
  kRandom,
  kRandomBetween,
  kNegate,
  kNot,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kModulo,
  kPower,
  kLess,
  kLessOrEqual,
  kGreater,
  kGreaterOrEqual,
  kEqual,
  kNotEqual,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan2,
  kSqrt,
  kAbs,
  kFloor,
  kCeil,
  kRound,
  kSign,
  kExp,
  kLog,
  kMin,
  kMax,
  kClamp,
  kMix,
  kNoise,
};

struct FunctionName {
  std::string_view name;
  Code code;
  int arguments;
};
inline constexpr FunctionName kFunctions[] = {
    {"sin", Code::kSin, 1},     {"cos", Code::kCos, 1},       {"tan", Code::kTan, 1},
    {"asin", Code::kAsin, 1},   {"acos", Code::kAcos, 1},     {"atan2", Code::kAtan2, 2},
    {"sqrt", Code::kSqrt, 1},   {"abs", Code::kAbs, 1},       {"floor", Code::kFloor, 1},
    {"ceil", Code::kCeil, 1},   {"round", Code::kRound, 1},   {"sign", Code::kSign, 1},
    {"exp", Code::kExp, 1},     {"log", Code::kLog, 1},       {"min", Code::kMin, 2},
    {"max", Code::kMax, 2},     {"clamp", Code::kClamp, 3},   {"mix", Code::kMix, 3},
    {"noise", Code::kNoise, 3}, {"random", Code::kRandom, 0}, {"random", Code::kRandomBetween, 2}};

}  // namespace terrabench::growing
