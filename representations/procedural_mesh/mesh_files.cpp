#include "representations/procedural_mesh/mesh_files.h"

#include <fmt/format.h>

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/exporter/BaseExporter.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/IO/reader/OBJReader.hh>
#include <OpenMesh/Core/IO/reader/PLYReader.hh>
#include <OpenMesh/Core/IO/writer/OBJWriter.hh>
#include <OpenMesh/Core/IO/writer/PLYWriter.hh>
#include <OpenMesh/Core/Mesh/BaseKernel.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <mutex>
#include <sstream>

#include "representations/procedural_mesh/mesh_file_scan.h"
#include "terrain/files.h"
#include "terrain/machine_error.h"
#include "terrain/new_file.h"

namespace terrabench {
namespace {

namespace om = OpenMesh;
using om::EdgeHandle;
using om::FaceHandle;
using om::HalfedgeHandle;
using om::VertexHandle;
using om::Attributes::StatusInfo;

constexpr const char* kAdvice = "write the file again, or check it with another program";

// Receives what OpenMesh's readers find, straight into flat arrays.
class Importer final : public om::IO::BaseImporter {
 public:
  Importer(const ScannedMesh& scanned, const std::string& origin) : origin_(origin) {
    mesh.positions.reserve(scanned.vertices);
    mesh.corners.reserve(scanned.corners);
    mesh.first_corner.reserve(scanned.faces + 1);
    mesh.first_corner.push_back(0);
    if (scanned.has_texture) mesh.texture.resize(scanned.vertices);
  }

  VertexHandle add_vertex(const om::Vec3f& p) override {
    mesh.positions.push_back({p[0], p[1], p[2]});
    return VertexHandle(static_cast<int>(mesh.positions.size() - 1));
  }
  VertexHandle add_vertex() override { return add_vertex(om::Vec3f(0.0F)); }
  FaceHandle add_face(const VHandles& corners) override {
    const std::size_t first = mesh.corners.size(), face = mesh.first_corner.size() - 1;
    for (const VertexHandle v : corners) {
      if (v.idx() < 0 || static_cast<std::size_t>(v.idx()) >= mesh.positions.size()) {
        fail(face, fmt::format("a corner at vertex {} of {}", v.idx(), mesh.positions.size()));
      }
      mesh.corners.push_back(static_cast<std::uint32_t>(v.idx()));
    }
    sorted_.assign(mesh.corners.begin() + static_cast<std::ptrdiff_t>(first), mesh.corners.end());
    std::sort(sorted_.begin(), sorted_.end());
    if (std::adjacent_find(sorted_.begin(), sorted_.end()) != sorted_.end()) fail(face, "a vertex twice");
    mesh.first_corner.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    return FaceHandle(static_cast<int>(face));
  }
  void set_point(VertexHandle v, const om::Vec3f& p) override {
    if (auto* at = find(mesh.positions, v)) *at = {p[0], p[1], p[2]};
  }
  void set_texcoord(VertexHandle v, const om::Vec2f& t) override {
    if (auto* at = find(mesh.texture, v)) *at = {t[0], t[1]};
  }
  void set_texcoord(VertexHandle v, const om::Vec3f& t) override { set_texcoord(v, om::Vec2f(t[0], t[1])); }
  std::size_t n_vertices() const override { return mesh.positions.size(); }
  std::size_t n_faces() const override { return mesh.first_corner.size() - 1; }
  std::size_t n_edges() const override { return 0; }

  // What a FaceMesh does not hold.
  HalfedgeHandle add_edge(VertexHandle, VertexHandle) override { return HalfedgeHandle(); }
  FaceHandle add_face(HalfedgeHandle) override { return FaceHandle(); }
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<om::Vec2f>&) override {}
  void add_face_texcoords(FaceHandle, VertexHandle, const std::vector<om::Vec3f>&) override {}
  void set_face_texindex(FaceHandle, int) override {}
  void set_halfedge(VertexHandle, HalfedgeHandle) override {}
  void set_normal(VertexHandle, const om::Vec3f&) override {}
  void set_normal(VertexHandle, const om::Vec3d&) override {}
  void set_color(VertexHandle, const om::Vec3uc&) override {}
  void set_color(VertexHandle, const om::Vec4uc&) override {}
  void set_color(VertexHandle, const om::Vec3f&) override {}
  void set_color(VertexHandle, const om::Vec4f&) override {}
  void set_status(VertexHandle, const StatusInfo&) override {}
  void set_next(HalfedgeHandle, HalfedgeHandle) override {}
  void set_face(HalfedgeHandle, FaceHandle) override {}
  void request_face_texcoords2D() override {}
  void set_texcoord(HalfedgeHandle, const om::Vec2f&) override {}
  void set_texcoord(HalfedgeHandle, const om::Vec3f&) override {}
  void set_status(HalfedgeHandle, const StatusInfo&) override {}
  void set_color(EdgeHandle, const om::Vec3uc&) override {}
  void set_color(EdgeHandle, const om::Vec4uc&) override {}
  void set_color(EdgeHandle, const om::Vec3f&) override {}
  void set_color(EdgeHandle, const om::Vec4f&) override {}
  void set_status(EdgeHandle, const StatusInfo&) override {}
  void set_normal(FaceHandle, const om::Vec3f&) override {}
  void set_normal(FaceHandle, const om::Vec3d&) override {}
  void set_color(FaceHandle, const om::Vec3uc&) override {}
  void set_color(FaceHandle, const om::Vec4uc&) override {}
  void set_color(FaceHandle, const om::Vec3f&) override {}
  void set_color(FaceHandle, const om::Vec4f&) override {}
  void set_status(FaceHandle, const StatusInfo&) override {}
  void add_texture_information(int, std::string) override {}

  FaceMesh mesh;

 private:
  template <class T>
  static T* find(std::vector<T>& values, VertexHandle v) {
    return v.idx() >= 0 && static_cast<std::size_t>(v.idx()) < values.size() ? &values[v.idx()] : nullptr;
  }
  [[noreturn]] void fail(std::size_t face, const std::string& what) const {
    throw bad_input(what, fmt::format("{}, face {}", origin_, face), kAdvice);
  }

  const std::string& origin_;
  std::vector<std::uint32_t> sorted_;
};

// Shows flat arrays to OpenMesh's writers.
class Exporter final : public om::IO::BaseExporter {
 public:
  explicit Exporter(const FaceMesh& mesh) : mesh_(mesh) {}

  om::Vec3f point(VertexHandle v) const override {
    const glm::vec3 p = mesh_.positions[static_cast<std::size_t>(v.idx())];
    return {p.x, p.y, p.z};
  }
  om::Vec3d pointd(VertexHandle v) const override { return om::Vec3d(point(v)); }
  bool is_point_double() const override { return false; }
  om::Vec2f texcoord(VertexHandle v) const override {
    if (mesh_.texture.empty()) return om::Vec2f(0);  // the OBJ writer asks even then
    const glm::vec2 t = mesh_.texture[static_cast<std::size_t>(v.idx())];
    return {t.x, t.y};
  }
  unsigned int get_vhandles(FaceHandle f, std::vector<VertexHandle>& out) const override {
    const auto face = static_cast<std::size_t>(f.idx());
    out.clear();
    for (std::uint32_t c = mesh_.first_corner[face]; c < mesh_.first_corner[face + 1]; ++c) {
      out.emplace_back(static_cast<int>(mesh_.corners[c]));
    }
    return static_cast<unsigned int>(out.size());
  }
  std::size_t n_vertices() const override { return mesh_.positions.size(); }
  std::size_t n_faces() const override { return mesh_.faces(); }
  std::size_t n_edges() const override { return 0; }
  bool has_vertex_texcoords() const override { return !mesh_.texture.empty(); }
  const om::BaseKernel* kernel() override { return &no_properties_; }  // asked by the PLY writer

  // What a FaceMesh does not hold.
  om::Vec3f normal(VertexHandle) const override { return om::Vec3f(0); }
  om::Vec3d normald(VertexHandle) const override { return om::Vec3d(0); }
  bool is_normal_double() const override { return false; }
  om::Vec3uc color(VertexHandle) const override { return om::Vec3uc(0); }
  om::Vec4uc colorA(VertexHandle) const override { return om::Vec4uc(0); }
  om::Vec3ui colori(VertexHandle) const override { return om::Vec3ui(0); }
  om::Vec4ui colorAi(VertexHandle) const override { return om::Vec4ui(0); }
  om::Vec3f colorf(VertexHandle) const override { return om::Vec3f(0); }
  om::Vec4f colorAf(VertexHandle) const override { return om::Vec4f(0); }
  om::Vec2f texcoord(HalfedgeHandle) const override { return om::Vec2f(0); }
  StatusInfo status(VertexHandle) const override { return {}; }
  HalfedgeHandle getHeh(FaceHandle, VertexHandle) const override { return HalfedgeHandle(); }
  unsigned int get_face_texcoords(std::vector<om::Vec2f>&) const override { return 0; }
  om::Vec3f normal(FaceHandle) const override { return om::Vec3f(0); }
  om::Vec3d normald(FaceHandle) const override { return om::Vec3d(0); }
  om::Vec3uc color(FaceHandle) const override { return om::Vec3uc(0); }
  om::Vec4uc colorA(FaceHandle) const override { return om::Vec4uc(0); }
  om::Vec3ui colori(FaceHandle) const override { return om::Vec3ui(0); }
  om::Vec4ui colorAi(FaceHandle) const override { return om::Vec4ui(0); }
  om::Vec3f colorf(FaceHandle) const override { return om::Vec3f(0); }
  om::Vec4f colorAf(FaceHandle) const override { return om::Vec4f(0); }
  StatusInfo status(FaceHandle) const override { return {}; }
  om::Vec3uc color(EdgeHandle) const override { return om::Vec3uc(0); }
  om::Vec4uc colorA(EdgeHandle) const override { return om::Vec4uc(0); }
  om::Vec3ui colori(EdgeHandle) const override { return om::Vec3ui(0); }
  om::Vec4ui colorAi(EdgeHandle) const override { return om::Vec4ui(0); }
  om::Vec3f colorf(EdgeHandle) const override { return om::Vec3f(0); }
  om::Vec4f colorAf(EdgeHandle) const override { return om::Vec4f(0); }
  StatusInfo status(EdgeHandle) const override { return {}; }
  int get_halfedge_id(VertexHandle) override { return -1; }
  int get_halfedge_id(FaceHandle) override { return -1; }
  int get_next_halfedge_id(HalfedgeHandle) override { return -1; }
  int get_to_vertex_id(HalfedgeHandle) override { return -1; }
  int get_face_id(HalfedgeHandle) override { return -1; }
  StatusInfo status(HalfedgeHandle) const override { return {}; }

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

void check_arrays(const FaceMesh& mesh, const std::string& where) {
  const auto fail = [&](std::string_view what) {
    throw bad_input(what, where, "check the mesh before it is written");
  };
  if (!mesh.texture.empty() && mesh.texture.size() != mesh.positions.size())
    fail("texture coordinates are missing");
  std::uint32_t corner = 0;
  for (const std::uint32_t next : mesh.first_corner) {
    if (next < corner || next > mesh.corners.size()) fail("a face's corners are out of range");
    corner = next;
  }
  for (const std::uint32_t v : mesh.corners) {
    if (v >= mesh.positions.size()) fail("a corner's vertex is out of range");
  }
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const FaceMesh& mesh, PlyForm form) {
  const std::string extension = extension_of(path);
  check_arrays(mesh, path.string());
  om::IO::Options options;
  if (!mesh.texture.empty()) options += om::IO::Options::VertexTexCoord;
  if (extension == ".ply" && form == PlyForm::kBinary) options += om::IO::Options::Binary;
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

FaceMesh read_mesh(const std::filesystem::path& path, std::uint64_t limit) {
  const std::string extension = extension_of(path), origin = path.string();
  std::string bytes = read_file(path, limit);
  ScannedMesh scanned = extension == ".ply" ? scan_ply(bytes, origin) : scan_obj(bytes, origin);
  std::istringstream in(extension == ".ply" ? std::move(bytes) : std::move(scanned.text));
  om::IO::Options options;
  if (scanned.has_texture) options += om::IO::Options::VertexTexCoord;
  Importer importer(scanned, origin);
  const OpenMeshUse use;
  const bool read = om::IO::IOManager().read(in, extension, importer, options);
  if (!read || importer.mesh.positions.size() != scanned.vertices || importer.mesh.faces() != scanned.faces ||
      importer.mesh.corners.size() != scanned.corners) {
    throw bad_input("OpenMesh could not read the mesh", origin, kAdvice);
  }
  return std::move(importer.mesh);
}

}  // namespace terrabench
