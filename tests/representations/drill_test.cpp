#include <gtest/gtest.h>
TEST(Drill, Starts) { SUCCEED(); }
