// The session's pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viewer/session.h"

namespace terrabench::viewer {
namespace {

constexpr std::size_t kMostMapped = std::size_t{4097} * 4097;  // samples: a map takes 15 bytes for each

// The columns [from, to) of one picture into another of the same size.
void copy_columns(const Image& from, Image& to, glm::ivec2 columns) {
  for (int y = 0; y < to.height; ++y) {
    const auto at = [&](int x) { return 3 * (static_cast<std::ptrdiff_t>(y) * to.width + x); };
    std::copy(from.rgb.begin() + at(columns.x), from.rgb.begin() + at(columns.y),
              to.rgb.begin() + at(columns.x));
  }
}

std::string three(const char* option, const glm::vec3& v) {
  return fmt::format(" {} {} {} {}", option, v.x, v.y, v.z);
}

}  // namespace

FrameStyle Session::style(float scale) const {
  const Bounds& bounds = ground().bounds;
  FrameStyle style{.lowest = bounds.low.y, .highest = bounds.high.y};
  if (look.wires) style.wire_width = scale;
  style.colours = look.colours == Colours::kHeight         ? GroundColours::kHeight
                  : look.colours == Colours::kTriangleSize ? GroundColours::kTriangleSize
                                                           : GroundColours::kPaint;
  return style;
}

// The columns [from, to) of a picture that show a side.
glm::ivec2 Session::columns(int side, int width) const {
  if (sides() < 2) return {0, width};
  const int middle =
      std::clamp(static_cast<int>(std::lround(look.split * static_cast<float>(width))), 0, width);
  return side == 0 ? glm::ivec2(0, middle) : glm::ivec2(middle, width);
}

void Session::draw(glm::ivec2 size, double seconds, const Show& show) {
  size_ = size;
  const bool maps = look.colours == Colours::kError && !look.landscape;
  if (maps && ground().heights.heights.size() > kMostMapped) {
    look.colours = Colours::kHeight;
    message = "colours by error are for ground of at most 4097 × 4097 samples";
  }
  const View seen = view(size);
  for (int k = 0; k < sides(); ++k) {
    Side& one = side(k);
    one.show_landscape(look.landscape);
    one.choose(frozen_.value_or(seen));
    if (maps) one.map_errors(look.full_error);
    one.draw(seen, style(1), seconds);
    const glm::ivec2 part = columns(k, size.x);
    if (part.x < part.y) show(part.x, part.y);
  }
}

Image Session::picture(glm::ivec2 size, float scale) {
  const View seen = view(size);
  Image whole(size.x, size.y, {255, 255, 255});
  for (int k = 0; k < sides(); ++k) {
    side(k).show_landscape(look.landscape);
    side(k).choose(frozen_.value_or(seen));
    copy_columns(side(k).draw_apart(seen, style(scale)), whole, columns(k, size.x));
  }
  return whole;
}

std::string Session::command(glm::ivec2 size) const {
  const Side& shown = *sides_.front();
  const bool grass = look.landscape && shown.method().type->traits.near_surface && ground().surface;
  const bool drawn_alike = look.landscape ? !grass : look.colours == Colours::kHeight && !look.wires;
  if (sides() != 1 || ground().render.empty() || frozen_ || !drawn_alike || edits_.count() > 0 || playing())
    return "";
  const View seen = view(size);
  std::string text = fmt::format("{}{} --lod {}", ground().render, look.landscape ? " --scene" : "",
                                 shown.method().type->name);
  if (shown.method().type->tunable()) text += fmt::format(" --detail {}", shown.knob());
  const Parameters &options = shown.method().options, usual(options.specs());
  for (std::size_t k = 0; k < options.specs().size(); ++k) {
    if (options.value(k) != usual.value(k))
      text += fmt::format(" --set {}={}", options.specs()[k].name, to_string(options.value(k)));
  }
  text += three("--eye", seen.eye) + three("--look-at", seen.target);
  if (seen.up != glm::vec3(0, 1, 0)) text += three("--up", seen.up);
  return text +
         fmt::format(" --fov {} --size {}x{}", static_cast<float>(camera.field_of_view), size.x, size.y);
}

}  // namespace terrabench::viewer
