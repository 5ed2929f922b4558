#include "renderers/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "terrain/machine_error.h"

namespace terrabench {

SharedLibrary::SharedLibrary(const char* path, std::string_view missing, const char* advice)
    : path_(path), advice_(advice), handle_(dlopen(path, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) throw MachineError(missing, path, advice);
}

SharedLibrary::Symbol SharedLibrary::operator[](const char* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) {
    throw MachineError(fmt::format("the library lacks the function {}", name), path_, advice_);
  }
  return {found};
}

}  // namespace terrabench
