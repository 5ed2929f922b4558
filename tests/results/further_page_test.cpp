// The report's pages of grounds that no claims file names, such as DEMs of the user's.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "results/report/ground_name.h"
#include "results/report/latex_bundle.h"
#include "results/report/report.h"
#include "results/report/report_tables.h"
#include "terrain/image.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

using testing::HasSubstr;
using testing::Not;

class FurtherPageTest : public FolderTest {
 protected:
  FurtherPageTest() : store_(folder_) { store_.begin_run(run_); }

  // Some of what cross.representations, cross.file-size and cross.error-maps measure there.
  void measure(const std::string& ground) {
    for (const char* const type : {"heightmap", "drill"}) {
      Record record = fake_record(run_, "cross.representations", fmt::format("{}/{}", ground, type));
      record.terrain = ground;
      add(record, "file_bytes", "B", {1000});
      add(record, "rmse", "m", {3});
      store_.append(record);
      Record files = fake_record(run_, "cross.file-size", fmt::format("{}/{}", ground, type));
      files.terrain = ground;
      add(files, "rmse_at_5%", "m", {3});
      add(files, "bytes_within_1%", "B", {type == std::string("drill") ? 2000.0 : 1000.0});
      add(files, "best_bytes", "B", {1000, 2000});
      add(files, "best_error", "m", {3, 2});
      store_.append(files);
    }
    Record maps = fake_record(run_, "cross.error-maps", ground);
    maps.terrain = ground;
    add(maps, "drill_rmse", "m", {3});
    const std::string id = "cross.error-maps." + ground_id(ground), file = "figures/" + id + ".webp";
    write_picture(folder_ / file, Image(40, 20, {200, 40, 40}));
    maps.figures.push_back({id, file, "Maps of <" + ground + ">.", checksum(read_file(folder_ / file))});
    store_.append(maps);
  }
  void write() { write_report(store_, papers()); }
  std::string written(const std::string& name) const { return read_file(folder_ / "report" / name); }
  std::string page(const std::string& ground, const PageForm& form = kHtmlForm) const {
    return written(fmt::format("{}.{}", ground_page(ground_id(ground)), form.extension));
  }
  std::set<std::string> pages() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "report")) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("ground-")) names.insert(name);
    }
    return names;
  }

  Provenance run_ = fake_provenance();
  Store store_;
};

TEST_F(FurtherPageTest, HasTheTablesPlotsAndPicturesOfItsGround) {
  measure("/x/alps.tif");
  write();
  for (const PageForm& form : {kHtmlForm, kMarkdownForm}) {
    const std::string text = page("/x/alps.tif", form), id = ground_id("/x/alps.tif");
    for (const std::string& part :
         {std::string("Ground alps.tif"), "id=\"cross.representations-" + id + "\"",
          "id=\"cross.file-size-" + id + "\"", "figures/cross.file-size-" + id + "-plot.",
          "../figures/cross.error-maps." + id + ".webp", std::string("cross.error-maps alps.tif")}) {
      EXPECT_THAT(text, HasSubstr(part)) << form.extension;
    }
    EXPECT_THAT(text, Not(HasSubstr("cross.lod-"))) << "nothing of it was measured";
    EXPECT_THAT(text, Not(HasSubstr("{further")));
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "report/tables" /
                                      fmt::format("cross.representations-{}.csv", ground_id("/x/alps.tif"))));
}

// The captions of pictures are recorded with the path that was given.
TEST_F(FurtherPageTest, HasNoPathsInItsCaptions) {
  measure("/x/alps.tif");
  measure("/y/alps.tif");
  write();
  for (const PageForm& form : {kHtmlForm, kMarkdownForm}) {
    const std::string text = page("/y/alps.tif", form);
    EXPECT_THAT(text, HasSubstr("Maps of &lt;y/alps.tif&gt;.")) << form.extension;
    EXPECT_THAT(text, Not(HasSubstr("/y/alps.tif"))) << form.extension;
  }
}

// Nor has the page of cases that nothing else shows.
TEST_F(FurtherPageTest, LeavesOtherCasesToAPageByTheirLabels) {
  measure("/x/alps.tif");
  Record curve = fake_record(run_, "drill.size", "/x/alps.tif/printed");
  curve.terrain = "/x/alps.tif";
  add(curve, "bits", "", {1000});
  write_picture(folder_ / "figures/curve.webp", Image(40, 20, {200, 40, 40}));
  curve.figures.push_back({"curve", "figures/curve.webp", "Bits for /x/alps.tif",
                           checksum(read_file(folder_ / "figures/curve.webp"))});
  store_.append(curve);
  write();
  const std::string text = written("other.md");
  EXPECT_THAT(text, HasSubstr("| alps.tif/printed |"));
  EXPECT_THAT(text, HasSubstr("**drill.size alps.tif/printed.** Bits for alps.tif"));
}

TEST_F(FurtherPageTest, IsListedOnTheMainPageWhichDoesNotRepeatIt) {
  measure("/x/alps.tif");
  Record claimed = fake_record(run_, "hybrid.table1", "n=128");
  add(claimed, "paper_stack_bytes", "B", {1000});
  store_.append(claimed);
  write();
  const std::string main_page = written("index.html"), id = ground_id("/x/alps.tif");
  EXPECT_THAT(main_page, HasSubstr(fmt::format("href=\"{}.html\"", ground_page(id))));
  EXPECT_THAT(written("report.md"), HasSubstr(fmt::format("({}.md)", ground_page(id))));
  EXPECT_THAT(main_page, HasSubstr("<h2 id=\"grounds\">Further grounds</h2>"));
  EXPECT_THAT(written("ledger.html"), HasSubstr(fmt::format("href=\"{}.html\"", ground_page(id))));
  EXPECT_THAT(main_page, Not(HasSubstr("Unclaimed cases")));
  EXPECT_THAT(main_page, Not(HasSubstr("cross.error-maps." + id)));
}

TEST_F(FurtherPageTest, EscapesTheNamesOfFiles) {
  const std::string ground = "/x/a b/<i>\"Großer\" & 'co' $1 [x](y) {page} %s.tif";
  measure(ground);
  write();
  EXPECT_EQ(pages().size(), 2U);
  const std::string text = page(ground), words = page(ground, kMarkdownForm);
  EXPECT_THAT(
      text, HasSubstr("Ground &lt;i&gt;&quot;Großer&quot; &amp; &#39;co&#39; $1 [x](y) {page} %s.tif</h1>"));
  EXPECT_THAT(text, Not(HasSubstr("<i>")));
  EXPECT_THAT(words, HasSubstr("Ground &lt;i&gt;\"Großer\" &amp; 'co' \\$1 \\[x\\](y) {page} %s.tif"));
  EXPECT_THAT(written("index.html"), Not(HasSubstr("<i>")));
}

TEST_F(FurtherPageTest, IsNotWrittenIfNothingOnItWasMeasured) {
  Record record = fake_record(run_, "cross.representations", "/x/alps.tif/heightmap (rays=7)");
  record.terrain = "/x/alps.tif";
  record.overrides = {"rays=7"};
  add(record, "rmse", "m", {3});
  store_.append(record);
  measure("jacksboro");
  write();
  EXPECT_EQ(pages(), (std::set<std::string>{"ground-jacksboro.html", "ground-jacksboro.md"}));
  EXPECT_THAT(written("ground-jacksboro.html"), HasSubstr("Which method for jacksboro"));
  EXPECT_THAT(written("index.html"), Not(HasSubstr("Further grounds")));
}

TEST_F(FurtherPageTest, WarnsInTheLatexBundleToo) {
  measure("/x/alps.tif");
  Record record = fake_record(run_, "cross.representations", "/x/alps.tif/voxel/5%");
  record.terrain = "/x/alps.tif";
  record.terrain_checksum = "another";
  add(record, "columns", "", {750});
  add(record, "lost_columns", "", {250});
  add(record, "rmse", "m", {3});
  store_.append(record);
  Record named = fake_record(run_, "cross.representations", "caves/ght/volume=0.5%");
  add(named, "columns", "", {900});
  add(named, "lost_columns", "", {100});
  add(named, "rmse", "m", {3});
  store_.append(named);
  write_latex_bundle(store_, papers(), folder_ / "bundle");
  const std::string text = read_file(folder_ / "bundle/main.tex");
  EXPECT_THAT(text, HasSubstr("\\textbf{Warning:} Ground caves. RMSE"));
  for (const char* const part :
       {"\\textbf{Warning:} The content of this ground changed",
        "\\textbf{Warning:} RMSE and other errors of height leave out columns where only one of ground and "
        "method has a height",
        "up to 25.0 \\% of the columns (case alps.tif/voxel/5\\%)"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST_F(FurtherPageTest, HasASectionInTheLatexBundle) {
  measure("/x/a_b.tif");
  measure("/y/a_b.tif");
  EXPECT_THAT(write_latex_bundle(store_, papers(), folder_ / "bundle").left_out, testing::IsEmpty());
  const std::string text = read_file(folder_ / "bundle/main.tex"), id = ground_id("/x/a_b.tif");
  for (const std::string& part :
       {std::string("\\section{Ground x/a\\_b.tif}"), "\\label{sec:ground-" + id + "}",
        "\\input{tables/cross.representations-" + id + ".tex}", "\\input{tables/which-method-" + id + ".tex}",
        "{figures/cross.file-size-" + id + "-plot.pdf}", "{pictures/cross.error-maps." + id + ".png}"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(text, HasSubstr("\\section{Ground y/a\\_b.tif}"));
  EXPECT_THAT(text, Not(HasSubstr("/x/a"))) << "a path";
  EXPECT_THAT(text, Not(HasSubstr("sec:hybrid"))) << "nothing of it was measured";
}

// After a run on a ground of the user's alone, no claim is measured.
TEST_F(FurtherPageTest, OpensWithTheGroundIfNoClaimWasMeasured) {
  measure("/x/alps.tif");
  write();
  const std::string text = written("index.html");
  EXPECT_THAT(text, HasSubstr("<h1 id=\"top\">Which method for alps.tif</h1>"));
  EXPECT_THAT(text, Not(HasSubstr("class=\"warning\"")));
  EXPECT_THAT(text, HasSubstr("<td>heightmap</td><td>drills</td><td>2\u00a0×</td>"));
  EXPECT_THAT(text, Not(HasSubstr("nothing of them was measured")));
  EXPECT_THAT(text, HasSubstr("../figures/cross.error-maps." + ground_id("/x/alps.tif") + ".webp"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "report/wrong-or-vague.html"));
}

}  // namespace
}  // namespace terrabench
