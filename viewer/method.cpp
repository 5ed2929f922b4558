#include "viewer/method.h"

#include <fmt/format.h>

#include "terrain/error.h"

namespace terrabench::viewer {

std::vector<Method> methods() {
  std::vector<Method> all;
  for (const LodType& type : lods()) {
    all.push_back({std::string(type.name), std::string(type.label), &type, Parameters(type.parameters)});
    for (const LodVariant& variant : type.variants) {
      Method& one = all.emplace_back(fmt::format("{}_{}", type.name, variant.name),
                                     fmt::format("{}, {}", type.label, variant.label), &type,
                                     Parameters(type.parameters));
      one.options.set_from_text(std::string(variant.option));
    }
  }
  return all;
}

Method method_named(std::string_view name) {
  const std::vector<Method> all = methods();
  std::vector<std::string_view> known;
  for (const Method& one : all) {
    if (one.name == name) return one;
    known.push_back(one.name);
  }
  throw unknown_name("level-of-detail method", name, known);
}

}  // namespace terrabench::viewer
