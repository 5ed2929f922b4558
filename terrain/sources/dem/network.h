// Whether a terrain may be fetched from the network. A file can name others (a .vrt its sources, as
// /vsicurl/https://…), so without this a DEM from a stranger could make the program reach any address.
#pragma once

namespace terrabench {

// Lets GDAL's virtual files reach the network. Call before the first DEM is read; afterwards it has no
// effect.
void allow_network();

// Unless allow_network() was called, makes GDAL refuse all that is not on this machine: files of its remote
// file systems, netCDF by URL, and what it would fetch by HTTP. Formats whose libraries reach the network in
// other ways must not be registered. Called once by register_gdal(), after the drivers are registered.
void guard_network();

}  // namespace terrabench
