#include "renderers/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "renderers/gl.h"
#include "renderers/osmesa/osmesa_context.h"
#include "renderers/target.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

struct ContextType {
  std::string_view name;
  std::unique_ptr<GlContext> (*open)(int width, int height);
};

// One entry per context.
constexpr ContextType kContexts[] = {
    {"osmesa", [](int width, int height) { return open_osmesa(width, height); }},
};

std::string text(GLenum name) {
  const auto* const value = reinterpret_cast<const char*>(glGetString(name));
  return value == nullptr ? "unknown" : value;
}

}  // namespace

GlContext::GlContext() = default;
GlContext::~GlContext() = default;

std::string GlContext::renderer() const {
  return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

std::unique_ptr<GlContext> open_context(std::string_view name, int width, int height) {
  for (const ContextType& type : kContexts) {
    if (type.name == name) return type.open(width, height);
  }
  std::vector<std::string_view> known;
  std::transform(std::begin(kContexts), std::end(kContexts), std::back_inserter(known),
                 [](const ContextType& type) { return type.name; });
  throw unknown_name("renderer", name, known);
}

}  // namespace terrabench
