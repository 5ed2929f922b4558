// CONTRIBUTING.md's steps name files that exist, and nothing outside them lists methods or asks for a
// method's type, so that the steps are complete. A method that takes them from another program:
// tests/examples.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "lod/lod.h"
#include "representations/representation.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;
const fs::path kRoot = TERRABENCH_SOURCE_DIR;

// The text between this heading and the next.
std::string section(const std::string& heading) {
  const std::string all = read_file(kRoot / "CONTRIBUTING.md");
  const std::size_t begin = all.find("## " + heading + "\n");
  EXPECT_NE(begin, all.npos) << heading;
  return all.substr(begin, all.find("\n## ", begin) - begin);
}

// The files in backquotes, with NAME replaced and `a.{h,cpp}` taken apart.
std::set<std::string> files_in(std::string text, const std::string& name) {
  text = std::regex_replace(text, std::regex("NAME"), name);
  std::set<std::string> files;
  const std::regex quoted("`([a-z_/]+/[a-z_]+)\\.(?:([a-z]+)|\\{([a-z]+),([a-z]+)\\})`");
  for (std::sregex_iterator at(text.begin(), text.end(), quoted), end; at != end; ++at) {
    for (int ending = 2; ending <= 4; ++ending) {
      if ((*at)[ending].matched) files.insert((*at)[1].str() + "." + (*at)[ending].str());
    }
  }
  return files;
}

TEST(Contributing, TheStepsForALevelOfDetailAreThoseOfEveryMethod) {
  const std::string text = section("Add a level of detail");
  const std::string steps = text.substr(0, text.find("\n\n"));
  for (const LodType& type : lods()) {
    const std::string name(type.name);
    const std::set<std::string> files = files_in(steps, name);
    EXPECT_EQ(files.size(), 4U) << "as many files are touched";
    EXPECT_TRUE(files.contains("lod/registry.cpp"));
    for (const std::string& file : files) EXPECT_TRUE(fs::exists(kRoot / file)) << file;
  }
}

TEST(Contributing, TheStepsForARepresentationNameFilesThatExist) {
  const std::set<std::string> files = files_in(section("Add a representation"), "procedural_mesh");
  EXPECT_GE(files.size(), 4U);
  for (const std::string& file : files) EXPECT_TRUE(fs::exists(kRoot / file)) << file;
}

// All sources but those of methods and tests, with or without those of single papers.
std::vector<fs::path> shared_sources(bool with_papers) {
  const std::set<std::string> of_papers{"hybrid", "ght", "drill", "mrbsp", "meshgrow"};
  std::vector<fs::path> files;
  const auto add = [&](const fs::path& file) {
    if ((file.extension() == ".cpp" || file.extension() == ".h") && file.stem() != "registry")
      files.push_back(file);
  };
  for (const char* const folder : {"experiments", "renderers", "results", "terrain"}) {
    for (auto at = fs::recursive_directory_iterator(kRoot / folder); at != fs::end(at); ++at) {
      const bool skipped = !with_papers && at.depth() == 0 && of_papers.contains(at->path().filename()) &&
                           folder == std::string_view("experiments");
      if (skipped) at.disable_recursion_pending();
      if (at->is_regular_file()) add(at->path());
    }
  }
  for (const char* const folder : {"representations", "lod"}) {
    for (const auto& entry : fs::directory_iterator(kRoot / folder)) add(entry.path());
  }
  return files;
}

TEST(Contributing, WhatAMethodCanDoIsAskedOfItsInterface) {
  for (const fs::path& file : shared_sources(true))
    EXPECT_EQ(read_file(file).find("dynamic_cast"), std::string::npos) << file;
}

TEST(Contributing, NoListOfMethodsStandsOutsideTheRegistries) {
  const std::set<std::string_view> papers{"hybrid", "ght", "drill", "mrbsp"};  // also names of papers
  const std::vector<fs::path> files = shared_sources(false);
  EXPECT_GT(files.size(), 200U);
  for (const fs::path& file : files) {
    const std::string text = read_file(file);
    std::set<std::string_view> representations_named, lods_named;
    const auto names = [&](std::string_view name) {
      return !papers.contains(name) && text.find('"' + std::string(name) + '"') != text.npos;
    };
    for (const RepresentationType& type : representations()) {
      if (names(type.name)) representations_named.insert(type.name);
    }
    for (const LodType& type : lods()) {
      if (names(type.name)) lods_named.insert(type.name);
    }
    EXPECT_LE(representations_named.size(), 1U) << file << testing::PrintToString(representations_named);
    EXPECT_LE(lods_named.size(), 1U) << file << testing::PrintToString(lods_named);
  }
}

}  // namespace
}  // namespace terrabench
