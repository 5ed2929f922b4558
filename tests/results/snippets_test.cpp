// The programs in docs/results.md read the results that are kept, where their interpreter is installed.
#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "results/store/statistics.h"
#include "tests/results/fake_results.h"

namespace terrabench {
namespace {

const std::filesystem::path kSource = TERRABENCH_SOURCE_DIR;

// The page's only block of the language.
std::string snippet(const std::string& language) {
  const std::string page = read_file(kSource / "docs/results.md"), fence = "```" + language + "\n";
  const std::size_t begin = page.find(fence);
  EXPECT_NE(begin, page.npos);
  EXPECT_EQ(page.find(fence, begin + 1), page.npos);
  const std::size_t first = begin + fence.size();
  return page.substr(first, page.find("```", first) - first);
}

// Cells of a CSV text whose cells hold no line breaks.
std::vector<std::vector<std::string>> cells(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      rows.back().emplace_back();
    } else if (c == '\n' && !quoted) {
      rows.push_back({""});
    } else if (c != '\r') {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

class Snippets : public FolderTest {
 protected:
  // Compares the table that the program prints with the store: as many rows, and every median.
  void expect_read(const std::string& interpreter, const std::string& language, double tolerance) {
    std::ofstream(folder_ / "program") << snippet(language);
    const std::filesystem::path results = kSource / "results/reference";
    const std::string command = interpreter + " " + (folder_ / "program").string() + " " +
                                (results / "measurements.jsonl").string() + " > " +
                                (folder_ / "out").string();
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto rows = cells(read_file(folder_ / "out"));
    ASSERT_FALSE(rows.empty());
    EXPECT_THAT(rows[0],
                testing::ElementsAre("experiment", "case", "profile", "metric", "unit", "n", "median"));
    const Store store = Store::open(results);
    std::size_t metrics = 0;
    for (const Record& record : store.records()) metrics += record.metrics.size();
    EXPECT_EQ(rows.size() - 1, metrics);
    for (std::size_t r = 1; r < rows.size(); ++r) {
      ASSERT_EQ(rows[r].size(), 7U) << r;
      const Record* const record = store.find(rows[r][0], rows[r][1], rows[r][2]);
      ASSERT_NE(record, nullptr) << r;
      const Metric* const metric = record->find(rows[r][3]);
      ASSERT_NE(metric, nullptr) << r;
      ASSERT_EQ(rows[r][4], metric->unit);
      ASSERT_EQ(rows[r][5], std::to_string(metric->samples.size()));
      const double expected = median(metric->samples);
      ASSERT_NEAR(std::strtod(rows[r][6].c_str(), nullptr), expected, tolerance * std::abs(expected)) << r;
    }
  }
};

bool runs(const char* command) {
  return std::system((std::string(command) + " > /dev/null 2>&1").c_str()) == 0;
}

TEST_F(Snippets, PythonReadsTheResults) {
  if (!runs("python3 -c 'import json, csv, statistics'")) GTEST_SKIP() << "python3 is not installed";
  expect_read("python3", "python", 1e-15);
}

// R prints 15 digits.
TEST_F(Snippets, RReadsTheResults) {
  if (!runs("Rscript --vanilla -e 'library(jsonlite)'")) {
    GTEST_SKIP() << "R with the package jsonlite is not installed (Debian: r-base-core, r-cran-jsonlite)";
  }
  expect_read("Rscript --vanilla", "r", 1e-13);
}

}  // namespace
}  // namespace terrabench
