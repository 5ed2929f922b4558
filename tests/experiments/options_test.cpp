// Every value of every option is checked, and every command has a name. The options are read from the help
// texts, so that one added later is tested, too.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>

#include "terrain/files.h"
#include "terrain/sources/dem/dem.h"
#include "tests/experiments/command_line.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

struct OptionHelp {
  std::string name, type;  // "FLOAT", "INT", "UINT" or "TEXT"
  int values = 1;
};

class Options : public CommandLine {
 protected:
  Options() { write_geotiff(folder_ / "hills.tif", test::flat(9, 9, 7)); }

  std::vector<OptionHelp> options_of(const std::string& command) const {
    const std::regex line(
        "^  (--[a-z-]+)[^ ]* (FLOAT|INT|UINT|TEXT)[^ ]*( in \\[[^\\]]*\\])?( x ([0-9]+))?.*");
    std::istringstream help(call("$T help " + command).text);
    std::vector<OptionHelp> all;
    std::smatch found;
    for (std::string text; std::getline(help, text);) {
      if (!std::regex_match(text, found, line)) continue;
      all.push_back({found[1], found[2], found[5].matched ? std::stoi(found[5]) : 1});
    }
    return all;
  }
  void expect_refused(const std::string& command, const OptionHelp& option, const std::string& value) const {
    std::string values;
    for (int k = 0; k < option.values; ++k) values += " '" + value + "'";
    const Outcome outcome = call(command + " " + option.name + values);
    EXPECT_EQ(outcome.code, 2) << command << ' ' << option.name << values << '\n' << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(option.name)) << values;
  }
};

// What each command needs besides.
const std::map<std::string, std::string> kCommands{
    {"run", "$T run hybrid.table1"},    {"check", "$T check out"},
    {"report", "$T report out"},        {"represent", "$T represent hills.tif --as heightmap"},
    {"export", "$T export a.tb b.tif"}, {"render", "$T render hills.tif"}};

TEST_F(Options, NumbersAreNumbersAndNothingIsEmpty) {
  std::size_t numbers = 0, texts = 0;
  for (const auto& [command, start] : kCommands) {
    for (const OptionHelp& option : options_of(command)) {
      expect_refused(start, option, "");
      if (option.values == 1) {  // not the next argument
        EXPECT_EQ(call(start + " " + option.name + "= 1").code, 2) << command << ' ' << option.name;
      }
      if (option.type == "TEXT") {
        ++texts;
        continue;
      }
      ++numbers;
      for (const char* const value :
           {"nan", "-nan", "inf", "-inf", "1e999", "abc", "1,5", " 5", "5 ", "5x", "0x10"})
        expect_refused(start, option, value);
      if (option.type == "FLOAT") continue;
      for (const char* const value :
           {"1.5", "010", "9223372036854775808", "18446744073709551615", "4294967297e0"})
        expect_refused(start, option, value);
      if (option.type == "UINT") expect_refused(start, option, "-1");
    }
  }
  // --jobs, --threads and --seed of run; --budget-bytes, --max-rmse, --crop, --resample, --erode,
  // --samples, --threads and --seed of represent; --frames, --detail, --eye, --look-at, --up, --fov,
  // --seconds,
  // --samples, --threads and --seed of render.
  EXPECT_GE(numbers, 21U);
  EXPECT_GE(texts, 20U);
}

TEST_F(Options, ShardsCountFromOneToTheirNumber) {
  for (const char* const shard : {"0/1", "2/1", "-1/2", "1/0", "1", "/", "1/", "/1", "1/2/3", "1/2x", "a/b",
                                  "1 /2", "4294967297/4294967297", "1/99999999999999999999"}) {
    const Outcome outcome = call(fmt::format("$T run hybrid.table1 --shard '{}'", shard));
    EXPECT_EQ(outcome.code, 2) << shard << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(fmt::format("invalid shard '{}'", shard)));
  }
}

TEST_F(Options, NothingIsGivenTwice) {
  EXPECT_EQ(call("cp hills.tif other.tif").code, 0);
  for (const char* const two :
       {"jacksboro jacksboro", "hills.tif ./hills.tif", "hills.tif other.tif hills.tif"}) {
    const Outcome outcome = call(fmt::format("$T run drill.size --terrain {}", two));
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("is given twice")) << two;
  }
  for (const char* const set :
       {"--set tau=50,w=4,tau=60", "--set tau=50 --set tau=50", "--max-rmse 5 --set max_rmse=6"}) {
    const Outcome outcome = call(fmt::format("$T represent hills.tif --as drill {}", set));
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("is set twice")) << set;
  }
}

TEST_F(Options, AnUnknownCommandIsNamed) {
  const auto expect = [&](const std::string& words, int code, const std::string& text) {
    const Outcome outcome = call("$T " + words);
    EXPECT_EQ(outcome.code, code) << words << '\n' << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(text)) << words;
  };
  expect("reprot out", 2, "unknown command 'reprot'; did you mean 'report'?");
  expect("nonsense --help", 2, "unknown command 'nonsense'");
  expect("--allow-network redner", 2, "did you mean 'render'?");
  expect("help nonsense", 2, "unknown command 'nonsense'");
  expect("help", 0, "Write tables, plots and a web page");
  expect("help represent", 0, "Examples:");
  expect("help run", 0, "--shard");
  expect("run --help", 0, "--shard");
  EXPECT_EQ(call("$T version").text, call("$T --version").text);
  EXPECT_EQ(call("$T version").code, 0);
  EXPECT_EQ(call("$T").code, 2);
}

TEST_F(Options, MessagesNameWhatTheUserGave) {
  EXPECT_EQ(call("cp hills.tif a.png").code, 0);
  const Outcome drawing = call("$T info 'drawing:a.png,cell=2,x'");
  EXPECT_THAT(drawing.text, HasSubstr("invalid assignment 'x'"));
  EXPECT_THAT(drawing.text, Not(HasSubstr("--set")));
  const Outcome temporary = call("TMPDIR=/none/such $T run cross.round-trip --shard 1/1000 --out out");
  EXPECT_EQ(temporary.code, 4) << temporary.text;
  EXPECT_THAT(temporary.text, HasSubstr("/none/such: no folder for temporary files"));
  EXPECT_THAT(temporary.text, HasSubstr("set TMPDIR"));
}

}  // namespace
}  // namespace terrabench
