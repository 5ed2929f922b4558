terrabench_fuzz(camera_path_fuzz SOURCES camera_path_fuzz.cpp LIBRARIES lod)
