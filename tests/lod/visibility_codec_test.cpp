// Text and binary forms decode to what was encoded; anything else is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lod/mrbsp/mrbsp.h"
#include "lod/mrbsp/visibility/codec.h"
#include "tests/lod/visible_ground.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::mrbsp::visibility {
namespace {

using testing::HasSubstr;

std::vector<std::byte> bytes_of(const ChangeTable& table) {
  ByteSink sink;
  encode_binary(table, sink);
  return {sink.bytes().begin(), sink.bytes().end()};
}

// With a valid checksum, as an attacker would write it.
std::vector<std::byte> sealed(std::vector<std::byte> file) {
  file.resize(file.size() - 32);
  const std::string sum = checksum(file);
  for (const char c : sum) file.push_back(static_cast<std::byte>(c));
  return file;
}

TEST(VisibilityCodec, BothFormsComeBack) {
  for (const ChangeTable& table : {table_over(65, 50), table_over(9, 65), table_over(65, 3)}) {
    EXPECT_EQ(decode_text(encode_text(table), "memory"), table);
    EXPECT_EQ(decode_binary(bytes_of(table), "memory"), table);
    const TemporaryFolder folder;
    for (const char* const name : {"v.txt", "v.tbv"}) {
      save_file(folder / name, table);
      EXPECT_EQ(load_file(folder / name), table);
    }
  }
}

// The form of the paper's table 1, from sets written by hand.
TEST(VisibilityCodec, TextNamesStepsAndWhatTheyToggle) {
  Sets sets({8, 1, 2}, 2, 1.8F);
  sets.ground.fill('a');
  const auto see = [&](int first, int last, std::initializer_list<std::uint32_t> elements) {
    for (int cell = first; cell <= last; ++cell) {
      for (const std::uint32_t e : elements) sets.add(cell, e);
    }
  };
  see(0, 3, {0b00, 0b01});
  see(4, 7, {0b10, 0b11});
  see(0, 0, {0b11});
  see(7, 7, {0b00});
  EXPECT_EQ(encode_text(changes_of(sets)),
            "terrabench-visibility 3\ncells 8 1\nside 2\ndepth 2\neye-height 1.8\n"
            "surface aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa\nsets sampled\nstart 00, 01, 11\n"
            "a-b 11\n"
            "d-e 00, 01, 10, 11\n"
            "g-h 00\n");
}

TEST(VisibilityCodec, CellsAreNamedByColumnAndRow) {
  EXPECT_EQ(cell_name({8, 1, 2}, {0, 0}), "a");
  EXPECT_EQ(cell_name({8, 1, 2}, {7, 0}), "h");
  EXPECT_EQ(cell_name({30, 4, 2}, {25, 0}), "z1");
  EXPECT_EQ(cell_name({30, 4, 2}, {26, 3}), "aa4");
  EXPECT_EQ(cell_name({800, 1, 2}, {701, 0}), "zz");
  EXPECT_EQ(cell_name({800, 1, 2}, {702, 0}), "aaa");
}

TEST(VisibilityCodec, TextNamesTheLineAtFault) {
  const std::string surface = "surface 0123456789abcdef0123456789abcdef\n";
  const std::string front = "terrabench-visibility 3\ncells 2 2\nside 2\ndepth 2\neye-height 1.8\n";
  const std::string head = front + surface + "sets conservative\n";
  EXPECT_NO_THROW((void)decode_text(head + "start 01\na1-b1 11\na2-b2 11\n", "f"));
  for (const auto& [text, line] : std::vector<std::pair<std::string, std::string>>{
           {"", "line 0"},
           {"something else\n", "line 1"},
           {"terrabench-visibility 3\ncells 2\n", "line 2"},
           {"terrabench-visibility 3\ncells 2 2 2\n", "line 2"},
           {"terrabench-visibility 3\ncells 2 99999999999\n", "line 2"},
           {"terrabench-visibility 3\ncells 2 2\nside 3\ndepth 2\neye-height 1\n" + surface, "line 6"},
           {"terrabench-visibility 3\ncells 9999 9999\nside 2\ndepth 2\neye-height 1\n" + surface, "line 6"},
           {"terrabench-visibility 3\ncells 2 2\nside 2\ndepth 99\neye-height 1\n" + surface, "line 6"},
           {"terrabench-visibility 3\ncells 2 2\nside 2\ndepth 2\neye-height nan\n" + surface, "line 6"},
           {front + "start 01\n", "line 6"},
           {front + "surface 0123\n", "line 6"},
           {front + "surface 0123456789ABCDEF0123456789ABCDEF\n", "line 6"},
           {front + surface + "start 01\n", "line 7"},
           {front + surface + "sets some\n", "line 7"},
           {head + "start 1\n", "line 8"},
           {head + "start 11, 01\n", "line 8"},
           {head + "start 01, 01\n", "line 8"},
           {head + "start 01,10\n", "line 8"},
           {head + "start 01\na1-b1 11", "line 9"},
           {head + "start 01\na1-b1\n", "line 9"},
           {head + "start 01\na1-b1 \n", "line 9"},
           {head + "start 01\nb1-a1 11\n", "line 9"},
           {head + "start 01\na2-b2 11\na1-b1 11\n", "line 10"},
           {head + "start 01\na1-b1 11\na1-b1 11\n", "line 10"},
           {head + "start 01\na1-b1 11\n", "line 9"}}) {
    const Failure failure = failure_of([&] { (void)decode_text(text, "f"); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << text;
    EXPECT_THAT(failure.what, HasSubstr(line)) << text;
  }
}

TEST(VisibilityCodec, DamagedBinariesAreRefused) {
  const std::vector<std::byte> good = bytes_of(table_over(33, 33));
  for (std::size_t k = 0; k < good.size(); k += 7) {
    std::vector<std::byte> bad = good;
    bad[k] ^= std::byte{0x10};
    EXPECT_EQ(failure_of([&] { (void)decode_binary(bad, "f"); }).code, ExitCode::kBadInput);
    EXPECT_EQ(failure_of([&] { (void)decode_binary(std::span(good).first(k), "f"); }).code,
              ExitCode::kBadInput);
  }
}

TEST(VisibilityCodec, WhatCannotBeIsRefusedWhateverItsChecksum) {
  const std::vector<std::byte> good = bytes_of(table_over(33, 33));
  const auto refused = [&](std::size_t at, std::initializer_list<int> bytes) {
    std::vector<std::byte> bad = good;
    for (const int b : bytes) bad[at++] = static_cast<std::byte>(b);
    EXPECT_EQ(failure_of([&] { (void)decode_binary(sealed(bad), "f"); }).code, ExitCode::kBadInput);
  };
  EXPECT_NO_THROW((void)decode_binary(sealed(good), "f"));
  refused(8, {9});                              // version
  refused(12, {0xFF, 0xFF, 0xFF, 0x7F});        // columns
  refused(12, {0, 0, 16, 0});                   // columns: more steps than bytes
  refused(20, {3});                             // side
  refused(24, {31});                            // depth
  refused(28, {0, 0, 0xC0, 0x7F});              // eye height: NaN
  refused(32, {'g'});                           // not a digit of a checksum
  refused(64, {5});                             // kind of sets
  refused(65, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF});  // a count
  std::vector<std::byte> longer = good;
  longer.insert(longer.end() - 32, std::byte{0});
  EXPECT_EQ(failure_of([&] { (void)decode_binary(sealed(longer), "f"); }).code, ExitCode::kBadInput);
}

TEST(VisibilityCodec, KeepsWhatWasComputedAndRefusesWhatWasForSomethingElse) {
  const Heightfield field = rough_ground(65, 50);
  const TemporaryFolder folder;
  const auto build = [&](const Heightfield& ground, const std::string& file,
                         std::initializer_list<const char*> options) {
    Parameters parameters(Mrbsp::parameters());
    for (const char* const text : {"visibility=conservative", "cells=8", "coarseness=4"}) {
      parameters.set_from_text(text);
    }
    for (const char* const text : options) parameters.set_from_text(text);
    parameters.set("visibility_file", file);
    return Mrbsp::build(ground, parameters, silent());
  };
  const auto table = [](const std::unique_ptr<Lod>& lod) { return dynamic_cast<Mrbsp&>(*lod).visibility(); };
  for (const char* const name : {"v.txt", "v.tbv"}) {
    const std::string file = folder / name;
    const ChangeTable computed = table(build(field, "", {}));
    EXPECT_EQ(computed.mode, Mode::kConservative);
    EXPECT_EQ(table(build(field, file, {})), computed);
    EXPECT_EQ(load_file(file), computed);
    // The file is used as it is, even if it says that nothing is visible anywhere.
    ChangeTable blind = computed;
    blind.start.clear();
    blind.changes.clear();
    blind.first.assign(blind.first.size(), 0);
    save_file(file, blind);
    EXPECT_EQ(table(build(field, file, {})), blind);
    const auto refused = [&](const Heightfield& ground, std::initializer_list<const char*> options,
                             const char* what) {
      const Failure failure = failure_of([&] { (void)build(ground, file, options); });
      EXPECT_EQ(failure.code, ExitCode::kUsage) << what;
      EXPECT_THAT(failure.what, HasSubstr(what));
      EXPECT_EQ(load_file(file), blind) << what;
    };
    Heightfield other = field;
    other.at(20, 30) += 0.001F;
    refused(other, {}, "other ground");
    refused(field, {"depth=9"}, "another depth");
    refused(field, {"heights=nearest"}, "other ground");
    refused(field, {"visibility=sampled"}, "conservative sets, not sampled");
    refused(field, {"cells=4"}, "cells");
    refused(field, {"coarseness=6"}, "coarseness");
    refused(field, {"eye_height=2"}, "eye height");
    refused(field, {"visibility=off"}, "visibility=sampled");
    write_file(file, "something else");
    EXPECT_EQ(failure_of([&] { (void)build(field, file, {}); }).code, ExitCode::kBadInput);
  }
}

TEST(VisibilityCodec, BytesAreThoseOfTheSavedLists) {
  const ChangeTable table = table_over(65, 65);
  const EncodedSizes bytes = encoded_sizes(table);
  EXPECT_EQ(bytes.changes, bytes_of(table).size() - 65 - 32);
  EXPECT_EQ(bytes.bits, (8U * 8U * (1U << table.depth)) / 8);
  EXPECT_GT(bytes.lists, 0U);
}

}  // namespace
}  // namespace terrabench::mrbsp::visibility
