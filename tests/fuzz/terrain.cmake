terrabench_fuzz(dem_fuzz SOURCES dem_fuzz.cpp LIBRARIES terrain GDAL::GDAL)
terrabench_fuzz(event_file_fuzz SOURCES event_file_fuzz.cpp LIBRARIES terrain)
terrabench_fuzz(hydrology_fuzz SOURCES hydrology_fuzz.cpp LIBRARIES terrain)
