// Both file forms come back as written; nothing else is taken.
#include "lod/mrbsp/visibility_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lod/mrbsp/visibility_binary.h"
#include "lod/mrbsp/visibility_text.h"
#include "tests/lod/visible_ground.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench {
namespace {

using testing::HasSubstr;

std::vector<std::byte> bytes_of(const VisibilityTable& table) {
  ByteSink sink;
  save_visibility(table, sink);
  return {sink.bytes().begin(), sink.bytes().end()};
}

// With a checksum that fits, as an attacker would write it.
std::vector<std::byte> sealed(std::vector<std::byte> file) {
  file.resize(file.size() - 32);
  const std::string sum = checksum(file);
  for (const char c : sum) file.push_back(static_cast<std::byte>(c));
  return file;
}

TEST(VisibilityFile, BothFormsComeBack) {
  for (const VisibilityTable& table : {table_over(65, 50), table_over(9, 65), table_over(65, 3)}) {
    EXPECT_EQ(parse_visibility(visibility_text(table), "memory"), table);
    EXPECT_EQ(load_visibility(bytes_of(table), "memory"), table);
    const TemporaryFolder folder;
    for (const char* const name : {"v.txt", "v.tbv"}) {
      write_visibility(folder / name, table);
      EXPECT_EQ(read_visibility(folder / name), table);
    }
  }
}

// The form of the paper's table 1, from sets written by hand.
TEST(VisibilityFile, TextNamesStepsAndWhatTheyToggle) {
  VisibleSets sets({8, 1, 2}, 2, 1.8F);
  sets.surface.fill('a');
  const auto see = [&](int first, int last, std::initializer_list<std::uint32_t> elements) {
    for (int cell = first; cell <= last; ++cell) {
      for (const std::uint32_t e : elements) sets.add(cell, e);
    }
  };
  see(0, 3, {0b00, 0b01});
  see(4, 7, {0b10, 0b11});
  see(0, 0, {0b11});
  see(7, 7, {0b00});
  EXPECT_EQ(visibility_text(changes_of(sets)),
            "terrabench-visibility 1\ncells 8 1\nside 2\ndepth 2\neye-height 1.8\n"
            "surface aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\nstart 00, 01, 11\n"
            "a-b 11\n"
            "d-e 00, 01, 10, 11\n"
            "g-h 00\n");
}

TEST(VisibilityFile, CellsAreNamedByColumnAndRow) {
  EXPECT_EQ(cell_name({8, 1, 2}, 0, 0), "a");
  EXPECT_EQ(cell_name({8, 1, 2}, 7, 0), "h");
  EXPECT_EQ(cell_name({30, 4, 2}, 25, 0), "z1");
  EXPECT_EQ(cell_name({30, 4, 2}, 26, 3), "aa4");
  EXPECT_EQ(cell_name({800, 1, 2}, 701, 0), "zz");
  EXPECT_EQ(cell_name({800, 1, 2}, 702, 0), "aaa");
}

TEST(VisibilityFile, TextNamesTheLineAtFault) {
  const std::string surface = "surface 0123456789abcdef0123456789abcdef\n";
  const std::string front = "terrabench-visibility 1\ncells 2 2\nside 2\ndepth 2\neye-height 1.8\n";
  const std::string head = front + surface;
  EXPECT_NO_THROW((void)parse_visibility(head + "start 01\na1-b1 11\na2-b2 11\n", "f"));
  for (const auto& [text, line] : std::vector<std::pair<std::string, std::string>>{
           {"", "line 0"},
           {"something else\n", "line 1"},
           {"terrabench-visibility 1\ncells 2\n", "line 2"},
           {"terrabench-visibility 1\ncells 2 2 2\n", "line 2"},
           {"terrabench-visibility 1\ncells 2 99999999999\n", "line 2"},
           {"terrabench-visibility 1\ncells 2 2\nside 3\ndepth 2\neye-height 1\n" + surface, "line 6"},
           {"terrabench-visibility 1\ncells 9999 9999\nside 2\ndepth 2\neye-height 1\n" + surface, "line 6"},
           {"terrabench-visibility 1\ncells 2 2\nside 2\ndepth 99\neye-height 1\n" + surface, "line 6"},
           {"terrabench-visibility 1\ncells 2 2\nside 2\ndepth 2\neye-height nan\n" + surface, "line 6"},
           {front + "start 01\n", "line 6"},
           {front + "surface 0123\n", "line 6"},
           {front + "surface 0123456789ABCDEF0123456789ABCDEF\n", "line 6"},
           {head + "start 1\n", "line 7"},
           {head + "start 11, 01\n", "line 7"},
           {head + "start 01, 01\n", "line 7"},
           {head + "start 01,10\n", "line 7"},
           {head + "start 01\na1-b1 11", "line 8"},
           {head + "start 01\na1-b1\n", "line 8"},
           {head + "start 01\na1-b1 \n", "line 8"},
           {head + "start 01\nb1-a1 11\n", "line 8"},
           {head + "start 01\na2-b2 11\na1-b1 11\n", "line 9"},
           {head + "start 01\na1-b1 11\na1-b1 11\n", "line 9"},
           {head + "start 01\na1-b1 11\n", "line 8"}}) {
    const Failure failure = failure_of([&] { (void)parse_visibility(text, "f"); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << text;
    EXPECT_THAT(failure.what, HasSubstr(line)) << text;
  }
}

TEST(VisibilityFile, DamagedBinariesAreRefused) {
  const std::vector<std::byte> good = bytes_of(table_over(33, 33));
  for (std::size_t k = 0; k < good.size(); k += 7) {
    std::vector<std::byte> bad = good;
    bad[k] ^= std::byte{0x10};
    EXPECT_EQ(failure_of([&] { (void)load_visibility(bad, "f"); }).code, ExitCode::kBadInput);
    EXPECT_EQ(failure_of([&] { (void)load_visibility(std::span(good).first(k), "f"); }).code,
              ExitCode::kBadInput);
  }
}

TEST(VisibilityFile, WhatCannotBeIsRefusedWhateverItsChecksum) {
  const std::vector<std::byte> good = bytes_of(table_over(33, 33));
  const auto refused = [&](std::size_t at, std::initializer_list<int> bytes) {
    std::vector<std::byte> bad = good;
    for (const int b : bytes) bad[at++] = static_cast<std::byte>(b);
    EXPECT_EQ(failure_of([&] { (void)load_visibility(sealed(bad), "f"); }).code, ExitCode::kBadInput);
  };
  EXPECT_NO_THROW((void)load_visibility(sealed(good), "f"));
  refused(8, {9});                              // version
  refused(12, {0xFF, 0xFF, 0xFF, 0x7F});        // columns
  refused(12, {0, 0, 16, 0});                   // columns: more steps than bytes
  refused(20, {3});                             // side
  refused(24, {31});                            // depth
  refused(28, {0, 0, 0xC0, 0x7F});              // eye height: NaN
  refused(32, {'g'});                           // no digit of a checksum
  refused(64, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF});  // a count
  std::vector<std::byte> longer = good;
  longer.insert(longer.end() - 32, std::byte{0});
  EXPECT_EQ(failure_of([&] { (void)load_visibility(sealed(longer), "f"); }).code, ExitCode::kBadInput);
}

TEST(VisibilityFile, BytesAreThoseOfTheSavedLists) {
  const VisibilityTable table = table_over(65, 65);
  const VisibilityBytes bytes = visibility_bytes(table);
  EXPECT_EQ(bytes.changes, bytes_of(table).size() - 64 - 32);
  EXPECT_EQ(bytes.bits, (8U * 8U * (1U << table.depth)) / 8);
  EXPECT_GT(bytes.lists, 0U);
}

}  // namespace
}  // namespace terrabench
