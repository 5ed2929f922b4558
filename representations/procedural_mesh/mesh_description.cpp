// The description of a procedural mesh: its file, and its expansion into polygons.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "representations/coding/height_codec.h"
#include "representations/column_grid.h"
#include "representations/procedural_mesh/model.h"
#include "representations/procedural_mesh/procedural_mesh.h"
#include "terrain/error.h"

namespace terrabench {
namespace {

constexpr std::uint32_t kGround = 1, kModel = 2;
constexpr std::size_t kMostFaces = std::size_t{1} << 24;  // of a model
constexpr int kMostLines = ColumnGrid::kMaxColumns + 2;   // a solid's texture has a border

void check_lines(const std::vector<float>& at, const ByteSource& in) {
  if (!std::all_of(at.begin(), at.end(), [](float v) { return std::isfinite(v); }) ||
      !std::is_sorted(at.begin(), at.end())) {
    in.fail("the lines of samples are not numbers in ascending order");
  }
}

// The second differences of the bits of positions, of which most are 0 where lines are evenly spaced.
std::vector<std::uint32_t> second_differences(std::span<const float> at) {
  std::vector<std::uint32_t> differences;
  std::uint32_t last = 0, step = 0;
  for (const float v : at) {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    differences.push_back(bits - last - step);
    step = bits - last;
    last = bits;
  }
  return differences;
}

std::vector<float> from_second_differences(std::span<const std::uint32_t> differences) {
  std::vector<float> at;
  std::uint32_t last = 0, step = 0;
  for (const std::uint32_t difference : differences) {
    step += difference;
    last += step;
    at.push_back(std::bit_cast<float>(last));
  }
  return at;
}

void load_ground(ByteSource& in, bool encoded, MeshDescription& out) {
  const int width = in.get<int>(), depth = in.get<int>();
  if (width < 1 || depth < 1 || width > kMostLines || depth > kMostLines) {
    in.fail("the ground's sizes are impossible");
  }
  out.levels = in.get<int>();
  if (out.levels < 0 || out.levels > 16) in.fail("the number of subdivisions is impossible");
  const auto lines = [&](int count) {
    return from_second_differences(in.get_array<std::uint32_t>(static_cast<std::uint64_t>(count)));
  };
  out.ground.x = lines(width);
  out.ground.z = lines(depth);
  check_lines(out.ground.x, in);
  check_lines(out.ground.z, in);
  out.ground.heights =
      encoded ? decode_heights(in, width, depth)
              : in.get_array<float>(static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(depth));
  out.ground_bounds = in.get<Bounds>();
  const Bounds& bounds = out.ground_bounds;
  if (!(is_finite(bounds.low) && is_finite(bounds.high) && glm::min(bounds.low, bounds.high) == bounds.low)) {
    in.fail("the bounds are impossible");
  }
  if (encoded) clamp_heights(out.ground.heights, bounds.low.y, bounds.high.y);
  const auto outside = [&](float height) { return height < bounds.low.y || height > bounds.high.y; };
  if (std::any_of(out.ground.heights.begin(), out.ground.heights.end(), outside)) {
    in.fail("a height lies outside the bounds");
  }
}

FaceMesh expand_model(const MeshDescription& description, const std::string& origin, int leave_out) {
  growing::Model model = growing::parse_model({description.model.data(), description.model.size()}, origin);
  model.limits.faces = std::min(model.limits.faces, kMostFaces);
  for (growing::Step& step : model.steps) step.growth.limits = model.limits;
  if (model.base.faces() > kMostFaces) {
    throw bad_input("the base mesh has too many faces for a terrain", origin, "use at most 2^24");
  }
  growing::leave_out_last(model, static_cast<std::uint32_t>(leave_out));
  FaceMesh mesh = growing::expand(model).mesh;
  for (glm::vec3& p : mesh.positions) {
    p = p * description.scale + description.offset;
    if (!is_finite(p))
      throw bad_input("the model's vertices lie beyond all numbers", origin, "scale it less");
  }
  return mesh;
}

// Texture coordinates stay where both meshes have them.
void append(FaceMesh& to, const FaceMesh& from) {
  const auto vertices = static_cast<std::uint32_t>(to.positions.size());
  const bool texture =
      to.texture.size() == to.positions.size() && from.texture.size() == from.positions.size();
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.texture.insert(to.texture.end(), from.texture.begin(), from.texture.end());
  if (!texture) to.texture.clear();
  for (std::size_t f = 0; f < from.faces(); ++f) {
    to.add_face(from.face(f));
    for (std::size_t c = to.first_corner[to.faces() - 1]; c < to.corners.size(); ++c)
      to.corners[c] += vertices;
  }
}

}  // namespace

void MeshDescription::save(ByteSink& out, std::optional<double> largest_error) const {
  out.put((has_ground() ? kGround : 0) | (model.empty() ? 0 : kModel));
  if (has_ground()) {
    out.put(static_cast<int>(ground.x.size()));
    out.put(static_cast<int>(ground.z.size()));
    out.put(levels);
    for (const auto* lines : {&ground.x, &ground.z})
      out.put_array(std::span<const std::uint32_t>(second_differences(*lines)));
    if (largest_error) {
      encode_heights(ground.heights, static_cast<int>(ground.x.size()),
                     step_for(ground.heights, *largest_error), out);
    } else {
      out.put_array(std::span<const float>(ground.heights));
    }
    out.put(ground_bounds);
  }
  if (!model.empty()) {
    out.put_text({model.data(), model.size()});
    out.put(scale);
    out.put(offset);
  }
  out.put(leave_out);
}

MeshDescription MeshDescription::load(ByteSource& in, bool encoded) {
  MeshDescription description;
  const auto parts = in.get<std::uint32_t>();
  if (parts == 0 || parts > (kGround | kModel)) in.fail("neither a ground nor a model");
  if ((parts & kGround) != 0) load_ground(in, encoded, description);
  if ((parts & kModel) != 0) {
    const std::string text = in.get_text();
    if (text.empty()) in.fail("the model is empty");
    description.model.assign(text.begin(), text.end());
    description.scale = in.get<float>();
    description.offset = in.get<glm::vec3>();
    if (!(description.scale > 0 && std::isfinite(description.scale) && is_finite(description.offset))) {
      in.fail("the model's place is impossible");
    }
  }
  description.leave_out = in.get<int>();
  if (description.leave_out < 0 || description.leave_out > 16) in.fail("the level of detail is impossible");
  return description;
}

FaceMesh MeshDescription::polygons(const std::string& origin, int leave_out_more) const {
  const int out = leave_out + leave_out_more;
  FaceMesh mesh;
  if (has_ground()) mesh = displaced_plane(ground, levels, out);
  if (model.empty()) return mesh;
  FaceMesh expanded = expand_model(*this, origin, out);
  if (!has_ground()) return expanded;
  append(mesh, expanded);
  return mesh;
}

}  // namespace terrabench
