// The angle of ground whose unit normal has this y, in degrees: the hybrid paper prints (1 - y)·90 (§4.1), which
// is not the true angle.
float slope_degrees(float y, bool printed) { return printed ? (1.0 - y) * 90.0 : degrees(acos(clamp(y, -1.0, 1.0))); }
