// The program: the command line, with the built-in methods.
#include "experiments/commands/command_line.h"

int main(int argc, char** argv) { return terrabench::command_line(argc, argv); }
