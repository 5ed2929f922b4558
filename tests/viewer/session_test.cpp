// A session without a window: what it shows is what the experiments' calls draw.
#include "viewer/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "lod/meters/screen_error.h"
#include "terrain/error.h"
#include "terrain/framing.h"
#include "terrain/memory.h"
#include "tests/terrain/ground.h"
#include "viewer/actions.h"

namespace terrabench::viewer {
namespace {

using ::testing::HasSubstr;

Heightfield hills() {
  return test::ground_of(
      129, 97,
      [](int i, int j) {
        return 300 * std::sin(0.05 * i) * std::cos(0.07 * j) + 15 * std::sin(0.9 * i) * std::sin(1.1 * j);
      },
      30, 30);
}

class SessionTest : public ::testing::Test {
 protected:
  std::unique_ptr<GlContext> context = open_context("osmesa", 160, 120);
  Session session{*context, [](const std::string& name, bool, Progress& progress) {
                    if (name == "broken.tif") throw bad_input("damaged", name, "mend it");
                    progress.begin("opening", 1);
                    auto ground = std::make_shared<Ground>();
                    ground->name = name;
                    ground->render = "terrabench render hills";
                    ground->heights = hills();
                    ground->bounds = bounds_of(ground->heights);
                    return ground;
                  }};

  void finish() {
    while (session.working()) {
      session.finish_work();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void open() {
    session.open("hills");
    finish();
    session.camera.place({1900, 700, 2500}, 10, -15);
  }
  Image picture() { return session.picture({160, 120}); }

  // The same view, by the calls of `render` and the experiments.
  static Image apart(GlContext& context, const std::string& method, double knob, const View& view) {
    const Heightfield ground = hills();
    Progress progress;
    const LodType& type = lod(method);
    const auto made = type.build(ground, Parameters(type.parameters), progress);
    made->tune(knob);
    FrameRenderer renderer(context);
    const HeightRange range = height_range(ground);
    renderer.draw(made->update(view), view, {.lowest = range.lowest, .highest = range.highest});
    return renderer.image();
  }
};

TEST_F(SessionTest, ItsPictureIsTheOfflinePicture) {
  for (const Method& method : methods()) {
    if (method.name != method.type->name) continue;
    session.show_method(0, method.name);
    open();
    ASSERT_EQ(session.sides(), 1);
    // After frames from elsewhere, which methods that keep a mesh build on.
    for (int k = 0; k < 20; ++k) {
      session.camera.move({0.2, 0, 1}, 0.1);
      session.draw({160, 120}, 0.1 * k, [](int, int) {});
    }
    const View view = session.view({160, 120});
    EXPECT_EQ(picture().rgb, apart(*context, method.name, session.side(0).knob(), view).rgb) << method.name;
  }
}

TEST_F(SessionTest, TwoMethodsShareTheGroundAndThePicture) {
  open();
  const Image roam = picture();
  session.show_method(1, "geomipmap");
  finish();
  ASSERT_EQ(session.sides(), 2);
  EXPECT_EQ(session.side(0).ground(), session.side(1).ground());
  session.look.split = 0.25F;
  std::vector<std::array<int, 2>> shown;
  session.draw({160, 120}, 1, [&](int from, int to) { shown.push_back({from, to}); });
  EXPECT_THAT(shown, ::testing::ElementsAre(std::array{0, 40}, std::array{40, 160}));
  const Image both = picture();
  const Image other = apart(*context, "geomipmap", session.side(1).knob(), session.view({160, 120}));
  for (int x = 0; x < 160; ++x) EXPECT_EQ(both.pixel(x, 100), (x < 40 ? roam : other).pixel(x, 100)) << x;
  session.close_second();
  finish();
  EXPECT_EQ(picture().rgb, roam.rgb);
}

TEST_F(SessionTest, EqualErrorIsMeasuredAsTheExperimentsMeasureIt) {
  open();
  session.show_method(1, "geomipmap");
  finish();
  session.draw({160, 120}, 0, [](int, int) {});
  session.equalise(1.5);
  finish();
  EXPECT_THAT(session.message, HasSubstr("99 % within 1.5 px"));
  const Heightfield ground = hills();
  const View view = session.view({160, 120});
  for (int k = 0; k < 2; ++k) {
    Progress progress;
    const LodType& type = *session.side(k).method().type;
    const auto made = type.build(ground, Parameters(type.parameters), progress);
    made->tune(session.side(k).knob());
    const SurfaceRaster drawn(made->update(view), ground.width, ground.depth);
    EXPECT_LE(screen_error(drawn, ground, SeenSamples(ground, view)).visible.p99, 1.5) << type.name;
    EXPECT_GT(screen_error(drawn, ground, SeenSamples(ground, view)).visible.p99, 0.5) << type.name;
  }
}

TEST_F(SessionTest, AnEditIsSeenAndUndone) {
  open();
  session.show_method(1, "cdlod");
  finish();
  const Image before = picture();
  session.edit({{1900, session.ground().heights.sample(1900, 1800), 1800}, 300, true});
  EXPECT_THAT(session.message, HasSubstr("dug within"));
  EXPECT_NE(picture().rgb, before.rgb);
  session.undo();
  EXPECT_THAT(session.message, HasSubstr("undone"));
  EXPECT_EQ(picture().rgb, before.rgb);
  EXPECT_EQ(session.ground().heights.heights, hills().heights);
  session.edit({{1900, 5000, 1800}, 300, true});
  EXPECT_THAT(session.message, HasSubstr("nothing changed"));
}

TEST_F(SessionTest, FrozenTrianglesAreSeenFromOutside) {
  open();
  session.draw({160, 120}, 0, [](int, int) {});
  const std::size_t triangles = session.side(0).history().last().triangles;
  session.freeze(true);
  session.camera.place({1900, 3000, 2800}, 0, -60);
  session.draw({160, 120}, 1, [](int, int) {});
  EXPECT_EQ(session.side(0).history().last().triangles, triangles);
  const Image frozen = picture();
  session.freeze(false);
  EXPECT_NE(picture().rgb, frozen.rgb);
  EXPECT_EQ(picture().rgb, apart(*context, "roam", session.side(0).knob(), session.view({160, 120})).rgb);
}

TEST_F(SessionTest, ColoursByErrorComeFromTheMeters) {
  open();
  session.tune(0, 32);
  session.look.colours = Colours::kError;
  for (int k = 0; k < 1000 && session.side(0).error() == nullptr; ++k) {
    session.draw({160, 120}, k, [](int, int) {});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_NE(session.side(0).error(), nullptr);
  const Heightfield ground = hills();
  Progress progress;
  const auto made = lod("roam").build(ground, Parameters(lod("roam").parameters), progress);
  made->tune(32);
  const View view = session.view({160, 120});
  const SurfaceRaster drawn(made->update(view), ground.width, ground.depth);
  const ScreenDeviation error = screen_error(drawn, ground, SeenSamples(ground, view));
  EXPECT_EQ(session.side(0).error()->p99, error.visible.p99);
  EXPECT_EQ(session.side(0).error()->largest, error.visible.largest);
  EXPECT_GT(error.visible.largest, 0);
  const ErrorMap map = map_errors(drawn, ground, view, 1);
  std::size_t coloured = 0;
  for (int j = 0; j < ground.depth; ++j) {
    for (int i = 0; i < ground.width; ++i) coloured += map.colours.pixel(i, j) != kNotSeen ? 1 : 0;
  }
  EXPECT_EQ(coloured, error.visible.samples);
}

TEST_F(SessionTest, APathIsPlayedAsRenderDrawsIt) {
  open();
  const CameraPath& path = camera_path("fly");
  session.play(path);
  session.advance(2.0001);
  const std::vector<View> all = views(path, session.ground().heights);
  const View now = session.view({160, 120});
  const View& same = all[static_cast<std::size_t>(2 * path.frames_per_second)];
  EXPECT_EQ(now.eye, same.eye);
  EXPECT_EQ(now.target, same.target);
  session.advance(1e6);
  EXPECT_FALSE(session.playing());
}

TEST_F(SessionTest, WhatCannotBeOpenedLeavesWhatIsShown) {
  open();
  session.open("broken.tif");
  finish();
  EXPECT_EQ(session.ground().name, "hills");
  EXPECT_THAT(session.message, HasSubstr("damaged"));
  session.show_method(0, "clipmap");
  finish();
  EXPECT_EQ(session.side(0).method().name, "clipmap");
  EXPECT_THROW(session.show_method(0, "climpap"), Error);
}

TEST_F(SessionTest, TheFirstGroundMustOpen) {
  session.open("broken.tif");
  EXPECT_THROW(finish(), Error);
}

TEST_F(SessionTest, ACommandIsNamedOnlyForWhatItRepeats) {
  open();
  EXPECT_THAT(session.command({320, 200}), HasSubstr("terrabench render hills --lod roam --detail"));
  EXPECT_THAT(session.command({320, 200}), HasSubstr("--size 320x200"));
  session.look.wires = true;
  EXPECT_EQ(session.command({320, 200}), "");
  session.look.wires = false;
  session.edit({{1900, session.ground().heights.sample(1900, 1800), 1800}, 300, true});
  EXPECT_EQ(session.command({320, 200}), "");
}

// A renderer that takes over a method's frames midway shows the same as one that was there from the start.
TEST_F(SessionTest, ALandscapeShowsEdits) {
  open();
  session.look.landscape = true;
  const auto draw = [&] { session.draw({160, 120}, 0, [](int, int) {}); };
  draw();
  const Image before = picture();
  session.edit({{1900, session.ground().heights.sample(1900, 1800), 1800}, 300, true});
  draw();
  const Image dug = picture();
  EXPECT_NE(dug.rgb, before.rgb);
  session.look.landscape = false;
  draw();
  session.look.landscape = true;
  EXPECT_EQ(picture().rgb, dug.rgb);
}

TEST_F(SessionTest, HistoryHoldsTenSeconds) {
  open();
  for (int k = 0; k < 200; ++k) session.draw({160, 120}, 0.125 * k, [](int, int) {});
  const auto at = session.side(0).history().values([](const FrameSample& s) { return s.at; });
  EXPECT_EQ(at.size(), 81U);
  EXPECT_NEAR(at.back() - at.front(), 10, 1e-4);
}

TEST_F(SessionTest, TheHeapIsSteady) {
  open();
  double seconds = 0;
  const auto round = [&] {
    for (const char* const method : {"roam", "cdlod", "clipmap"}) {
      session.show_method(0, method);
      finish();
      session.look.colours = Colours::kError;
      session.camera.place({1900, 700, 2500}, 10, -15);
      for (int k = 0; k < 150; ++k) {
        session.camera.move({0.1, 0, 1}, 0.02);
        session.draw({160, 120}, seconds += 0.125, [](int, int) {});
      }
      session.edit({{1900, session.ground().heights.sample(1900, 1800), 1800}, 300, true});
      session.undo();
      session.equalise(2);
      finish();
    }
    session.look.colours = Colours::kHeight;
    session.close_second();
    finish();
  };
  round();
  const HeapScope heap;
  for (int k = 0; k < 3; ++k) round();
  EXPECT_LT(heap.held(), 1 << 20);
}

TEST_F(SessionTest, EveryActionIsSafeAtAnyTime) {
  Controls controls;
  controls.window = {160, 120};
  controls.mouse = {80, 100};
  for (const Binding& binding : bindings()) {
    if (binding.action == Action::kPicture || binding.action == Action::kRecord) continue;  // write files
    perform(binding.action, session, controls);  // before there is ground
  }
  open();
  for (int round = 0; round < 2; ++round) {
    for (const Binding& binding : bindings()) {
      if (binding.action == Action::kPicture || binding.action == Action::kRecord) continue;
      perform(binding.action, session, controls);
      session.draw({160, 120}, round, [](int, int) {});
      finish();
    }
  }
  EXPECT_TRUE(controls.quit);
}

}  // namespace
}  // namespace terrabench::viewer
