#include "representations/procedural_mesh/model_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "representations/procedural_mesh/procedural_mesh.h"
#include "terrain/error.h"
#include "terrain/files.h"

namespace terrabench {
namespace {

constexpr float kFoot = 0.02F;  // of the model's height

TerrainSource source_of(MeshDescription description, const std::string& name) {
  const auto mesh = std::make_shared<const ProceduralMesh>(std::move(description), name);
  ByteSink content;
  mesh->save(content);
  TerrainSource source;
  source.name = name;
  source.checksum = checksum(content.bytes());
  source.notes.push_back(fmt::format("expanded {} B into {} triangles", content.bytes().size(),
                                     mesh->columns().triangles().size()));
  source.solid = Solid{mesh->bounds(), source.checksum, MeshColumns{mesh}};
  return source;
}

MeshDescription describe(std::string_view text) {
  MeshDescription description;
  description.model.assign(text.begin(), text.end());
  return description;
}

// How high the model's origin must lie: no vertex of the foot above the ground.
float height_of_stand(const ProceduralMesh& model, const ProceduralMesh& ground) {
  const std::vector<glm::vec3>& positions = model.columns().positions();
  const auto by_height = [](const glm::vec3& a, const glm::vec3& b) { return a.y < b.y; };
  const auto [lowest, highest] = std::minmax_element(positions.begin(), positions.end(), by_height);
  const float foot = lowest->y + kFoot * (highest->y - lowest->y);
  float stand = std::numeric_limits<float>::infinity();
  SpanSink sink;
  for (const glm::vec3& p : positions) {
    if (p.y > foot) continue;
    sink.clear();
    ground.spans({{&p.x, 1}, {&p.z, 1}}, sink);
    if (sink.all().empty()) {
      throw usage_error(
          fmt::format("the model's foot reaches ({:.6g}, {:.6g}) m, where there is no ground", p.x, p.z),
          "place of the model", "move it, or scale it less");
    }
    stand = std::min(stand, sink.all().back().top - p.y);
  }
  return stand;
}

}  // namespace

bool is_model_text(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); at = std::min(text.size(), text.find('\n', at)) + 1) {
    const std::string_view line = text.substr(at);
    if (line.starts_with("[base]") || line.starts_with("base =") || line.starts_with("base=") ||
        line.starts_with("base.") || line.starts_with("[[rule]]") || line.starts_with("[[step]]")) {
      return true;
    }
  }
  return false;
}

TerrainSource model_source(std::string_view text, const std::string& name) {
  return source_of(describe(text), name);
}

TerrainSource model_on_ground(std::string_view text, const std::string& name, const TerrainSource& ground,
                              std::optional<ModelPlace> place) {
  if (!ground.heights) {
    throw usage_error("a model stands on heights, not on a solid", ground.name,
                      "name a ground that is a height field");
  }
  const RepresentationType& type = representation("procedural_mesh");
  Progress progress;
  const auto plane = type.build(ground, Parameters(type.parameters), progress);
  const auto& mesh = static_cast<const ProceduralMesh&>(*plane);
  const Bounds bounds = mesh.bounds();
  if (!place) place = {bounds.high.x / 2, bounds.high.z / 2, 1};
  if (!(place->scale > 0 && std::isfinite(place->scale) && std::isfinite(place->x + place->z))) {
    throw usage_error("a place needs finite numbers and a scale above 0", "place of the model",
                      "give x, z and scale");
  }
  if (std::min(place->x, place->z) < 0 || place->x > bounds.high.x || place->z > bounds.high.z) {
    throw usage_error(
        fmt::format("there is no ground at ({:.6g}, {:.6g}) m", place->x, place->z), "place of the model",
        fmt::format("give x of 0 to {:.6g} m and z of 0 to {:.6g} m", bounds.high.x, bounds.high.z));
  }
  MeshDescription description = describe(text);
  description.scale = place->scale;
  description.offset = {place->x, 0, place->z};
  description.offset.y = height_of_stand(ProceduralMesh(description, name), mesh);
  description.ground = mesh.description().ground;
  description.ground_bounds = mesh.description().ground_bounds;
  description.levels = mesh.description().levels;
  return source_of(std::move(description), fmt::format("{} on {}", name, ground.name));
}

}  // namespace terrabench
