// `terrabench render`: a picture of a terrain, or a sequence of pictures along a camera path.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "experiments/commands/commands.h"
#include "experiments/near_ground.h"
#include "experiments/scene.h"
#include "lod/camera/camera_path.h"
#include "renderers/frame_renderer.h"
#include "terrain/files.h"
#include "terrain/framing.h"

namespace terrabench {
namespace {

namespace fs = std::filesystem;

constexpr int kMostFrames = 100000;

struct Shot {
  View view;
  double seconds;
  fs::path file;
};

// The values of --set, each for the landscape or the method, whichever has it.
struct Settings {
  Parameters look, grass, method;
};

Settings parse_settings(const RenderArguments& a, const LodType& type) {
  Settings settings{Parameters(landscape_parameters()), Parameters(grass_parameters()),
                    Parameters(type.parameters)};
  std::vector<ParameterSpec> all;
  for (const auto specs : {landscape_parameters(), grass_parameters(), type.parameters}) {
    all.insert(all.end(), specs.begin(), specs.end());
  }
  for (const std::string& assignment : split_assignments(a.assignments, all)) {
    const std::string name = assignment.substr(0, assignment.find('='));
    Parameters& of = settings.method.has(name)  ? settings.method
                     : settings.grass.has(name) ? settings.grass
                                                : settings.look;
    of.set_from_text(assignment);
  }
  return settings;
}

glm::vec3 vector_of(const std::vector<float>& three) { return {three[0], three[1], three[2]}; }

View single_view(const RenderArguments& a, const LandscapeStyle& style, const Heightfield& field) {
  const glm::ivec2 size = parse_size(a.size.empty() ? "1600x1000" : a.size);
  View view = scene_view(style, field, size.x, size.y);
  if (!a.look_at.empty()) view.target = vector_of(a.look_at);
  if (!a.eye.empty()) {
    view.eye = vector_of(a.eye);
    set_depth_planes(view, field, style.ground, !a.scene);
  }
  view.up = a.up.empty() ? upright(view.target - view.eye) : vector_of(a.up);
  if (a.field_of_view > 0) view.vertical_fov = a.field_of_view * 3.14159265F / 180;
  return view;
}

std::string frame_name(int number, int frames) {
  const int digits = std::max(4, static_cast<int>(std::to_string(frames - 1).size()));
  return fmt::format("frame_{:0{}}.png", number, digits);
}

// One view into a.out, or a.frames views of the path into files of the folder a.out.
std::vector<Shot> plan_shots(const RenderArguments& a, const LandscapeStyle& style,
                             const Heightfield& field) {
  if (a.path.empty()) return {{single_view(a, style, field), a.seconds, a.out}};
  const CameraPath path = open_camera_path(a.path);
  const std::vector<View> all = views(path, field);
  std::vector<Shot> shots;
  for (int k = 0; k < a.frames; ++k) {
    const std::size_t last = all.size() - 1;
    const std::size_t at = a.frames == 1 ? 0 : last * static_cast<std::size_t>(k) / (a.frames - 1);
    View view = all[at];
    if (!a.size.empty()) {
      const glm::ivec2 size = parse_size(a.size);
      view.width = size.x;
      view.height = size.y;
    }
    const float near = view.near;
    set_depth_planes(view, field, style.ground, !a.scene);
    if (path.near) view.near = near;
    const double seconds = a.seconds + static_cast<double>(at) / path.frames_per_second;
    shots.push_back({view, seconds, a.frames == 1 ? a.out : a.out / frame_name(k, a.frames)});
  }
  return shots;
}

void check_arguments(const RenderArguments& a) {
  if (a.frames < 1 || a.frames > kMostFrames) {
    throw usage_error(fmt::format("invalid number of frames {}", a.frames), "--frames",
                      fmt::format("it must be 1 to {}", kMostFrames));
  }
  if (a.frames > 1 && a.path.empty()) {
    throw usage_error("several frames need a camera path", "--frames", "add --path, such as --path fly");
  }
  if (!a.path.empty() && (!a.eye.empty() || !a.look_at.empty() || !a.up.empty() || a.field_of_view > 0)) {
    throw usage_error("a camera path sets the view", "--eye, --look-at, --up, --fov",
                      "leave them out, or --path");
  }
  std::error_code error;
  const fs::file_status status = fs::status(a.out, error);
  if (a.frames == 1 && fs::is_directory(status)) {
    throw usage_error("a single picture needs a file, but this is a folder", a.out.string(),
                      "name a file, such as scene.png");
  }
  if (a.frames > 1 && fs::exists(status) && !fs::is_directory(status)) {
    throw usage_error("several frames need a folder, but this is a file", a.out.string(), "name a folder");
  }
}

void check_detail(const RenderArguments& a, const LodType& type) {
  if (a.detail.empty()) return;
  const Knob& knob = type.knob;
  const auto [low, high] = std::minmax(knob.finest, knob.coarsest);
  if (a.detail[0] >= low && a.detail[0] <= high && setting(knob, a.detail[0]) == a.detail[0]) return;
  throw usage_error(fmt::format("the {} of {} cannot be {}", knob.name, type.name, a.detail[0]), "--detail",
                    low == high ? "leave it out: this method has a single setting"
                                : fmt::format("choose a {} from {} to {} {}",
                                              knob.whole ? "whole number" : "number", low, high, knob.unit));
}

// What the pictures of a folder depend on, kept in it, so that a later run continues only its own sequence.
std::string describe(const RenderArguments& a, const TerrainSource& source, const Settings& settings,
                     const std::vector<Shot>& shots, const GlContext& context) {
  std::string views;
  for (const Shot& shot : shots) {
    const View& v = shot.view;
    views += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} ", v.eye.x, v.eye.y, v.eye.z, v.target.x,
                         v.target.y, v.target.z, v.up.x, v.up.y, v.up.z, v.vertical_fov, v.near, v.far);
  }
  std::string text = fmt::format(
      "terrain = \"{}\"\nchecksum = \"{}\"\nscene = {}\npath = \"{}\"\nframes = {}\n"
      "size = \"{}x{}\"\nlod = \"{}\"\ndetail = \"{}\"\nsamples = {}\nseconds = {}\n"
      "views = \"{}\"\nrenderer = \"{}\"\n",
      source.name, source.checksum, a.scene, a.path, a.frames, shots[0].view.width, shots[0].view.height,
      a.lod, a.detail.empty() ? "usual" : fmt::format("{}", a.detail[0]), a.samples, a.seconds,
      checksum(views), context.renderer());
  for (const Parameters* parameters : {&settings.look, &settings.grass, &settings.method}) {
    for (std::size_t k = 0; k < parameters->specs().size(); ++k) {
      text += fmt::format("{} = \"{}\"\n", parameters->specs()[k].name, to_string(parameters->value(k)));
    }
  }
  return text;
}

void claim_folder(const fs::path& folder, const std::string& description, const std::vector<Shot>& shots) {
  const fs::path file = folder / "render.toml";
  if (fs::exists(file)) {
    if (read_file(file) == description) return;
    throw usage_error("the folder holds pictures that were rendered with other settings", folder.string(),
                      "choose another --out, or delete the folder");
  }
  for (const Shot& shot : shots) {
    if (fs::exists(shot.file)) {
      throw usage_error("the folder holds pictures of another program", shot.file.string(),
                        "choose another --out, or delete the folder");
    }
  }
  write_file(file, description);
}

// Draws frames as a landscape or as shaded relief.
class Painter {
 public:
  Painter(const RenderArguments& a, GlContext& context, Lod& lod, const LandscapeStyle& style,
          const Parameters& grass)
      : lod_(lod), style_(style) {
    if (a.scene) {
      scene_.emplace(context, lod, style);
      scene_->grow(grass, style);
    } else {
      relief_.emplace(context);
    }
  }
  const Frame& update(const View& view) { return scene_ ? scene_->update(view) : lod_.update(view); }
  Image draw(const Frame& frame, const Shot& shot) {
    if (scene_) return scene_->draw(shot.view, shot.seconds);
    const Bounds& ground = style_.ground;
    relief_->draw(frame, shot.view, {.lowest = ground.low.y, .highest = ground.high.y});
    return relief_->image();
  }
  // Of the last picture drawn.
  bool shows_ground() { return scene_ ? scene_->shows_ground() : relief_->shows_ground(); }
  // A frame whose picture exists: a method's next frame builds on it.
  void skip(const Frame& frame, const View& view) {
    if (scene_) {
      scene_->skip();
    } else {
      View small = view;
      small.width = small.height = 1;
      relief_->draw(frame, small, {});
    }
  }

 private:
  Lod& lod_;
  const LandscapeStyle& style_;
  std::optional<ScenePainter> scene_;
  std::optional<FrameRenderer> relief_;
};

struct Painted {
  std::size_t kept = 0;            // from an earlier run
  std::vector<const Shot*> empty;  // drawn without any ground in view
};

Painted paint(const RenderArguments& a, const std::vector<Shot>& shots, Painter& painter,
              const TerrainSource& source, const Heightfield& field, Progress& progress) {
  Painted painted;
  progress.begin("render", shots.size());
  for (const Shot& shot : shots) {
    const Frame& frame = painter.update(shot.view);
    check_eye(shot.view, frame, source, field);
    if (a.frames > 1 && fs::exists(shot.file)) {
      painter.skip(frame, shot.view);
      ++painted.kept;
    } else {
      const Image picture = painter.draw(frame, shot);
      if (!painter.shows_ground()) {
        if (shots.size() == 1) refuse_empty(shot.view, bounds_of(field));
        painted.empty.push_back(&shot);
      }
      write_picture(shot.file, picture);
    }
    progress.advance();
  }
  progress.end();
  if (painted.empty.size() == shots.size()) {
    for (const Shot& shot : shots) fs::remove(shot.file);  // or the next run would keep them
    refuse_empty(shots.front().view, bounds_of(field));
  }
  return painted;
}

}  // namespace

ExitCode render_command(const RenderArguments& a) {
  check_arguments(a);
  const LodType& type = lod(a.lod);
  check_detail(a, type);
  const Settings settings = parse_settings(a, type);
  if (!a.size.empty()) parse_size(a.size);
  if (!a.path.empty()) open_camera_path(a.path);  // before work that may take minutes
  Progress progress(isatty(STDERR_FILENO) != 0 ? Progress::Output::kTerminal : Progress::Output::kLines);

  const TerrainSource source = open_terrain(a.terrain, a.seed);
  const NearGround ground = ground_for(source, type.traits.near_surface, a.samples, progress);
  const Heightfield& field = ground.heights;
  LandscapeStyle style = make_style(settings.look, bounds_of(field));
  const std::vector<Shot> shots = plan_shots(a, style, field);
  if (a.path.empty()) thin_fog(style, shots[0].view.eye);
  const auto method = type.build(ground.lod(), settings.method, progress);
  if (!a.detail.empty()) method->tune(a.detail[0]);
  // Before the renderer's textures are computed, which takes a second or more.
  check_eye(shots[0].view, method->update(shots[0].view), source, field);
  const auto context = open_context(a.renderer, shots[0].view.width, shots[0].view.height);
  if (a.frames > 1) claim_folder(a.out, describe(a, source, settings, shots, *context), shots);
  Painter painter(a, *context, *method, style, settings.grass);
  const Painted painted = paint(a, shots, painter, source, field, progress);

  fmt::print("terrain     {}, checksum {}\n", source.name, source.checksum);
  for (const std::string& note : source.notes) fmt::print("note        {}\n", note);
  fmt::print("method      {}, {}\n", type.name, context->renderer());
  if (painted.kept > 0) {
    fmt::print("kept        {} of {} pictures from an earlier run\n", painted.kept, shots.size());
  }
  if (!painted.empty.empty()) {
    fmt::print("warning     no ground is in view in {} of {} pictures, the first {}\n", painted.empty.size(),
               shots.size(), painted.empty.front()->file.string());
  }
  fmt::print("rendered    {}\n", a.out.string());
  return ExitCode::kGood;
}

}  // namespace terrabench
