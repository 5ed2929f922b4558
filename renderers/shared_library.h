// A library that is opened at run time, so that the program starts without it and names the package to
// install.
#pragma once

#include <string_view>

namespace terrabench {

// Stays open until the process ends: Mesa keeps threads and exit handlers in its libraries. Its symbols are
// visible to this object only, because libOSMesa and libGL export the same gl* names.
class SharedLibrary {
 public:
  // `path` and `advice` must outlive the object. Throws environment_error with `missing` as what went wrong.
  SharedLibrary(const char* path, std::string_view missing, const char* advice);

  // Sets `function` to the symbol of that name; throws environment_error if the library has none.
  template <class Function>
  void find(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;

  const char* path_;
  const char* advice_;
  void* handle_;
};

}  // namespace terrabench
