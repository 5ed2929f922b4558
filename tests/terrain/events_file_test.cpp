// Event files: reading, writing, and the line of each refusal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrain/events/event_file.h"
#include "terrain/files.h"
#include "tests/terrain/errors.h"
#include "tests/terrain/temporary_folder.h"

namespace terrabench::events {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view kAll = R"(# every kind once
terrain = "jacksboro"
seed = 7
size = 65

[[event]]
kind = "linear-erosion"
from = [10, 20.5]
to = [30, 40]
depth = 3
[[event]]
kind = "radial-erosion"
centre = [1e2, -3, 0.1]
radii = [1, 2, 3]
[[event]]
kind = "normal-fault"
from = [1, 2]
to = [3, 4]
extent = 5
throw = 6
[[event]]
kind = "inverse-fault"
from = [1, 2]
to = [3, 4]
extent = 5
throw = 6
dip = 45
[[event]]
kind = "lateral-fault"
from = [1, 2]
to = [3, 4]
extent = 5
slip = 6
[[event]]
kind = "tunnel"
from = [1, 2, 3]
to = [4, 5, 6]
section = [[-1, 0], [1, 0], [0, 1]]
[[event]]
kind = "cave"
from = [1, 2, 3]
to = [4, 5, 6]
section = [[-1, 0], [1, 0], [0, 1]]
scale_from = 2
scale_to = 0.5
roughness = 0.01
seed = 9
)";

TEST(EventFile, EveryKindIsRead) {
  const Script script = parse_script(kAll, "all.toml");
  EXPECT_EQ(script.terrain, "jacksboro");
  EXPECT_EQ(script.seed, 7U);
  EXPECT_EQ(script.size, 65);
  ASSERT_EQ(script.events.size(), static_cast<std::size_t>(kKinds));
  for (int k = 0; k < kKinds; ++k) EXPECT_EQ(kind(script.events[k]), static_cast<Kind>(k));
  EXPECT_EQ(script.lines, (std::vector<int>{6, 11, 15, 21, 28, 34, 39}));
  const auto& trench = std::get<LinearErosion>(script.events[0]);
  EXPECT_EQ(trench.from, glm::dvec2(10, 20.5));
  EXPECT_EQ(trench.to, glm::dvec2(30, 40));
  EXPECT_EQ(trench.depth, 3);
  EXPECT_EQ(trench.slope, 30);
  EXPECT_EQ(std::get<RadialErosion>(script.events[1]).centre, glm::dvec3(100, -3, 0.1));
  EXPECT_EQ(std::get<RadialErosion>(script.events[1]).radii, glm::dvec3(1, 2, 3));
  EXPECT_EQ(std::get<DipFault>(script.events[2]).dip, 60);
  EXPECT_EQ(std::get<DipFault>(script.events[3]).dip, 45);
  EXPECT_EQ(std::get<DipFault>(script.events[3]).extent, 5);
  EXPECT_EQ(std::get<DipFault>(script.events[3]).rise, 6);
  EXPECT_EQ(std::get<LateralFault>(script.events[4]).slip, 6);
  EXPECT_EQ(std::get<Carving>(script.events[5]).section.size(), 3U);
  EXPECT_EQ(std::get<Carving>(script.events[5]).scale_from, 1);
  const auto& cave = std::get<Carving>(script.events[6]);
  EXPECT_EQ(cave.to, glm::dvec3(4, 5, 6));
  EXPECT_EQ(cave.scale_from, 2);
  EXPECT_EQ(cave.scale_to, 0.5);
  EXPECT_EQ(cave.roughness, 0.01);
  EXPECT_EQ(cave.seed, 9U);
}

TEST(EventFile, WhatIsWrittenIsReadBackToTheBit) {
  Script script = parse_script(kAll, "all.toml");
  std::get<LinearErosion>(script.events[0]).from = {1.0 / 3, 1e-300};
  std::get<RadialErosion>(script.events[1]).radii.y = 1e22;
  script.terrain = "odd \"name\"\\ \n\x7f ä.tif";
  const std::string text = to_text(script);
  const Script copy = parse_script(text, "copy");
  EXPECT_EQ(copy.terrain, script.terrain);
  EXPECT_EQ(copy.seed, script.seed);
  EXPECT_EQ(copy.size, script.size);
  EXPECT_EQ(to_text(copy), text);
  EXPECT_EQ(std::get<LinearErosion>(copy.events[0]).from, glm::dvec2(1.0 / 3, 1e-300));
  EXPECT_EQ(std::get<RadialErosion>(copy.events[1]).radii.y, 1e22);
  EXPECT_EQ(std::get<Carving>(copy.events[6]).section, std::get<Carving>(script.events[6]).section);
}

TEST(EventFile, MistakesAreNamedByLine) {
  const std::string head = "terrain = \"jacksboro\"\n";
  const std::string trench = "[[event]]\nkind = \"linear-erosion\"\nfrom = [1, 2]\nto = [3, 4]\n";
  const std::pair<std::string, const char*> cases[] = {
      {"", "f:1: 'terrain' is missing"},
      {"terrain = 3", "f:1: 'terrain' must be text"},
      {head + "terrain = \"x\"", "f:2: "},
      {head + "seed = -1", "f:2: 'seed' must be an integer from 0"},
      {head + "seed = 1.5", "f:2: 'seed'"},
      {head + "size = 1", "f:2: 'size' must be an integer from 2 to 8193"},
      {head + "size = 100000", "f:2: 'size'"},
      {head + "sede = 1", "f:2: unknown key 'sede'; did you mean 'seed'?"},
      {"terain = \"x\"", "f:1: 'terrain' is missing; is it meant by 'terain' in line 1?"},
      {head + trench + "depht = 3", "f:2: 'depth' is missing; is it meant by 'depht' in line 6?"},
      {head + "event = 1", "f:2: 'event' must be a list"},
      {head + "event = [1]", "f:2: 'event' must be a table"},
      {head + "[event]\nkind = \"cave\"", "f:2: 'event' must be a list"},
      {head + "[[event]]\nfrom = [1, 2]", "f:2: 'kind' is missing"},
      {head + "[[event]]\nkind = \"volcano\"", "f:3: invalid value 'volcano' for 'kind'"},
      {head + trench, "f:2: 'depth' is missing"},
      {head + trench + "depth = \"3\"", "f:6: expected a finite number in 'depth'"},
      {head + trench + "depth = 3\nwidth = 2", "f:7: unknown key 'width'"},
      {head + "[[event]]\nkind = \"linear-erosion\"\nfrom = [1, 2, 3]", "f:4: 'from' must be a list of 2"},
      {head + "[[event]]\nkind = \"linear-erosion\"\nfrom = 3", "f:4: 'from' must be a list of 2"},
      {head + "[[event]]\nkind = \"linear-erosion\"\nfrom = [1,\n true]",
       "f:5: expected a finite number in 'from'"},
      {head + "[[event]]\nkind = \"cave\"\nfrom = [1, 2, 3]\nto = [1, 2, 4]\nsection = [[1, 2], 3]",
       "f:6: 'section' must be a list of 2"},
      {head + "seed = ", "f:2: "},
      {std::string("\0\xff", 2), "f:1:2: "},
  };
  for (const auto& [text, what] : cases) {
    const Failure failure = failure_of([&] { (void)parse_script(text, "f"); });
    EXPECT_EQ(failure.code, ExitCode::kBadInput) << text;
    const std::string_view expected(what);
    const std::size_t colon = expected.find(": ");
    EXPECT_THAT(failure.what, AllOf(StartsWith(std::string(expected.substr(0, colon)) + ":"),
                                    HasSubstr(std::string(expected.substr(colon)))))
        << text;
    EXPECT_FALSE(failure.advice.empty()) << text;
  }
  EXPECT_THAT(failure_of([&] { (void)parse_script(head + "[[event]]\nkind = \"volcano\"", "f"); }).what,
              AllOf(HasSubstr("radial-erosion"), HasSubstr("tunnel")));
  EXPECT_THAT(failure_of([&] { (void)parse_script(std::string(kMostBytes + 1, ' '), "f"); }).what,
              HasSubstr("bytes"));
}

TEST(EventFile, AFileIsATerrain) {
  const TemporaryFolder folder;
  const std::string ground = "terrain = \"jacksboro\"\nsize = 65\n";
  write_file(folder / "ground.toml", ground);
  const TerrainSource plain = open_terrain(folder / "ground.toml");
  ASSERT_TRUE(plain.heights);
  EXPECT_FALSE(plain.solid);
  EXPECT_EQ(plain.events, nullptr);
  EXPECT_EQ(plain.heights->width, 65);
  EXPECT_EQ(plain.heights->depth, 65);
  EXPECT_EQ(plain.checksum, checksum(*plain.heights));

  const std::string bowl =
      ground + "[[event]]\nkind = \"radial-erosion\"\ncentre = [15e3, 300, 15e3]\nradii = [2e3, 200, 2e3]\n";
  write_file(folder / "bowl.toml", bowl);
  const TerrainSource eroded = open_terrain(folder / "bowl.toml");
  EXPECT_EQ(eroded.name, folder / "bowl.toml");
  EXPECT_FALSE(eroded.heights);
  ASSERT_TRUE(eroded.solid);
  ASSERT_NE(eroded.events, nullptr);
  EXPECT_EQ(eroded.events->ground.heights, plain.heights->heights);
  EXPECT_EQ(eroded.events->events.size(), 1U);
  EXPECT_EQ(eroded.checksum, eroded.solid->checksum);
  EXPECT_NE(eroded.checksum, plain.checksum);
  std::vector<Material> column(3);
  eroded.solid->column({15e3F, 15e3F, 99, 2}, column);
  EXPECT_THAT(column, testing::ElementsAre(Material::kBedrock, Material::kAir, Material::kAir));

  write_file(folder / "twice.toml", "terrain = \"" + (folder / "bowl.toml") + "\"\n");
  EXPECT_THAT(failure_of([&] { (void)open_terrain(folder / "twice.toml"); }).what,
              HasSubstr("itself a file of events"));
  write_file(folder / "caves.toml", std::string("terrain = \"caves\"\n"));
  EXPECT_THAT(failure_of([&] { (void)open_terrain(folder / "caves.toml"); }).what, HasSubstr("is a solid"));
  write_file(folder / "far.toml", bowl +
                                      "[[event]]\nkind = \"radial-erosion\"\ncentre = [-15e3, 300, 15e3]\n"
                                      "radii = [2e3, 200, 2e3]\n");
  const Failure far = failure_of([&] { (void)open_terrain(folder / "far.toml"); });
  EXPECT_EQ(far.code, ExitCode::kBadInput);
  EXPECT_THAT(far.what, AllOf(HasSubstr("far.toml:7: event 2 (radial-erosion): "), HasSubstr("outside")));
  EXPECT_THAT(failure_of([&] { (void)open_terrain(folder / "missing.toml"); }).what,
              HasSubstr("missing.toml"));
}

}  // namespace
}  // namespace terrabench::events
