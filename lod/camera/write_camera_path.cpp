#include <fmt/format.h>

#include <iterator>

#include "lod/camera/camera_path.h"

namespace terrabench {
namespace {

using Out = std::back_insert_iterator<std::string>;

// TOML's floats need a point or an exponent only to be told from integers, which the reader takes as well.
void write_keyframe(const Keyframe& key, const CameraPath& path, bool first, Out out) {
  fmt::format_to(out, "\n[[keyframe]]\n");
  const bool turns = path.kind == CameraPath::Kind::kTurn;
  if (!turns || first) fmt::format_to(out, "at = [{}, {}]\n", key.at.x, key.at.y);
  if (path.kind == CameraPath::Kind::kFly) fmt::format_to(out, "height = {}\n", key.height);
  fmt::format_to(out, "speed = {}\n", key.speed);
  if (path.look == CameraPath::Look::kPlace)
    fmt::format_to(out, "look_at = [{}, {}]\n", key.look_at.x, key.look_at.y);
  if (path.look == CameraPath::Look::kHeading)
    fmt::format_to(out, "heading = {}\npitch = {}\n", key.heading, key.pitch);
}

}  // namespace

std::string to_toml(const CameraPath& path) {
  constexpr std::string_view kKinds[] = {"walk", "fly", "turn"};
  std::string text;
  const Out out(text);
  fmt::format_to(out, "kind = \"{}\"\nunit = \"{}\"\norigin = [{}, {}]\n",
                 kKinds[static_cast<std::size_t>(path.kind)], path.by_extent ? "extent" : "m", path.origin.x,
                 path.origin.y);
  fmt::format_to(out, "field_of_view = {}\nscreen = [{}, {}]\nframes_per_second = {}\n", path.field_of_view,
                 path.screen.x, path.screen.y, path.frames_per_second);
  if (path.near) fmt::format_to(out, "near = {}\n", *path.near);
  if (path.up) fmt::format_to(out, "up = [{}, {}, {}]\n", path.up->x, path.up->y, path.up->z);
  if (path.shrinks) fmt::format_to(out, "shrink = true\n");
  for (const Keyframe& key : path.keyframes) write_keyframe(key, path, &key == &path.keyframes.front(), out);
  return text;
}

}  // namespace terrabench
