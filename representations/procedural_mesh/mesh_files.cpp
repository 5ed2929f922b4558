#include "representations/procedural_mesh/mesh_files.h"

#include <fmt/format.h>

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/exporter/ExporterT.hh>
#include <OpenMesh/Core/IO/importer/ImporterT.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/IO/writer/OBJWriter.hh>
#include <OpenMesh/Core/IO/writer/PLYWriter.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <cctype>
#include <fstream>
#include <mutex>

#include "terrain/error.h"
#include "terrain/files.h"
#include "terrain/machine_error.h"

namespace terrabench {
namespace {

namespace om = OpenMesh;
using om::FaceHandle;
using om::VertexHandle;

// OpenMesh's own mesh takes no face at an edge with two others. It stays empty, so that whatever a FaceMesh
// does not hold is lost.
using NoMesh = om::PolyMesh_ArrayKernelT<>;
struct Empty {
  NoMesh no_mesh;
};

// Receives what OpenMesh's readers find, straight into flat arrays.
class Importer final : Empty, public om::IO::ImporterT<NoMesh> {
 public:
  explicit Importer(const std::string& origin) : ImporterT(no_mesh), origin_(origin) {
    mesh.first_corner = {0};
  }

  using ImporterT::add_face, ImporterT::add_face_texcoords, ImporterT::add_vertex, ImporterT::set_texcoord;
  void reserve(unsigned vertices, unsigned, unsigned faces) override {
    mesh.positions.reserve(vertices);
    mesh.first_corner.reserve(faces + std::size_t{1});
  }
  VertexHandle add_vertex() override { return add_vertex(om::Vec3f(0)); }
  VertexHandle add_vertex(const om::Vec3f& p) override {
    mesh.positions.push_back({p[0], p[1], p[2]});
    return VertexHandle(static_cast<int>(mesh.positions.size() - 1));
  }
  void set_point(VertexHandle v, const om::Vec3f& p) override {
    mesh.positions[static_cast<std::size_t>(v.idx())] = {p[0], p[1], p[2]};
  }
  FaceHandle add_face(const VHandles& corners) override {
    for (const VertexHandle v : corners) {
      if (v.idx() < 0 || static_cast<std::size_t>(v.idx()) >= mesh.positions.size()) {
        throw bad_input(fmt::format("a corner at vertex {} of {}", v.idx(), mesh.positions.size()), origin_,
                        "write the file again, or check it with another program");
      }
      mesh.corners.push_back(static_cast<std::uint32_t>(v.idx()));
    }
    mesh.first_corner.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    return FaceHandle(static_cast<int>(mesh.faces() - 1));
  }
  void set_texcoord(VertexHandle v, const om::Vec2f& t) override {
    mesh.texture.resize(mesh.positions.size());
    mesh.texture[static_cast<std::size_t>(v.idx())] = {t[0], t[1]};
  }
  void set_texcoord(VertexHandle v, const om::Vec3f& t) override { set_texcoord(v, om::Vec2f(t[0], t[1])); }
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<om::Vec2f>&) override {}
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<om::Vec3f>&) override {}
  std::size_t n_vertices() const override { return mesh.positions.size(); }
  std::size_t n_faces() const override { return mesh.faces(); }

  FaceMesh mesh;

 private:
  const std::string& origin_;
};

// Shows flat arrays to OpenMesh's writers.
class Exporter final : Empty, public om::IO::ExporterT<NoMesh> {
 public:
  explicit Exporter(const FaceMesh& mesh) : ExporterT(no_mesh), mesh_(mesh) {}

  using ExporterT::texcoord;
  om::Vec3f point(VertexHandle v) const override {
    const glm::vec3 p = mesh_.positions[static_cast<std::size_t>(v.idx())];
    return {p.x, p.y, p.z};
  }
  om::Vec2f texcoord(VertexHandle v) const override {
    if (mesh_.texture.empty()) return om::Vec2f(0);  // the OBJ writer asks even then
    const glm::vec2 t = mesh_.texture[static_cast<std::size_t>(v.idx())];
    return {t.x, t.y};
  }
  unsigned int get_vhandles(FaceHandle f, std::vector<VertexHandle>& out) const override {
    out.clear();
    for (const std::uint32_t v : mesh_.face(static_cast<std::size_t>(f.idx()))) {
      out.emplace_back(static_cast<int>(v));
    }
    return static_cast<unsigned int>(out.size());
  }
  std::size_t n_vertices() const override { return mesh_.positions.size(); }
  std::size_t n_faces() const override { return mesh_.faces(); }
  bool has_vertex_texcoords() const override { return !mesh_.texture.empty(); }
  const om::BaseKernel* kernel() override { return &no_properties_; }  // asked by the PLY writer

 private:
  const FaceMesh& mesh_;
  om::BaseKernel no_properties_;
};

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".ply" && extension != ".obj") {
    throw usage_error(fmt::format("mesh files end in .ply or .obj, not '{}'", extension), path.string(),
                      "give the file one of these names");
  }
  return extension;
}

// OpenMesh's readers and writers are single objects with state, and tell of faults on streams of their own.
class OpenMeshUse {
 public:
  OpenMeshUse() : lock_(mutex()) {
    om::IO::PLYReader();  // makes sure that each is registered
    om::IO::OBJReader();
    om::IO::PLYWriter();
    om::IO::OBJWriter();
    omlog().disable();
    omout().disable();
    omerr().disable();
  }
  ~OpenMeshUse() {
    omerr().enable();
    omout().enable();
    omlog().enable();
  }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::lock_guard<std::mutex> lock_;
};

}  // namespace

void write_mesh(const std::filesystem::path& path, const FaceMesh& mesh) {
  const std::string extension = extension_of(path);
  om::IO::Options options;
  if (!mesh.texture.empty()) options += om::IO::Options::VertexTexCoord;
  if (extension == ".ply") options += om::IO::Options::Binary;
  NewFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  Exporter exporter(mesh);
  const OpenMeshUse use;
  const bool written = om::IO::IOManager().write(out, extension, exporter, options, 9);
  out.close();
  if (!written || !out) {
    throw MachineError("cannot write the mesh", path.string(),
                       "check the folder's permissions and the space left on its disk");
  }
  file.keep();
}

FaceMesh read_mesh(const std::filesystem::path& path) {
  const std::string extension = extension_of(path), origin = path.string();
  std::ifstream in(path, std::ios::binary);
  om::IO::Options options = om::IO::Options::VertexTexCoord;
  Importer importer(origin);
  const OpenMeshUse use;
  if (!in || !om::IO::IOManager().read(in, extension, importer, options)) {
    throw bad_input("OpenMesh cannot read the mesh", origin, "give a file that write_mesh() wrote");
  }
  return std::move(importer.mesh);
}

}  // namespace terrabench
