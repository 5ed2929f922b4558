// EGL, GLFW and OSMesa beside each other in one process, and what is said when one is missing or lost.
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "renderers/context.h"
#include "renderers/contexts.h"
#include "renderers/frame_timer.h"
#include "renderers/gl.h"
#include "renderers/scene.h"
#include "renderers/target.h"
#include "renderers/window.h"
#include "terrain/metrics/image_error.h"
#include "tests/renderers/ground.h"
#include "tests/renderers/virtual_display.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

Image picture(GlContext& context) {
  const TriangleMesh mesh =
      testing::ground(39, 39, [](float x, float z) { return 3 * std::sin(0.4F * x) * std::cos(0.3F * z); });
  const Bounds box = bounds_of(mesh);
  const Scene scene{.meshes = {{.mesh = &mesh, .wire_width = 1}}, .lowest = box.low.y, .highest = box.high.y};
  return render_scene(context, scene, overview(box, 160, 120));
}

// On a GPU edges may differ by a shade; Mesa's software renderer is the same in all contexts.
void expect_same(const Image& a, const Image& b, bool same_renderer) {
  EXPECT_GE(ssim(a, b), 0.99);
  if (same_renderer) {
    EXPECT_EQ(a.rgb, b.rgb);
  }
}

TEST(ThreeContexts, InOneProcessDrawTheSamePicture) {
  ASSERT_TRUE(start_virtual_display());
  std::vector<std::unique_ptr<GlContext>> contexts;
  std::vector<std::string> renderers;
  for (const char* const name : {"egl", "osmesa", "glfw"}) {
    contexts.push_back(open_context(name, 8, 8));
    renderers.push_back(contexts.back()->renderer());
    EXPECT_THAT(renderers.back(), HasSubstr("OpenGL 4.")) << name;
  }
  const Image first = picture(*contexts[0]);
  // In any order, and again after the others have drawn.
  for (const std::size_t k : {1, 2, 1, 0, 2, 0}) {
    SCOPED_TRACE(renderers[k]);
    contexts[k]->make_current();
    EXPECT_EQ(contexts[k]->renderer(), renderers[k]);
    expect_same(first, picture(*contexts[k]), renderers[k] == renderers[0]);
  }
  // Closing one leaves the others usable, whichever was current.
  contexts.erase(contexts.begin());
  expect_same(first, picture(*contexts[0]), renderers[1] == renderers[0]);
  contexts.erase(contexts.begin());
  expect_same(first, picture(*contexts[0]), renderers[2] == renderers[0]);
}

TEST(ThreeContexts, OpenInEveryOrder) {
  ASSERT_TRUE(start_virtual_display());
  std::vector<const char*> names{"egl", "glfw", "osmesa"};
  do {
    std::vector<std::unique_ptr<GlContext>> contexts;
    for (const char* const name : names) contexts.push_back(open_context(name, 8, 8));
    for (const auto& context : contexts) {
      context->make_current();
      context->target().bind();
      glClearColor(0, 1, 0, 1);
      glClear(GL_COLOR_BUFFER_BIT);
      EXPECT_EQ(context->target().read().pixel(3, 3), (Rgb{0, 255, 0}));
    }
  } while (std::next_permutation(names.begin(), names.end(), [](const char* a, const char* b) {
    return std::string_view(a) < std::string_view(b);
  }));
}

TEST(ThreeContexts, AutoOpensAGpuOrOsmesa) {
  const auto context = open_context("auto", 16, 16);
  EXPECT_EQ(context->target().width(), 16);
  bool gpu = true;
  try {
    open_egl(4, 4, EglDevices::kGpus);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kEnvironment);
    EXPECT_THAT(error.what(), HasSubstr("no GPU"));
    gpu = false;
  }
  context->make_current();
  if (!gpu) {
    EXPECT_TRUE(context->software());
  }
  EXPECT_EQ(failure_of([] { open_context("auto", 0, 16); }).code, ExitCode::kUsage);
}

TEST(EglContext, SaysWhichPackageIsMissing) {
  const Failure absent = failure_of([] { open_egl(8, 8, EglDevices::kAll, "libNoSuchEGL.so.1"); });
  EXPECT_EQ(absent.code, ExitCode::kEnvironment);
  EXPECT_THAT(absent.what, HasSubstr("libNoSuchEGL.so.1"));
  EXPECT_THAT(absent.advice, HasSubstr("libegl1"));
  const Failure other = failure_of([] { open_egl(8, 8, EglDevices::kAll, "libm.so.6"); });
  EXPECT_THAT(other.what, HasSubstr("eglQueryString"));
}

TEST(EglContext, DestroyedFromOutsideSaysSo) {
  const auto context = open_egl(8, 8);
  // The context is destroyed behind the object's back, as by a driver that goes away.
  void* const egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(egl, nullptr);
  const auto function = [&](auto* type, const char* name) {
    return reinterpret_cast<decltype(type)>(dlsym(egl, name));
  };
  using Query = void*();
  void* const display = function(static_cast<Query*>(nullptr), "eglGetCurrentDisplay")();
  void* const handle = function(static_cast<Query*>(nullptr), "eglGetCurrentContext")();
  ASSERT_NE(handle, nullptr);
  GlContext::leave_current();
  using Destroy = unsigned(void*, void*);
  ASSERT_NE(function(static_cast<Destroy*>(nullptr), "eglDestroyContext")(display, handle), 0U);
  const Failure error = failure_of([&] { context->make_current(); });
  EXPECT_EQ(error.code, ExitCode::kEnvironment);
  EXPECT_THAT(error.what, HasSubstr("EGL"));
  EXPECT_THAT(error.advice, HasSubstr("open a new one"));
  EXPECT_NO_THROW(open_egl(8, 8)->target().read());
}

TEST(Window, ShowsThePicture) {
  ASSERT_TRUE(start_virtual_display());
  const auto context = open_window({64, 48}, "test");
  context->target().bind();
  glClearColor(0, 0, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 64, 24);  // the lower half
  glClearColor(1, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  // The display draws in its own time.
  for (int i = 0; i < 100 && pixel_on_display(5, 40) != Rgb{255, 0, 0}; ++i) {
    context->show(0, 64);
    context->swap();
    context->events();
    usleep(20'000);
  }
  EXPECT_EQ(pixel_on_display(5, 40), (Rgb{255, 0, 0}));
  EXPECT_EQ(pixel_on_display(60, 5), (Rgb{0, 0, 255}));
}

TEST(GlfwContext, SaysWhichPackageIsMissing) {
  const Failure absent = failure_of([] { open_glfw(8, 8, "libNoSuchGlfw.so.3"); });
  EXPECT_EQ(absent.code, ExitCode::kEnvironment);
  EXPECT_THAT(absent.advice, HasSubstr("libglfw3"));
}

// GLFW connects to the display once per process, so this runs another process.
TEST(GlfwContextDeathTest, WithoutADisplaySaysWhatToDo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  unsetenv("DISPLAY");
  EXPECT_EXIT(
      {
        const Failure error = failure_of([] { open_context("glfw", 8, 8); });
        std::cerr << error.what << " | " << error.advice << std::endl;
        std::_Exit(static_cast<int>(error.code));
      },
      ::testing::ExitedWithCode(4), "0x10008.*xvfb-run");
}

TEST(LostContext, IsReportedOnce) {
  const auto context = open_context("osmesa", 4, 4);
  const auto kept = glad_glGetGraphicsResetStatus;
  glad_glGetGraphicsResetStatus = [] { return static_cast<GLenum>(GL_GUILTY_CONTEXT_RESET); };
  const Failure error = failure_of([&] { context->target().read(); });
  glad_glGetGraphicsResetStatus = kept;
  EXPECT_EQ(error.code, ExitCode::kEnvironment);
  EXPECT_THAT(error.what, HasSubstr("context was lost"));
  EXPECT_NO_THROW(context->target().read());
}

TEST(ShaderIncludes, ErrorsNameTheFileAndLine) {
  const auto context = open_context("osmesa", 4, 4);
  const ShaderFile broken{"folder/broken.comp", R"(#version 450 core
layout(local_size_x = 1) in;
#include "grass_random.glsl"
void main() {
  nonsense = 1;
})"};
  const Failure error = failure_of([&] { link_compute(broken); });
  EXPECT_THAT(error.what, HasSubstr("folder/broken.comp:5: error: `nonsense'"));
  EXPECT_THAT(error.what, HasSubstr("folder/broken.comp:5"));
  // In the included file: main() is there twice.
  const ShaderFile twice{"folder/twice.comp", R"(#version 450 core
layout(local_size_x = 1) in;
int printed_random(vec2 at) { return 1; }
#include "grass_random.glsl"
void main() {})"};
  EXPECT_THAT(failure_of([&] { link_compute(twice); }).what,
              HasSubstr("renderers/shaders/grass_random.glsl:"));
}

TEST(FrameTimer, TimesTheFramesAfterTheWarmUp) {
  const auto context = open_context("osmesa", 32, 32);
  EXPECT_EQ(frame_clock(*context), FrameClock::kWall);
  for (const FrameClock clock : {FrameClock::kWall, FrameClock::kTimerQueries}) {
    std::vector<int> drawn;
    const std::vector<double> seconds = time_frames(clock, 3, 5, [&](int frame) {
      drawn.push_back(frame);
      context->target().bind();
      glClear(GL_COLOR_BUFFER_BIT);
    });
    EXPECT_THAT(drawn, ::testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7)) << static_cast<int>(clock);
    ASSERT_EQ(seconds.size(), 5U);
    for (const double each : seconds) EXPECT_GE(each, 0);
  }
  // The wall clock contains the whole frame.
  for (const double each : time_frames(FrameClock::kWall, 0, 2, [](int) { usleep(2000); })) {
    EXPECT_GE(each, 0.002);
  }
  EXPECT_THROW(time_frames(FrameClock::kWall, 0, 1, [](int) { glEnable(0xFFFF); }), Error);
}

}  // namespace
}  // namespace terrabench
