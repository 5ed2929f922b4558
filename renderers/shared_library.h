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

  // Of any function's type.
  struct Symbol {
    void* address;
    template <class Function>
    operator Function*() const {  // NOLINT(google-explicit-constructor): initialises pointers to functions
      return reinterpret_cast<Function*>(address);
    }
  };
  // The symbol of that name; throws environment_error if the library has none.
  Symbol operator[](const char* name) const;

 private:
  const char* path_;
  const char* advice_;
  void* handle_;
};

}  // namespace terrabench
