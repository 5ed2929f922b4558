#include "renderers/shader_parts.h"

#include <fmt/format.h>

#include <string>

namespace terrabench {
namespace {

struct Composed {
  std::string name, text;
  ShaderFile file() const { return {name, text}; }
};

Composed compose(ShaderParts parts) {
  Composed all;
  int number = 0;
  for (const std::string_view part : parts) {
    const ShaderFile& file = shader_file(part);
    const bool versioned = file.text.starts_with("#version");
    if (number == 0 && !versioned) all.text = "#version 450 core\n";
    if (!versioned) all.text += fmt::format("#line 1 {}\n", number);
    all.text += file.text;
    all.name += (number == 0 ? "" : " + ") + std::string(file.name);
    ++number;
  }
  return all;
}

}  // namespace

Program link_parts(ShaderParts vertex, ShaderParts fragment, ShaderParts geometry) {
  const Composed first = compose(vertex), last = compose(fragment), between = compose(geometry);
  const ShaderFile middle = between.file();
  return link_program(first.file(), last.file(), geometry.size() == 0 ? nullptr : &middle);
}

}  // namespace terrabench
