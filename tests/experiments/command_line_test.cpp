#include "tests/experiments/command_line.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "terrain/files.h"
#include "terrain/image.h"
#include "terrain/source.h"
#include "terrain/sources/dem/dem.h"
#include "terrain/sources/drawing/drawing.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

constexpr const char* kSmallRun = "$T run 'hybrid.noise*' --set pixels=32 --out out ";

TEST_F(CommandLine, HelpAndVersionExitGood) {
  const Outcome help = call("$T --help");
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.text, HasSubstr("Exit codes"));
  for (const char* command :
       {"list", "run", "check", "report", "cite", "compare", "represent", "render", "info"}) {
    EXPECT_EQ(call(std::string("$T ") + command + " --help").code, 0) << command;
  }
  for (const char* version : {"$T --version", "$T version"}) {
    EXPECT_THAT(call(version).text,
                MatchesRegex("terrabench [0-9.]+, git revision [0-9a-z]+.*\nInstruction set: [A-Z0-9_]+\n"
                             "GPU with OpenGL 4.5: .+\n"))
        << version;
  }
  EXPECT_THAT(call("$T help merge").text, HasSubstr("terrabench merge out shard1 shard2"));
}

TEST_F(CommandLine, ADryRunListsTheCasesAndWritesNothing) {
  const Outcome outcome = call("$T run mrbsp.walk 'real-257/f*' --dry-run --out out");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.text,
              MatchesRegex("mrbsp.walk 'real-257/fitted', timed\nmrbsp.walk 'real-257/facing', timed\n"
                           "2 cases; nothing was measured\nthis takes about [0-9.]+ s on two cores\n"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(CommandLine, WrongUseExits2AndSuggests) {
  EXPECT_EQ(call("$T").code, 2);
  EXPECT_EQ(call("$T run --profile huge").code, 2);
  const Outcome shard = call("$T run --shard 3/2");
  EXPECT_EQ(shard.code, 2);
  EXPECT_THAT(shard.text, HasSubstr("invalid shard '3/2': expected i/n, such as 2/8"));
  EXPECT_EQ(call("$T run --threads 0").code, 2);
  const Outcome experiment = call("$T run hybrid.tabel1");
  EXPECT_EQ(experiment.code, 2);
  EXPECT_THAT(experiment.text, HasSubstr("did you mean 'hybrid.table1'"));
  const Outcome method = call("$T represent jacksboro --as layered_stak");
  EXPECT_EQ(method.code, 2);
  EXPECT_THAT(method.text, HasSubstr("did you mean 'layered_stack'"));
  const Outcome terrain = call("$T represent jaksboro --as heightmap");
  EXPECT_EQ(terrain.code, 2);
  EXPECT_THAT(terrain.text, HasSubstr("did you mean 'jacksboro'"));
  EXPECT_EQ(call("$T list nonsense").code, 2);
  EXPECT_EQ(call("$T represent caves --as layered_stack --crop 0 0 5 5").code, 2);
}

TEST_F(CommandLine, APictureIsLandWhenItIsCalledADrawing) {
  write_picture(folder_ / "my.png", example_drawing(48, 1));
  const Outcome info = call("$T info drawing:my.png,peak=500");
  EXPECT_EQ(info.code, 0) << info.text;
  EXPECT_THAT(info.text, HasSubstr("black is -50 m"));
  EXPECT_THAT(call("$T info my.png").text, HasSubstr("drawing:"));
  EXPECT_THAT(call("$T list terrains").text, HasSubstr("drawing:FILE.png"));
  EXPECT_THAT(call("$T represent --help").text, HasSubstr("drawing:FILE.png"));
  const Outcome built = call("$T represent drawing:my.png --as heightmap --resample 24 24");
  EXPECT_EQ(built.code, 0) << built.text;
  EXPECT_THAT(built.text, HasSubstr("over 576 columns"));
  EXPECT_EQ(
      call("$T run overview.relief --terrain drawing:my.png --set width=32 --set height=32 --out out").code,
      0);
  EXPECT_EQ(call("$T run overview.relief --terrain drawing:no.png --out out").code, 3);
  EXPECT_EQ(call("$T info drawing:my.png,peek=500").code, 2);
}

TEST_F(CommandLine, BadInputExits3) {
  std::ofstream(folder_ / "text.tif") << "these are no heights";
  for (const char* command : {"$T info nowhere.tif", "$T info text.tif", "$T info drawing:text.tif",
                              "$T represent text.tif --as heightmap", "$T check nowhere", "$T report nowhere",
                              "$T compare nowhere nowhere"}) {
    const Outcome outcome = call(command);
    EXPECT_EQ(outcome.code, 3) << command << "\n" << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("terrabench: "));
  }
}

TEST_F(CommandLine, CompareExits1ForPicturesThatDiffer) {
  const auto draw = [&](const char* file, std::uint8_t grey) {
    write_picture(folder_ / file, Image(20, 20, {grey, grey, grey}));
  };
  draw("a/x.png", 100);
  EXPECT_EQ(call("$T compare a b").code, 3) << "no second folder";
  draw("b/y.png", 100);
  EXPECT_EQ(call("$T compare a b").code, 3) << "nothing in common";
  draw("b/x.png", 101);
  const Outcome close = call("$T compare a b");
  EXPECT_EQ(close.code, 0) << close.text;
  EXPECT_THAT(close.text, HasSubstr("48.13 dB"));
  EXPECT_EQ(call("$T compare a b --psnr 50").code, 1);
  EXPECT_EQ(call("$T compare a b --psnr 40 --ssim 1").code, 1);
  EXPECT_EQ(call("$T compare a b --json | python3 -m json.tool").code, 0);
  EXPECT_EQ(call("$T compare a b --ssim 1.1").code, 2);
  EXPECT_EQ(call("$T compare a b --psnr -1").code, 2);
  std::ofstream(folder_ / "b/x.png") << "no picture";
  EXPECT_EQ(call("$T compare a b").code, 1);
}

TEST_F(CommandLine, ReportSaysOnTheTerminalThatLinesWereAltered) {
  ASSERT_EQ(call("$T run overview.relief --set width=32 --set height=32 --out out").code, 0);
  ASSERT_EQ(call("sed -i 's/\"seed\":[0-9]*/\"seed\":77/' out/measurements.jsonl").code, 0);
  const Outcome outcome = call("$T report out");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("these results cannot be trusted"));
  EXPECT_THAT(outcome.text, HasSubstr("measurements.jsonl:2: altered"));
}

TEST_F(CommandLine, ListsEverythingAsTextAndJson) {
  const Outcome text = call("$T list");
  EXPECT_EQ(text.code, 0);
  for (const char* name :
       {"heightmap", "layered_stack", "voxel", "hybrid.table1", "hybrid.T1.128", "jacksboro"}) {
    EXPECT_THAT(text.text, HasSubstr(name));
  }
  EXPECT_EQ(call("$T list --json | python3 -m json.tool").code, 0);
  EXPECT_THAT(call("$T list experiments").text, HasSubstr("(a number between 0.01 and 1000 px)"));
}

// Who has a table of a paper before him finds what to run.
TEST_F(CommandLine, FromAClaimToItsExperiment) {
  const Outcome paper = call("$T list mrbsp");
  EXPECT_EQ(paper.code, 0);
  EXPECT_THAT(paper.text, HasSubstr("Table 2: triangles and time of LOD, visibility and both"));
  EXPECT_THAT(paper.text, ContainsRegex("mrbsp.T2.tris.lod .*\\(Table 2.*; run mrbsp.walk\\)\n"));
  EXPECT_THAT(paper.text, Not(HasSubstr("hybrid.")));
  EXPECT_EQ(call("$T list cross --json | python3 -m json.tool").code, 0);
  for (const char* claim : {"mrbsp.T2.time.fitted", "'mrbsp.T2.*'", "mrbsp.T2"}) {
    const Outcome run = call(std::string("$T run ") + claim);
    EXPECT_EQ(run.code, 2) << claim;
    EXPECT_THAT(run.text, HasSubstr("measured by: terrabench run mrbsp.walk")) << claim;
  }
}

TEST_F(CommandLine, RepresentSavesRendersAndInfoReadsBack) {
  const Outcome built =
      call("$T represent jacksboro --as layered_stack --crop 10 20 64 48 --save s.tb --render s.png");
  EXPECT_EQ(built.code, 0) << built.text;
  EXPECT_THAT(built.text, HasSubstr("RMSE"));
  EXPECT_EQ(read_picture(folder_ / "s.png").width, 1600);
  const Outcome info = call("$T info s.tb");
  EXPECT_EQ(info.code, 0) << info.text;
  EXPECT_THAT(info.text, HasSubstr("layered_stack"));
  EXPECT_EQ(temporary_files(), 0U);
}

TEST_F(CommandLine, ResumeSkipsWhatIsThere) {
  const Outcome first = call(std::string(kSmallRun) + "--shard 1/2");
  ASSERT_EQ(first.code, 0) << first.text;
  EXPECT_THAT(first.text, HasSubstr("F3"));
  const Outcome second = call(std::string(kSmallRun) + "--resume");
  ASSERT_EQ(second.code, 0) << second.text;
  EXPECT_THAT(second.text, HasSubstr("6 of 11 cases were already in the results folder"));
  EXPECT_THAT(second.text, Not(HasSubstr("noise-stages F3 ")));
}

TEST_F(CommandLine, TwoProfilesInOneFolderKeepTheirPictures) {
  const std::string run = "$T run hybrid.noise-stages --set pixels=16 --shard 1/4 --out out --profile ";
  ASSERT_EQ(call(run + "quick").code, 0);
  const auto pictures = [&] {
    const fs::directory_iterator all(folder_ / "out/figures");
    return std::distance(begin(all), end(all));
  };
  const auto quick = pictures();
  ASSERT_EQ(call(run + "paper").code, 0);
  EXPECT_EQ(pictures(), 2 * quick);
  EXPECT_THAT(call("$T check out").text,
              testing::AllOf(HasSubstr("Profile paper: "), HasSubstr("of profile quick are not read")));
  ASSERT_EQ(call("$T report out").code, 0);
  EXPECT_THAT(call("grep -rho 'figures/hybrid[^\"]*' out/report --include=*.html").text, HasSubstr(".paper"));
}

TEST_F(CommandLine, EveryPictureLeftBehindIsARecordsOwn) {
  // With a hole, and not as wide as deep.
  Heightfield ground = crop(*open_terrain("jacksboro").heights, 100, 100, 64, 90);
  for (int j = 40; j < 50; ++j) ground.at(30, j) = Heightfield::kNoData;
  write_geotiff(folder_ / "ground.tif", ground);
  const Outcome run = call("$T run drill.effects drill.size --terrain ground.tif --out out");
  ASSERT_EQ(run.code, 0) << run.text;
  const std::string records = read_file(folder_ / "out/measurements.jsonl");
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/figures")) {
    EXPECT_THAT(records, HasSubstr("figures/" + entry.path().filename().string()));
    EXPECT_GT(read_picture(entry.path()).width, 400) << entry.path();
    ++pictures;
  }
  // Figures 1 and 2, figures 3 and 4 for three fits, and rate and distortion.
  EXPECT_EQ(pictures, 9);
  EXPECT_EQ(temporary_files(), 0U);
}

TEST_F(CommandLine, TheSameSeedGivesTheSamePicturesOnAnyThreadCount) {
  ASSERT_EQ(call("$T run 'hybrid.noise*' --set pixels=64 --threads 1 --out one").code, 0);
  ASSERT_EQ(call("$T run 'hybrid.noise*' --set pixels=64 --out all").code, 0);
  for (const auto& entry : fs::directory_iterator(folder_ / "one/figures")) {
    EXPECT_EQ(read_file(entry.path()), read_file(folder_ / "all/figures" / entry.path().filename()))
        << entry.path();
  }
}

TEST_F(CommandLine, InterruptKeepsRecordsExits130AndResumes) {
  for (const std::string jobs : {"1", "2"}) {
    const std::string run = "$T run hybrid.noise-stages --set pixels=4000 --jobs " + jobs + " --out " + jobs;
    const pid_t child = start("exec " + run);
    const fs::path measurements = folder_ / jobs / "measurements.jsonl";
    const auto lines = [&] {
      std::ifstream in(measurements);
      return std::count(std::istreambuf_iterator<char>(in), {}, '\n');
    };
    for (int i = 0; i < 600 && lines() < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ASSERT_GE(lines(), 2);
    kill(child, SIGINT);
    const Outcome outcome = wait(child);
    EXPECT_EQ(outcome.code, 130) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("interrupted"));
    EXPECT_LT(lines(), 12) << "all was measured: the signal came too late";
    EXPECT_EQ(temporary_files(), 0U);
    // Goes on from there: what was measured first, one of the first two cases, is not measured again.
    const auto is_kept = [&](const std::string& shard) {
      return call(run + " --resume --shard " + shard).text.find("already in the results folder") !=
             std::string::npos;
    };
    EXPECT_TRUE(is_kept("1/11") || is_kept("2/11"));
  }
}

TEST_F(CommandLine, FullOrUnwritableOutputExits4AndLeavesNothingHalf) {
  std::ofstream(folder_ / "file") << "in the way";
  const Outcome blocked = call("$T run 'hybrid.noise*' --set pixels=16 --out file/out");
  EXPECT_EQ(blocked.code, 4) << blocked.text;
  // One block of 512 bytes a file: the first picture does not fit.
  const Outcome full = call("ulimit -f 1; $T represent jacksboro --as heightmap --save s.tb");
  EXPECT_EQ(full.code, 4) << full.text;
  EXPECT_FALSE(fs::exists(folder_ / "s.tb"));
  EXPECT_EQ(temporary_files(), 0U);
}

TEST_F(CommandLine, CheckPassesOnTrueMeasurementsAndFailsOnAlteredOnes) {
  const Outcome measured = call("$T run hybrid.table1 hybrid.caves --out out");
  ASSERT_EQ(measured.code, 0) << measured.text;
  const std::string rows = "$T check out --claims 'hybrid.T1.*' hybrid.caves";
  const Outcome good = call(rows);
  ASSERT_EQ(good.code, 0) << good.text;
  // One more digit in a figure: the structure would still be smaller than the paper's.
  const fs::path file = folder_ / "out/measurements.jsonl";
  const std::string lines = read_file(file);
  const std::size_t metric = lines.find("stack_bytes_per_column");
  ASSERT_NE(metric, std::string::npos);
  std::string altered = lines;
  altered.insert(altered.find('[', metric) + 1, "1");
  ASSERT_NE(altered, lines);
  write_file(file, altered);
  const Outcome caught = call(rows);
  EXPECT_EQ(caught.code, 1) << caught.text;
  EXPECT_THAT(caught.text, HasSubstr("altered"));
}

TEST_F(CommandLine, OutputThatCannotBeWrittenExits4) {
  EXPECT_EQ(call("$T list > /dev/full").code, 4);
  EXPECT_EQ(call("$T represent jacksboro --as heightmap --render /dev/null").code, 4);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(call("$T info " + std::string(300, 'x')).code, 3);
}

// The reader of the pipe is gone before anything is written.
TEST_F(CommandLine, AClosedPipeEndsQuietly) {
  const auto closed = [&](const std::string& command) {
    return call("rm -f p; mkfifo p; (exec 3<p) & exec 4>p; wait; " + command + "; echo code $?");
  };
  EXPECT_EQ(closed("$T list >&4").text, "code 141\n");
  EXPECT_EQ(closed("$T list nonsense 2>&4").text, "code 2\n");
  ASSERT_EQ(call("$T run hybrid.table1 --out out").code, 0);
  EXPECT_EQ(closed("$T check out --junit junit.xml >&4").text, "code 141\n");
  EXPECT_TRUE(fs::exists(folder_ / "junit.xml"));
  EXPECT_EQ(closed("$T report out >&4").text, "code 141\n");
  EXPECT_TRUE(fs::exists(folder_ / "out/report/index.html"));
  // Errors elsewhere keep their message.
  const Outcome other = closed("$T represent jacksboro --as heightmap --save p/s.tb >&4");
  EXPECT_THAT(other.text, HasSubstr("p/s.tb"));
  EXPECT_THAT(other.text, HasSubstr("code 4"));
}

TEST_F(CommandLine, CiteAndReportLatexServeAPaper) {
  const Outcome cite = call("$T cite");
  EXPECT_EQ(cite.code, 0);
  EXPECT_THAT(cite.text, HasSubstr("@misc{paper:drill,"));
  ASSERT_EQ(call("$T run hybrid.noise-stages --shard 1/4 --out out").code, 0);
  const Outcome latex = call("$T report out --latex bundle/");
  EXPECT_EQ(latex.code, 0) << latex.text;
  EXPECT_THAT(latex.text, HasSubstr("bundle/main.tex"));
  EXPECT_THAT(call("cat bundle/references.bib").text, HasSubstr(cite.text));
  EXPECT_FALSE(fs::exists(folder_ / "out/report")) << "only the bundle is written";
  EXPECT_THAT(latex.text, Not(HasSubstr("warning")));
  const auto pictures = [&] { return fs::is_directory(folder_ / "bundle/pictures"); };
  EXPECT_TRUE(pictures());
  fs::rename(folder_ / "out/figures", folder_ / "elsewhere");
  const Outcome without = call("$T report out --latex bundle");
  EXPECT_EQ(without.code, 0) << without.text;
  EXPECT_THAT(without.text,
              HasSubstr("are missing, altered or not readable, and left out; the first: out/figures/"));
  EXPECT_FALSE(pictures());
  fs::rename(folder_ / "elsewhere", folder_ / "out/figures");
  EXPECT_EQ(call("$T report out --latex out").code, 4) << "the measurements are no bundle";
  EXPECT_EQ(call("$T report out --latex bundle/main.tex").code, 4);
  EXPECT_TRUE(fs::exists(folder_ / "out/measurements.jsonl"));
}

}  // namespace
}  // namespace terrabench
