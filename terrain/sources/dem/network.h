// Whether a terrain may be fetched from the network. A file can name others (a .vrt its sources, as
// /vsicurl/https://…), so without this a DEM from a stranger could make the program reach any address.
#pragma once

namespace terrabench {

// Lets GDAL's virtual files reach the network. Call before the first DEM is read; afterwards it has no
// effect.
void allow_network();

// Replaces GDAL's file systems that are not on this machine by one that refuses to open anything, unless
// allow_network() was called. Called once by register_gdal().
void guard_network();

}  // namespace terrabench
