// Models of mesh growing as terrain, by the command line.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "representations/procedural_mesh/mesh_files.h"
#include "tests/experiments/command_line.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

class ProceduralCommands : public CommandLine {};

TEST_F(ProceduralCommands, ModelsAreTerrainsThatAreSavedAndExported) {
  EXPECT_THAT(call("$T list models").text, HasSubstr("fractal_plane"));
  std::ofstream(folder_ / "box.toml") << "[base]\nshape = \"cube\"\nsize = [4, 2, 4]\n";
  const Outcome ply = call("$T represent box.toml --as procedural_mesh --save box.ply --render box.png");
  EXPECT_EQ(ply.code, 0) << ply.text;
  EXPECT_THAT(ply.text, HasSubstr("from a description of"));
  EXPECT_THAT(ply.text, HasSubstr("1.000000 volume IoU"));
  EXPECT_EQ(read_mesh(folder_ / "box.ply").faces(), 6U);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "box.png"));
  EXPECT_EQ(call("$T represent box.toml --as procedural_mesh --save box.tb").code, 0);
  EXPECT_LT(std::filesystem::file_size(folder_ / "box.tb"), 300U);
  EXPECT_THAT(call("$T info box.toml").text, HasSubstr("12 triangles"));
  EXPECT_THAT(call("$T info box.tb").text, HasSubstr("procedural_mesh"));
  const Outcome stack = call("$T represent box.toml --as layered_stack --save stack.obj");
  EXPECT_THAT(stack.text, HasSubstr("volume IoU")) << stack.text;
  EXPECT_GE(read_mesh(folder_ / "stack.obj").faces(), 12U);
  const Outcome stands =
      call("$T represent box.toml --ground hills --crop 0 0 9 9 --place 120,120,20 --as procedural_mesh");
  EXPECT_EQ(stands.code, 0) << stands.text;
  EXPECT_THAT(stands.text, HasSubstr("box.toml on hills"));
}

TEST_F(ProceduralCommands, WhatIsNoModelOrNoPlaceIsRefused) {
  std::ofstream(folder_ / "bad.toml") << "[base]\nshape = \"ball\"\n";
  const Outcome bad = call("$T represent bad.toml --as procedural_mesh");
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.text, HasSubstr("bad.toml:2:9"));
  const Outcome misspelt = call("$T represent chiar --as procedural_mesh");
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_THAT(misspelt.text, HasSubstr("did you mean 'chair'"));
  for (const char* const wrong :
       {"hills --ground hills", "chair --place 1,2", "chair --ground hills --place 1,2,",
        "chair --crop 0 0 5 5", "chair --ground hills --place 1,2,0", "chair --ground caves",
        "chair --ground hills --place 9e9,0"}) {
    EXPECT_EQ(call(std::string("$T represent --as heightmap ") + wrong).code, 2) << wrong;
  }
}

}  // namespace
}  // namespace terrabench
