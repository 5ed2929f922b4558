#include <gtest/gtest.h>

#include "terrain/parameters.h"

namespace terrabench {
namespace {

using Texts = std::vector<std::string>;

const ParameterSpec kSpecs[] = {
    {"n", std::int64_t{1}, "", ""}, {"scale", 1.0, "", ""}, {"path", std::string(), "", ""}};

Texts split(const Texts& texts) { return split_assignments(texts, kSpecs); }

TEST(Assignments, OneTextOrSeveralMeanTheSame) {
  const Texts expected{"n=16", "scale=2", "path=fly"};
  EXPECT_EQ(split({"n=16,scale=2,path=fly"}), expected);
  EXPECT_EQ(split({"n=16", "scale=2,path=fly"}), expected);
  EXPECT_EQ(split({"n=16", "scale=2", "path=fly"}), expected);
  EXPECT_EQ(split({}), Texts{});
}

TEST(Assignments, TextMayContainCommas) {
  EXPECT_EQ(split({"path=a,b.toml,n=3"}), (Texts{"path=a,b.toml", "n=3"}));
  EXPECT_EQ(split({"path=roam.a=1,clipmap.b=2,scale=4"}), (Texts{"path=roam.a=1,clipmap.b=2", "scale=4"}));
  EXPECT_EQ(split({"path=", "n=1"}), (Texts{"path=", "n=1"}));
}

// An unknown name after a number is an assignment too, so that the error can suggest the nearest name.
TEST(Assignments, UnknownNamesAreSplitOffNumbers) {
  EXPECT_EQ(split({"n=16,sclae=2"}), (Texts{"n=16", "sclae=2"}));
  EXPECT_EQ(split({"n=1,6"}), Texts{"n=1,6"});
  EXPECT_EQ(split({""}), Texts{""});
  EXPECT_EQ(split({"n=16,"}), Texts{"n=16,"});  // which set() refuses as a number
}

}  // namespace
}  // namespace terrabench
