#include "renderers/relief.h"

#include "renderers/scene.h"

namespace terrabench {

Image render_relief(GlContext& context, const TriangleMesh& mesh, const View& view,
                    const ReliefStyle& style) {
  Scene scene;
  scene.lowest = style.lowest;
  scene.highest = style.highest;
  scene.sun = style.sun;
  scene.background = style.background;
  SceneMesh& drawn = scene.meshes.emplace_back();
  drawn.mesh = &mesh;
  drawn.shading_exaggeration = style.shading_exaggeration;
  if (style.wireframe) {
    drawn.wire_width = 1;
    drawn.wire_opacity = 0.55F;
  }
  return render_scene(context, scene, view);
}

}  // namespace terrabench
