// The panels over the picture: what can be set, what it costs, and what is being done. Between
// Interface::begin() and end().
#pragma once

#include <string>

#include "viewer/actions.h"

namespace terrabench::viewer {

// `frame_seconds`: of the frame before.
void show_panels(Session&, Controls&, double frame_seconds);
// Progress of the work, otherwise the last message.
void show_work(const Session&, const Controls&);
// The line between two methods, and the frustum that triangles were frozen for.
void show_marks(Session&, const Controls&);

// What is on screen as rows of a table for a spreadsheet, with a heading: ground, method, setting, triangles,
// error, milliseconds, bytes.
std::string comparison(Session&);

}  // namespace terrabench::viewer
