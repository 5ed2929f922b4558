#include "renderers/context.h"

#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <iostream>
#include <string>

#include "renderers/contexts.h"
#include "renderers/gl.h"
#include "renderers/target.h"
#include "tests/terrain/errors.h"

namespace terrabench {
namespace {

using ::testing::HasSubstr;

constexpr ShaderFile kVertex{"test.vert", R"(#version 450 core
layout(location = 0) in vec3 position;
void main() { gl_Position = vec4(position, 1.0); })"};
constexpr ShaderFile kFragment{"test.frag", R"(#version 450 core
uniform vec3 paint;
out vec4 color;
void main() { color = vec4(paint, 1.0); })"};

void clear(float red, float green, float blue) {
  glClearColor(red, green, blue, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

// Corners in clip space.
void draw_triangle(const Program& program, const std::array<glm::vec3, 3>& corners, const glm::vec3& paint) {
  const VertexArray array;
  const Buffer buffer = make_buffer(std::span<const glm::vec3>(corners));
  glVertexArrayVertexBuffer(array.id(), 0, buffer.id(), 0, sizeof(glm::vec3));
  glVertexArrayAttribFormat(array.id(), 0, 3, GL_FLOAT, GL_FALSE, 0);
  glEnableVertexArrayAttrib(array.id(), 0);
  glProgramUniform3f(program.id(), uniform(program, "paint"), paint.x, paint.y, paint.z);
  glUseProgram(program.id());
  glBindVertexArray(array.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  check_gl("triangle");
}

TEST(Context, OpensAndSaysWhatDraws) {
  const auto context = open_context("osmesa", 64, 32);
  EXPECT_THAT(context->renderer(), HasSubstr("OpenGL 4."));
  EXPECT_GT(context->renderer().find(", OpenGL"), 0U);
  const Image image = context->target().read();
  EXPECT_EQ(image.width, 64);
  EXPECT_EQ(image.height, 32);
}

TEST(Context, NamesTheGpuThatAutoDrawsOn) {
  const std::string gpu = gpu_name();
  const auto context = open_context("auto", 4, 4);
  EXPECT_EQ(gpu, context->software() ? "" : context->renderer());
}

TEST(Context, NamesTheNearestRenderer) {
  const Failure error = failure_of([] { open_context("osmeza", 64, 64); });
  EXPECT_EQ(error.code, ExitCode::kUsage);
  EXPECT_THAT(error.what, HasSubstr("did you mean 'osmesa'?"));
}

TEST(Context, RefusesSizesThatCannotBeDrawn) {
  for (const auto& [width, height] : {std::pair{0, 64}, {64, 0}, {-1, 64}, {16385, 64}, {64, 16385}}) {
    const Failure error = failure_of([w = width, h = height] { open_context("osmesa", w, h); });
    EXPECT_EQ(error.code, ExitCode::kUsage) << width << " x " << height;
    EXPECT_THAT(error.advice, HasSubstr("16384"));
  }
  EXPECT_NO_THROW(open_context("osmesa", 16384, 2));
  EXPECT_NO_THROW(open_context("osmesa", 2, 16384));
  EXPECT_NO_THROW(open_context("osmesa", 1, 1));
}

TEST(Context, RefusesPicturesBeyondTheMemory) {
  const auto context = open_context("osmesa", 8, 8);
  // 9 GiB of samples: more than llvmpipe allocates for one picture on any machine.
  const Failure error = failure_of([&] { context->target().resize(16384, 16384); });
  EXPECT_EQ(error.code, ExitCode::kEnvironment);
  EXPECT_THAT(error.advice, HasSubstr("smaller"));
}

TEST(Context, SaysWhichPackageIsMissing) {
  const Failure absent = failure_of([] { open_osmesa(8, 8, "libNoSuchMesa.so.8"); });
  EXPECT_EQ(absent.code, ExitCode::kEnvironment);
  EXPECT_THAT(absent.what, HasSubstr("libNoSuchMesa.so.8"));
  EXPECT_THAT(absent.advice, HasSubstr("libosmesa6"));
  const Failure other = failure_of([] { open_osmesa(8, 8, "libm.so.6"); });
  EXPECT_EQ(other.code, ExitCode::kEnvironment);
  EXPECT_THAT(other.advice, HasSubstr("libosmesa6"));
}

// The driver is chosen once per process, so this runs another process. Softpipe has only OpenGL 3.3.
TEST(ContextDeathTest, SaysThatTheDriverIsTooOld) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  ASSERT_EQ(setenv("GALLIUM_DRIVER", "softpipe", 1), 0);
  EXPECT_EXIT(
      {
        const Failure error = failure_of([] { open_context("osmesa", 8, 8); });
        std::cerr << error.what << std::endl;
        std::_Exit(static_cast<int>(error.code));
      },
      ::testing::ExitedWithCode(4), "OpenGL 4.5");
  unsetenv("GALLIUM_DRIVER");
}

TEST(Context, KeepsThePicturesOfTwoContextsApartWhateverIsClosed) {
  const auto first = open_context("osmesa", 4, 4);
  first->target().bind();
  clear(1, 0, 0);
  const auto second = open_context("osmesa", 4, 4);
  second->target().bind();
  clear(0, 1, 0);
  open_context("osmesa", 4, 4).reset();
  first->make_current();
  EXPECT_EQ(first->target().read().pixel(2, 2), (Rgb{255, 0, 0}));
  second->make_current();
  EXPECT_EQ(second->target().read().pixel(2, 2), (Rgb{0, 255, 0}));
}

std::size_t resident_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::strtoull(line.c_str() + 6, nullptr, 10);
  }
  return 0;
}

std::ptrdiff_t threads() {
  using Iterator = std::filesystem::directory_iterator;
  return std::distance(Iterator("/proc/self/task"), Iterator());
}

TEST(Context, ClosesWithoutLeaving) {
  const auto open_many = [](int count) {
    for (int i = 0; i < count; ++i) {
      const auto context = open_context("osmesa", 512, 512);
      context->target().bind();
      clear(0, 0, 0);
      EXPECT_EQ(context->target().read().pixel(0, 0), (Rgb{0, 0, 0}));
    }
  };
  open_many(5);
  const std::size_t before = resident_kib();
  const auto threads_before = threads();
  open_many(30);
  EXPECT_EQ(threads(), threads_before);
  // One picture takes 9 MiB; leaking all of them would take 270 MiB.
  EXPECT_LT(resident_kib(), before + 40 * 1024);
}

TEST(Target, TakesNewSizes) {
  const auto context = open_context("osmesa", 10, 20);
  RenderTarget& target = context->target();
  for (const auto& [width, height] : {std::pair{33, 7}, {1, 1}, {300, 200}, {10, 20}}) {
    target.resize(width, height);
    target.bind();
    clear(1, 1, 0);
    const Image image = target.read();
    ASSERT_EQ(image.width, width);
    ASSERT_EQ(image.height, height);
    EXPECT_EQ(image.pixel(0, 0), (Rgb{255, 255, 0}));
    EXPECT_EQ(image.pixel(width - 1, height - 1), (Rgb{255, 255, 0}));
  }
  EXPECT_THROW(target.resize(0, 5), Error);
  EXPECT_EQ(target.width(), 10);
  EXPECT_EQ(target.read().pixel(9, 19), (Rgb{255, 255, 0}));
}

TEST(Target, ShowsATriangleWhereItIs) {
  const auto context = open_context("osmesa", 100, 100);
  const Program program = link_program(kVertex, kFragment);
  context->target().bind();
  clear(0, 0, 1);
  // The upper left half: pixel rows count from the top.
  draw_triangle(program, {glm::vec3(-1, 1, 0), {-1, -1, 0}, {1, 1, 0}}, {1, 0, 0});
  const Image image = context->target().read();
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      if (x + y < 98) {
        ASSERT_EQ(image.pixel(x, y), (Rgb{255, 0, 0})) << x << ' ' << y;
      } else if (x + y > 100) {
        ASSERT_EQ(image.pixel(x, y), (Rgb{0, 0, 255})) << x << ' ' << y;
      }
    }
  }
  // The diagonal halves its pixels, so multisampling gives a mixture.
  const Rgb edge = image.pixel(50, 49);
  EXPECT_GT(edge[0], 60);
  EXPECT_LT(edge[0], 195);
}

TEST(Target, LetsTheNearestWinInAnyOrder) {
  const auto context = open_context("osmesa", 16, 16);
  const Program program = link_program(kVertex, kFragment);
  const std::array<glm::vec3, 3> near{glm::vec3(-1, -1, -0.5F), {3, -1, -0.5F}, {-1, 3, -0.5F}};
  const std::array<glm::vec3, 3> far{glm::vec3(-1, -1, 0.5F), {3, -1, 0.5F}, {-1, 3, 0.5F}};
  context->target().bind();
  glEnable(GL_DEPTH_TEST);
  for (const bool near_first : {true, false}) {
    clear(0, 0, 0);
    if (near_first) draw_triangle(program, near, {1, 0, 0});
    draw_triangle(program, far, {0, 1, 0});
    if (!near_first) draw_triangle(program, near, {1, 0, 0});
    EXPECT_EQ(context->target().read().pixel(8, 8), (Rgb{255, 0, 0}));
  }
}

TEST(Shader, ThatDoesNotCompileShowsTheLog) {
  const auto context = open_context("osmesa", 4, 4);
  const ShaderFile broken{"broken.frag", "#version 450 core\nvoid main() { nonsense = 1; }"};
  const Failure error = failure_of([&] { link_program(kVertex, broken); });
  EXPECT_EQ(error.code, ExitCode::kEnvironment);
  EXPECT_THAT(error.what, HasSubstr("broken.frag"));
  EXPECT_THAT(error.what, HasSubstr("nonsense"));
  const ShaderFile unmatched{
      "unmatched.frag",
      "#version 450 core\nin vec3 absent; out vec4 c; void main() { c = vec4(absent, 1); }"};
  EXPECT_THAT(failure_of([&] { link_program(kVertex, unmatched); }).what, HasSubstr("absent"));
}

TEST(Gl, ErrorsAreThrownOnce) {
  const auto context = open_context("osmesa", 4, 4);
  glEnable(0xFFFF);
  EXPECT_THAT(failure_of([] { check_gl("here"); }).what, HasSubstr("here"));
  EXPECT_NO_THROW(check_gl("here"));
}

}  // namespace
}  // namespace terrabench
