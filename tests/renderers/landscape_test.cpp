// Landscapes against committed pictures, by structural similarity, and that each planted fault is found by
// it.
//
// The threshold: pictures of another Mesa or processor differ from the references by rounding, which leaves a
// similarity above 0.99; each fault planted below costs more than 0.03. After a wanted change of the look,
// run the tests with TERRABENCH_WRITE_REFERENCES=1 and look at the pictures before committing them.
#include "renderers/landscape/landscape.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "lod/lod.h"
#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/metrics/image_error.h"
#include "tests/terrain/ground.h"

namespace terrabench {
namespace {

constexpr double kSimilar = 0.97;
constexpr glm::vec3 kByTheWater{330, 7, 470}, kWater{310, -3, 380};

// Hills around a bay, 640 m wide.
Heightfield bay() {
  return test::ground_of(
      161, 161,
      [](int i, int j) {
        const double x = i / 160.0, z = j / 160.0;
        const double away = std::hypot(x - 0.5, z - 0.55);
        const double hills =
            30 * std::sin(9 * x + 1) * std::cos(8 * z) + 12 * std::sin(23 * x) * std::sin(19 * z + 2);
        return 160 * std::min(away, 0.5) - 30 + hills + 4 * std::sin(61 * x) * std::cos(57 * z);
      },
      4, 4);
}

class Landscape : public ::testing::Test {
 protected:
  using Settings = std::initializer_list<std::pair<std::string_view, Value>>;

  LandscapeStyle style(Settings settings = {}) const {
    LandscapeStyle style =
        make_style(Parameters(landscape_parameters(), settings), {{0, -50, 0}, {640, 100, 640}});
    style.water_level = 0;
    style.fog_distance *= 3;
    return style;
  }
  static View view(glm::vec3 eye = {380, 50, 600}, glm::vec3 target = {290, 0, 330}) {
    View view;
    view.eye = eye;
    view.target = target;
    view.width = 320;
    view.height = 200;
    view.far = 3000;
    return view;
  }
  const Frame& frame(const View& view) {
    method_ = lod("clipmap").build(field_, Parameters(lod("clipmap").parameters), silent_);
    method_->tune(63);
    return method_->update(surroundings(view));
  }
  Image draw(const View& view, const LandscapeStyle& style,
             const std::function<void(PassView&)>& adjust = {}) {
    LandscapeRenderer renderer(*context_, style);
    renderer.adjust = adjust;
    renderer.draw(frame(view), view, 3);
    return renderer.image();
  }
  static Image reference(const std::string& name, const Image& now) {
    const std::filesystem::path file =
        std::filesystem::path(TERRABENCH_SOURCE_DIR) / "tests/renderers/reference" / (name + ".png");
    if (std::getenv("TERRABENCH_WRITE_REFERENCES") != nullptr) write_picture(file, now);
    return read_picture(file);
  }

  std::unique_ptr<GlContext> context_ = open_context("osmesa", 16, 16);
  Heightfield field_ = bay();
  Progress silent_;
  std::unique_ptr<Lod> method_;
};

TEST_F(Landscape, LooksLikeTheReference) {
  const Image bay = draw(view(), style());
  EXPECT_GT(ssim(bay, reference("bay", bay)), kSimilar);
  const Image water = draw(view(kByTheWater, kWater), style());
  EXPECT_GT(ssim(water, reference("water", water)), kSimilar);
}

TEST_F(Landscape, AMissingNormalMapAndSwappedClipPlanesAreFound) {
  for (const Image& flawed : {draw(view(kByTheWater, kWater), style({{"wave_slope", 0.0}})),
                              draw(view(kByTheWater, kWater), style(),
                                   [](PassView& pass) { pass.clip_plane = -pass.clip_plane; })}) {
    EXPECT_LT(ssim(flawed, reference("water", flawed)), kSimilar - 0.02);
  }
}

TEST_F(Landscape, AMissingRingIsFound) {
  const View at = view();
  Frame holed = frame(at);
  std::vector<Batch> batches(holed.batches.begin(), holed.batches.end());
  std::set<int> levels;
  for (const Batch& batch : batches) levels.insert(batch.level);
  ASSERT_GE(levels.size(), 2U);
  const int missing = *std::next(levels.begin());
  std::erase_if(batches, [&](const Batch& batch) { return batch.level == missing; });
  holed.batches = batches;
  LandscapeRenderer renderer(*context_, style());
  renderer.draw(holed, at, 3);
  const Image flawed = renderer.image();
  EXPECT_LT(ssim(flawed, reference("bay", flawed)), kSimilar - 0.02);
}

TEST_F(Landscape, PassesAreThoseThatTheStyleNeeds) {
  const auto passes = [&](const LandscapeStyle& style) {
    std::vector<Pass> seen;
    LandscapeRenderer renderer(*context_, style);
    renderer.also = [&](const PassView& pass) { seen.push_back(pass.pass); };
    renderer.draw(frame(view()), view());
    return seen;
  };
  using enum Pass;
  EXPECT_THAT(passes(style()),
              ::testing::ElementsAre(kShadow, kShadow, kShadow, kDepth, kReflection, kRefraction, kPicture));
  LandscapeStyle plain = style({{"shadows", false}, {"occlusion", 0.0}});
  plain.has_water = false;
  EXPECT_THAT(passes(plain), ::testing::ElementsAre(kPicture));
}

// The mirrored pass sees with the mirrored eye what the picture shows upside down.
TEST_F(Landscape, TheReflectionIsTheMirroredScene) {
  LandscapeRenderer renderer(*context_, style());
  PassView mirrored, picture;
  renderer.also = [&](const PassView& pass) {
    if (pass.pass == Pass::kReflection) mirrored = pass;
    if (pass.pass == Pass::kPicture) picture = pass;
  };
  renderer.draw(frame(view()), view());
  EXPECT_FLOAT_EQ(mirrored.eye.y, -picture.eye.y);  // the water's level is 0
  for (const glm::vec3 p : {glm::vec3(300, 20, 300), glm::vec3(280, 60, 350)}) {
    const glm::vec4 in_picture = picture.world_to_clip * glm::vec4(p.x, -p.y, p.z, 1);
    const glm::vec4 in_mirror = mirrored.world_to_clip * glm::vec4(p, 1);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(in_picture[k], in_mirror[k], 1e-3 * std::abs(in_picture[k]) + 1e-3);
    EXPECT_GT(glm::dot(mirrored.clip_plane, glm::vec4(p, 1)), 0);
    EXPECT_LT(glm::dot(mirrored.clip_plane, glm::vec4(p.x, -p.y, p.z, 1)), 0);
  }
}

// Level water without waves that reflects all light shows the sky above, upside down.
TEST_F(Landscape, WaterReflectsTheSky) {
  LandscapeStyle mirror = style({{"fresnel_normal", 1.0},
                                 {"distortion", 0.0},
                                 {"wave_slope", 0.0},
                                 {"highlight", 0.0},
                                 {"haze", 0.001},
                                 {"fog", 1000.0},
                                 {"border", 0.0}});
  const View level = view({320, 0.5F, 300}, {320, 0.5F, 0});
  LandscapeRenderer renderer(*context_, mirror);
  renderer.draw({}, level);  // no ground
  const Image image = renderer.image();
  for (int x = 5; x < 320; x += 30) {
    for (int y = 5; y < 95; y += 10) {
      const Rgb above = image.pixel(x, y), below = image.pixel(x, 199 - y);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(above[c], below[c], 4) << x << ' ' << y;
    }
  }
}

// An eye under water looks up at a bright surface and across into the water's colour.
TEST_F(Landscape, AnEyeUnderWaterSeesTheWatersColour) {
  const Image across = draw(view({320, -12, 400}, {320, -13, 200}), style());
  const Image up = draw(view({320, -12, 400}, {322, 0, 399}), style());
  const auto mean = [](const Image& image, int channel) {
    double sum = 0;
    for (std::size_t k = channel; k < image.rgb.size(); k += 3) sum += image.rgb[k];
    return sum / (static_cast<double>(image.rgb.size()) / 3);
  };
  EXPECT_LT(mean(across, 0), 0.75 * mean(across, 2));
  EXPECT_GT(mean(up, 2), mean(across, 2));
}

// Toward the far distance the ground takes the sky's colour: no line remains at the horizon.
TEST_F(Landscape, TheHorizonBlendsIntoTheSky) {
  LandscapeStyle foggy = style({{"fog", 0.007}});
  const View at = view({320, 60, 620}, {320, 60, 0});
  const Image image = draw(at, foggy);
  for (int x = 0; x < image.width; x += 10) {
    for (int y = 96; y < 110; ++y) {
      const Rgb above = image.pixel(x, y), below = image.pixel(x, y + 1);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(above[c], below[c], 6) << x << ' ' << y;
    }
  }
}

TEST_F(Landscape, SeveralPicturesOfOneRendererEqualThoseOfFreshOnes) {
  LandscapeRenderer kept(*context_, style());
  Progress silent;
  const auto method = lod("clipmap").build(field_, Parameters(lod("clipmap").parameters), silent);
  method->tune(63);
  for (const float x : {380.0F, 350.0F}) {
    const View at = view({x, 14, 560});
    const Frame& now = method->update(surroundings(at));
    kept.draw(now, at, 3);
    const Image image = kept.image();
    LandscapeRenderer fresh(*context_, style());
    fresh.draw(now, at, 3);
    EXPECT_EQ(image.rgb, fresh.image().rgb);
  }
}

TEST_F(Landscape, BadInputIsAnErrorOrAPicture) {
  EXPECT_THROW(make_style(Parameters(landscape_parameters(), {{"fog_color", std::string("blue")}}), {}),
               Error);
  LandscapeRenderer renderer(*context_,
                             make_style(Parameters(landscape_parameters()), {}));  // no extent at all
  View bad = view();
  bad.eye.x = std::nanf("");
  EXPECT_THROW(renderer.draw(frame(view()), bad), Error);
  bad = view();
  bad.target = bad.eye;
  EXPECT_THROW(renderer.draw(frame(view()), bad), Error);
  View down = view();
  down.target = down.eye - glm::vec3(0.001F, 10, 0);
  renderer.draw(frame(down), down);
  renderer.draw({}, view());  // an empty frame: sky and water
  EXPECT_EQ(renderer.image().width, 320);
}

}  // namespace
}  // namespace terrabench
