// Every method of the registry with its default parameters, and once more per boolean parameter with that
// parameter inverted: the tests of all methods run over these, and so find a new method or switch by
// themselves.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "lod/camera/camera_path.h"
#include "lod/lod.h"

namespace terrabench::test {

struct Variant {
  std::string_view method;
  std::string parameter{};  // empty for the defaults
  bool value = false;       // of the parameter
};

inline std::ostream& operator<<(std::ostream& out, const Variant& variant) {
  return out << variant.method << ' ' << variant.parameter;
}

inline std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const LodType& type : lods()) {
    all.push_back({type.name});
    for (const ParameterSpec& spec : type.parameters) {
      const bool* const fallback = std::get_if<bool>(&spec.fallback);
      if (fallback != nullptr) all.push_back({type.name, std::string(spec.name), !*fallback});
    }
  }
  return all;
}

inline std::string name_of(const ::testing::TestParamInfo<Variant>& info) {
  const Variant& variant = info.param;
  if (variant.parameter.empty()) return std::string(variant.method);
  return fmt::format("{}_{}{}", variant.method, variant.value ? "" : "no_", variant.parameter);
}

inline std::unique_ptr<Lod> build(const Variant& variant, const Heightfield& field, Progress& progress) {
  const LodType& type = lod(variant.method);
  Parameters parameters(type.parameters);
  if (!variant.parameter.empty()) parameters.set(variant.parameter, variant.value);
  return type.build(field, parameters, progress);
}

// Every so many-th frame of every committed path: near and far ground, small steps and jumps.
inline std::vector<View> path_over(const Heightfield& field, std::size_t every) {
  std::vector<View> some;
  for (const CameraPath& path : camera_paths()) {
    const std::vector<View> all = views(path, field);
    for (std::size_t k = 0; k < all.size(); k += every) some.push_back(all[k]);
  }
  return some;
}

}  // namespace terrabench::test
