// For test programs that read the claims files: declares the methods, as the program does at start-up.
#include "experiments/method_sets.h"

namespace {

const bool kDeclared = (terrabench::declare_methods(), true);

}  // namespace
