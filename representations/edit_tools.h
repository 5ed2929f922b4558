// Tools that dig and fill with a sphere, and the one event of the tree of heightmaps that is such a
// shape, on top of Representation::edit(), for any method with the trait `editable` (the edits that the
// hybrid paper leaves to future work). They touch only the columns within the radius: O(columns under the
// tool), plus what the method's own edit costs.
#pragma once

#include <cstddef>

#include "representations/column_grid.h"
#include "representations/representation.h"
#include "terrain/events/event.h"

namespace terrabench {

struct Sphere {
  glm::vec3 centre{0};  // metres
  float radius = 0;     // metres
};

// Fills the sphere with a material; air digs. A column whose axis meets it changes between the two points
// where it does, rounded as edit() rounds. Returns the number of such columns, which is 0 for a sphere that
// passes between all axes. Throws usage_error, before any change, for a representation that cannot be edited,
// a radius or position that is not finite, a radius ≤ 0, and a sphere that does not reach into the terrain's
// bounds.
std::size_t fill_sphere(Representation&, const Sphere&, Material);
// Removes what the event removes: all ground above the lower half of its ellipsoid. Counts as above. Throws
// usage_error, before any change, for a representation that cannot be edited, a centre or radii that are not
// finite, radii ≤ 0, an ellipse whose circumscribed circle does not reach the terrain, and an ellipsoid above
// all of the terrain.
std::size_t erode(Representation&, const events::RadialErosion&);

}  // namespace terrabench
