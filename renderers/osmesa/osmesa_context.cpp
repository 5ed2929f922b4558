#include <array>
#include <cstdint>

#include "renderers/contexts.h"
#include "renderers/gl.h"
#include "terrain/machine_error.h"

namespace terrabench {
namespace {

constexpr const char* kAdvice = "install Debian's package libosmesa6, version 22 or newer";

// The four functions of GL/osmesa.h that are used, loaded at run time: a program linked to libOSMesa would
// take all gl* functions from it, which are wrong for other contexts in the process.
struct Library {
  explicit Library(const char* path) : from(path, "the software renderer is not installed", kAdvice) {}

  SharedLibrary from;
  using Handle = struct OsmesaContext*;
  Handle (*create)(const int* attributes, Handle share) = from["OSMesaCreateContextAttribs"];
  void (*destroy)(Handle) = from["OSMesaDestroyContext"];
  GLboolean (*make_current)(Handle, void* pixels, GLenum type, GLsizei width,
                            GLsizei height) = from["OSMesaMakeCurrent"];
  GLADloadfunc get_function = from["OSMesaGetProcAddress"];
};

class OsmesaContext final : public GlContext {
 public:
  explicit OsmesaContext(const Library& library) : library_(library), handle_(create(library)) {}
  ~OsmesaContext() override {
    close_target();
    library_.destroy(handle_);
  }

 private:
  static Library::Handle create(const Library& library) {
    // Names and values of GL/osmesa.h. No depth bits: RenderTarget has its own.
    constexpr int kFormat = 0x22, kDepthBits = 0x30, kProfile = 0x33, kCoreProfile = 0x34, kMajor = 0x36,
                  kMinor = 0x37;
    const int attributes[] = {kFormat, GL_RGBA, kDepthBits, 0, kProfile, kCoreProfile,
                              kMajor,  4,       kMinor,     5, 0};
    const Library::Handle handle = library.create(attributes, nullptr);
    if (handle == nullptr) throw MachineError("Mesa does not provide OpenGL 4.5", "OSMesa", kAdvice);
    return handle;
  }

  void acquire() override {
    if (library_.make_current(handle_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == 0) {
      throw MachineError("the OpenGL context cannot be made current", "OSMesa", kAdvice);
    }
    load_gl(library_.get_function, "OSMesa");
  }
  void release() noexcept override { library_.make_current(nullptr, nullptr, 0, 0, 0); }

  Library library_;
  Library::Handle handle_;
  // OSMesa requires memory to draw into; it is not used, because RenderTarget has its own.
  std::array<std::uint8_t, 4> pixel_{};
};

}  // namespace

std::unique_ptr<GlContext> open_osmesa(int width, int height, const char* library) {
  return with_target(std::make_unique<OsmesaContext>(Library(library)), width, height);
}

}  // namespace terrabench

#ifdef __SANITIZE_ADDRESS__
// Mesa 22.3 leaks 160 bytes per closed context. Only blocks that libOSMesa itself allocated are suppressed,
// so that leaks of this program are still reported.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa.so"; }
#endif
