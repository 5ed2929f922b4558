// What holds for every method in the registry, and the promises in LodTraits for those that make them.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "lod/meters/cracks.h"
#include "lod/meters/screen_error.h"
#include "tests/lod/drawing.h"
#include "tests/lod/variants.h"

namespace terrabench::test {
namespace {

Heightfield ground() { return hilly(202, 173, 0.7F, 1, 5, 5); }

class EachMethod : public ::testing::TestWithParam<Variant> {
 protected:
  std::unique_ptr<Lod> build() { return test::build(GetParam(), field_, silent_); }
  const LodType& type_ = lod(GetParam().method);
  const Heightfield field_ = ground();
  const std::vector<View> path_ = path_over(field_, 20);
  Progress silent_;
};

TEST_P(EachMethod, DrawsTheSameForTheSameViews) {
  const std::unique_ptr<Lod> one = build(), other = build();
  for (const View& view : path_) {
    const Frame& frame = one->update(view);
    ASSERT_EQ(corners_of(frame), corners_of(other->update(view)));
    EXPECT_EQ(frame.stats.triangles, corners_of(frame).size() / 3);
  }
}

TEST_P(EachMethod, UploadsEverythingAtFirstAndNoHeightsTwiceAtRest) {
  const std::unique_ptr<Lod> lod = build();
  EXPECT_GT(lod->update(path_.front()).stats.bytes_uploaded, 0U);
  for (const DirtyRange& range : lod->update(path_.front()).uploads) {
    EXPECT_EQ(range.target, DirtyRange::Target::kMorphs);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EachMethod, ::testing::ValuesIn(variants()), name_of);

// The methods of some kind, with default parameters.
std::vector<Variant> methods(bool (*are)(const LodType&)) {
  std::vector<Variant> all;
  for (const LodType& type : lods()) {
    if (are(type)) all.push_back({type.name});
  }
  return all;
}

class ConformingMethod : public EachMethod {};

TEST_P(ConformingMethod, HasNoCracks) {
  const std::unique_ptr<Lod> lod = build();
  for (const View& view : path_) {
    const CrackReport cracks = find_cracks(lod->update(view), field_.width, field_.depth, view);
    ASSERT_TRUE(cracks.tight()) << cracks.gaps << " gaps, " << cracks.bare_edges << " bare edges";
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, ConformingMethod, ::testing::ValuesIn(methods([](const LodType& type) {
                           return type.traits.conforming;
                         })),
                         name_of);

class UnstitchedMethod : public EachMethod {};

TEST_P(UnstitchedMethod, HasGaps) {
  Parameters parameters(type_.parameters);
  parameters.set_from_text(std::string(type_.unstitched));
  const std::unique_ptr<Lod> lod = type_.build(field_, parameters, silent_);
  std::size_t gaps = 0;
  for (const View& view : path_)
    gaps += find_cracks(lod->update(view), field_.width, field_.depth, view).gaps;
  EXPECT_GT(gaps, 0U);
}

INSTANTIATE_TEST_SUITE_P(Registry, UnstitchedMethod, ::testing::ValuesIn(methods([](const LodType& type) {
                           return !type.unstitched.empty();
                         })),
                         name_of);

class BoundingMethod : public EachMethod {};

TEST_P(BoundingMethod, KeepsItsScreenSpaceError) {
  const std::unique_ptr<Lod> lod = build();
  double closest = 0;
  for (const double pixels : {1.0, 4.0}) {
    lod->tune(pixels);
    for (const View& view : path_) {
      const SurfaceRaster drawn(lod->update(view), field_.width, field_.depth);
      const Deviation error = screen_error(drawn, field_, SeenSamples(field_, view)).in_frustum;
      ASSERT_LE(error.largest, pixels * (1 + 1e-5) + 1e-4);
      ASSERT_EQ(error.undrawn, 0U);
      closest = std::max(closest, error.largest / pixels);
    }
  }
  EXPECT_GT(closest, 0.5);  // the bound is not met by drawing everything
}

INSTANTIATE_TEST_SUITE_P(Registry, BoundingMethod, ::testing::ValuesIn(methods([](const LodType& type) {
                           return type.traits.bounds_error;
                         })),
                         name_of);

}  // namespace
}  // namespace terrabench::test
