// Every method of the registry, and those ways of setting one that draw differently: what tests of all
// methods run over.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "lod/lod.h"

namespace terrabench::test {

struct Variant {
  std::string_view method;
  std::string_view setting{};  // "key=value"
  std::string_view suffix{};   // of the tests' names
};

inline std::ostream& operator<<(std::ostream& out, const Variant& variant) {
  return out << variant.method << ' ' << variant.setting;
}

inline std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const LodType& type : lods()) all.push_back({type.name});
  all.push_back({"geomipmap", "morph=true", "_morph"});
  return all;
}

inline std::string name_of(const ::testing::TestParamInfo<Variant>& info) {
  return std::string(info.param.method) + std::string(info.param.suffix);
}

inline std::unique_ptr<Lod> build(const Variant& variant, const Heightfield& field, Progress& progress) {
  const LodType& type = lod(variant.method);
  Parameters parameters(type.parameters);
  if (!variant.setting.empty()) parameters.set_from_text(variant.setting);
  return type.build(field, parameters, progress);
}

}  // namespace terrabench::test
