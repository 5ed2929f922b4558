// TOML with characters beyond ASCII: allowed in strings and comments, refused elsewhere.
#include "terrain/toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string text_of(std::string_view toml) {
  return parse_toml(toml, "f", "mend it")["a"].value_or<std::string>("none");
}

TEST(Toml, StringsMayHoldAnyCharacter) {
  const std::pair<const char*, const char*> cases[] = {
      {"a = \"τ = 3″, 4² × é\"", "τ = 3″, 4² × é"},
      {"a = 'τ \\n \"é\" C:\\'", "τ \\n \"é\" C:\\"},
      {"a = \"tab \\t, quote \\\" é, \\\\\"", "tab \t, quote \" é, \\"},
      {"a = \"\\u00e9\\U000003c4 é\"", "éτ é"},
      {"a = \"𝄞 \U0010FFFF\"", "𝄞 \U0010FFFF"},
      {"a = \"é\u00A0\u2003\u2028\u0085 \uFEFF\"", "é\u00A0\u2003\u2028\u0085 \uFEFF"},
      {"a = \"\"\"\né\n\"τ\"\" \\\"\"\" ²\"\"\"\"\"", "é\n\"τ\"\" \"\"\" ²\"\""},
      {"a = '''\n'é' ''τ\\ \"\"\" ²'''''", "'é' ''τ\\ \"\"\" ²''"},
      {"a = \"\"\"one \\\n   étude \\  \n\n  τ\"\"\"", "one étude τ"},  // lines joined by a backslash
      {"a = \"\"\"one \\\n \u00A0two\"\"\"", "one \u00A0two"},
      {"a = \"\"\"é\r\nτ\"\"\"\r\nb = 1\r\n", "é\nτ"},
      {"a = \"\" # é", ""},
      {"a = '' # é", ""},
      {"a = \"\"\"\"\"\" # é", ""},
      {"\xEF\xBB\xBF"
       "a = 'é'",
       "é"},
      {"# τ \"é' ²\na = \"x\" # é \"\"\"\n# '''\nb = [1, # τ\n 2] # é", "x"},
      {"a = \"x\"\r\n# é\r\nb = 1979-05-27T07:32:00Z # é", "x"},
      {"'é\"' = {\"τ\".b = 1, c = ['²', \"³\"]} # é\na = \"x\"", "x"},
  };
  for (const auto& [toml, text] : cases) EXPECT_EQ(text_of(toml), text) << toml;
  const toml::table keys = parse_toml("[\"τ\".'é \\']\nb = 1979-05-27 # ²\n[[\"²\"]]\nd = -1.5e3", "f", "");
  EXPECT_EQ(keys["τ"]["é \\"]["b"].value<toml::date>(), (toml::date{1979, 5, 27}));
  EXPECT_EQ(keys["²"][0]["d"].value<double>(), -1500);
  EXPECT_EQ(keys["²"].node()->source().begin.line, 3U);
}

TEST(Toml, ElsewhereTheyAreRefusedWithLineAndColumn) {
  const std::pair<const char*, const char*> cases[] = {
      {"é = 1", "f:1:1: 'é' (U+00E9) outside a string or a comment"},
      {"a = 1\nb\u00A1 = 1", "f:2:2: '\u00A1' (U+00A1)"},
      {"# é\r\n\"é\" = 1\r\n  bτ = 1", "f:3:4: 'τ' (U+03C4)"},
      {"\xEF\xBB\xBF"
       "aé = 1",
       "f:1:2: 'é'"},
      {"a = é", "f:1:5: 'é'"},
      {"a = 12\u0499", "f:1:7: '\u0499' (U+0499)"},
      {"a = \"é\"\u00A0", "f:1:8: '\u00A0' (U+00A0)"},
      {"a = \"\"\"é\nτ\"\"\" τ", "f:2:6: 'τ'"},
      {"a = [1,\n\u3000 2]", "f:2:1: '\u3000' (U+3000)"},
      {"[a.²]", "f:1:4: '²'"},
      {"a = 1979-05-27\u202F07:32:00", "f:1:15: '\u202F'"},
      {"a = 1\uFEFF", "f:1:6: '\uFEFF' (U+FEFF)"},
      {"a = \"𝄞\" 𝄞", "f:1:9: '𝄞' (U+1D11E)"},
      {"a = \"\\é\"", "f:1:7: 'é' (U+00E9) after a backslash"},
      {"a = \"\"\"b\\é\"\"\"", "f:1:10: 'é' (U+00E9) after a backslash"},
      {"a = \"\xff\"", "f:1:6: byte 0xFF is not valid UTF-8"},
      {"# \xc3", "f:1:3: byte 0xC3 is not"},
      {"# \xc0\xaf", "f:1:3: byte 0xC0 is not"},          // overlong
      {"# \xe0\x80\xaf", "f:1:3: byte 0xE0 is not"},      // overlong
      {"a = '\xed\xa0\x80'", "f:1:6: byte 0xED is not"},  // a surrogate
      {"a = '\xf4\x90\x80\x80'", "f:1:6: byte 0xF4 is not"},
      {"a = 'é\x80'", "f:1:7: byte 0x80 is not"},
  };
  for (const auto& [toml, what] : cases) {
    const Failure failure = failure_of([&, text = toml] { (void)parse_toml(text, "f", "mend it"); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << toml;
    EXPECT_THAT(failure.what, StartsWith(what)) << toml;
    EXPECT_NE(failure.advice, "mend it") << toml;
  }
}

TEST(Toml, MalformedTextsAreRefusedByLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"a = ", "f:1: "},
      {"a = 1\n= 2", "f:2: "},
      {"a = \"é\n\"", "f:1: "},             // unterminated strings
      {"a = '\\τ\nb = 1'", "f:1: "},        //
      {"a = \"\"\"é\n\\", "f:2: "},         //
      {"a = 1 # é\nb = 'x", "f:2: "},       //
      {"a = 1\"é\"", "f:1: "},              // a quote within a value
      {"a = 1.\"é\"", "f:1: "},             //
      {"a = \"é\" \"τ\"", "f:1: "},         //
      {"a = \"\"\"b\\  é\"\"\"", "f:1: "},  // a backslash before spaces joins lines
      {"a = '''é''''''", "f:1: "},
      {"a = \"\"\"é\"\"\"'", "f:1: "},
      {"a = '''é'''\"", "f:1: "},
      {"# é\f\na = \x01", "f:1: "},
      {"a = 1979-05-27Tx7:32:00", "f:1: "},
  };
  for (const auto& [toml, what] : cases) {
    const Failure failure = failure_of([&, text = toml] { (void)parse_toml(text, "f", "mend it"); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << toml;
    EXPECT_THAT(failure.what, StartsWith(what)) << toml;
    EXPECT_EQ(failure.advice, "mend it") << toml;
  }
}

TEST(Toml, KeysOfManyPartsAreRefusedBeforeTheyExhaustTheStack) {
  const auto dotted = [](int parts, const std::string& part = "a") {
    std::string key = part;
    for (int i = 1; i < parts; ++i) key += "." + part;
    return key;
  };
  for (const std::string& text :
       {dotted(260000) + " = 1", "b = 1\n[" + dotted(260000) + "]\nc = 2", "[[" + dotted(260000) + "]]",
        "b = { " + dotted(260000) + " = 1 }", dotted(260000, "\"a\"") + " = 1",
        dotted(260000, "'a'") + " = 1", dotted(260000, " a ") + " = 'é'"}) {
    const Failure failure = failure_of([&] { (void)parse_toml(text, "f", "mend it"); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput);
    EXPECT_THAT(failure.what, HasSubstr("more than 100 parts"));
  }
  EXPECT_EQ(text_of(dotted(100) + " = 1"), "none");
  // Dots of numbers, strings and comments are of no key.
  std::string numbers = "b = [";
  for (int i = 0; i < 300; ++i) numbers += "1.5, ";
  EXPECT_EQ(text_of("a = \"" + dotted(300) + "\" # " + dotted(300) + "\n" + numbers + "]"), dotted(300));
}

}  // namespace
}  // namespace terrabench
