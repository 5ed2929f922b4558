terrabench_fuzz(camera_path_fuzz SOURCES camera_path_fuzz.cpp LIBRARIES lod)
terrabench_fuzz(visibility_fuzz SOURCES visibility_fuzz.cpp LIBRARIES lod)
