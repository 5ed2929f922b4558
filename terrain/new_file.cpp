#include "terrain/new_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "terrain/machine_error.h"
#include "terrain/temporary_name.h"

namespace terrabench {
namespace {

MachineError cannot_write(const std::filesystem::path& path, int error) {
  return MachineError(fmt::format("cannot write: {}", std::strerror(error)), path.string(),
                      error == ENOSPC ? "free some space on the disk, or choose another folder with --out"
                                      : "check the folder's permissions, or choose another with --out");
}

}  // namespace

NewFile::NewFile(const std::filesystem::path& name) {
  std::error_code error;
  // Renaming over a link would replace the link, and over a device remove the device.
  const bool link = std::filesystem::is_symlink(name, error);
  path_ = link ? std::filesystem::weakly_canonical(name, error) : name;
  error.clear();  // a new file has no status yet
  const auto status = std::filesystem::status(path_, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    throw MachineError("cannot write: it is a folder or a device", path_.string(), "name a file");
  }
  error.clear();
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), error);
  if (error) throw cannot_write(path_, error.value());
  temporary_ = temporary_name(path_);
  descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) throw cannot_write(path_, errno);
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) close(descriptor_);
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void NewFile::append(std::span<const std::byte> content) {
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t written = write(descriptor_, content.data() + done, content.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw cannot_write(path_, errno);
    done += static_cast<std::size_t>(written);
  }
}

void NewFile::append(std::string_view content) {
  append(std::as_bytes(std::span(content.data(), content.size())));
}

void NewFile::keep() {
  // Opened anew, since a library may have put another file in its place.
  if (close(std::exchange(descriptor_, -1)) != 0) throw cannot_write(path_, errno);
  descriptor_ = open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw cannot_write(path_, errno);
  // A full disk may be reported only here.
  if (fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) throw cannot_write(path_, errno);
  if (close(std::exchange(descriptor_, -1)) != 0) throw cannot_write(path_, errno);
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw cannot_write(path_, errno);
  temporary_.clear();
}

}  // namespace terrabench
