// The whole command line, for programs that add methods of their own first (examples/own_method.cpp).
#pragma once

namespace terrabench {

// What main() returns. To be called once.
int command_line(int argc, char** argv);

}  // namespace terrabench
