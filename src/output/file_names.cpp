// SPDX-License-Identifier: BSD-3-Clause
#include "output/file_names.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "output/error.hpp"
#include "output/hdf5_handle.hpp"

namespace engrane::output {

namespace {

[[noreturn]] void fail(const std::string& path) { throw OutputError(path, std::strerror(errno)); }

/// A text attribute of the root, empty when it has none.
std::string root_attribute(hid_t file, const char* name) {
  const hdf5::Handle attribute(H5Aexists(file, name) > 0 ? H5Aopen(file, name, H5P_DEFAULT) : -1);
  if (attribute.id() < 0) return "";
  const hdf5::Handle type(H5Aget_type(attribute.id()));
  if (H5Tis_variable_str(type.id()) <= 0) return "";
  char* text = nullptr;
  if (H5Aread(attribute.id(), type.id(), &text) < 0 || !text) return "";
  std::string result(text);
  H5free_memory(text);
  return result;
}

}  // namespace

bool worth_keeping(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || status.st_size == 0) return false;
  hdf5::prepare();
  const hdf5::Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_file_locking(access.id(), false, true);
  const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()));
  if (file.id() < 0) return true;
  return root_attribute(file.id(), "format") != "engrane" || root_attribute(file.id(), "status") == "complete";
}

OutputName::OutputName(std::string prefix) : prefix_(std::move(prefix)), partial_(worth_keeping(prefix_ + ".h5")) {}

FileLock::FileLock(const std::string& path) : descriptor_(open(path.c_str(), O_RDWR | O_CLOEXEC)) {
  if (descriptor_ < 0) return;
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  // a byte far outside: HDF5 readers lock their files too, and are welcome
  lock.l_start = off_t{1} << 60;
  lock.l_len = 1;
  if (fcntl(descriptor_, F_OFD_SETLK, &lock) != 0 && (errno == EAGAIN || errno == EACCES)) {
    ::close(std::exchange(descriptor_, -1));
    throw OutputError(path, "another run is writing it");
  }
}
FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}
FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

void rename_over(const std::string& from, const std::string& to) {
  if (rename(from.c_str(), to.c_str()) != 0) fail(to);
}

void exchange_names(const std::string& a, const std::string& b) {
  // some network file systems do not know this call
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) != 0) exchange_names_by_links(a, b);
}

void exchange_names_by_links(const std::string& a, const std::string& b) {
  // with a second name for `a`, `b` can take its place without a gap
  const std::string second = b + "~";
  unlink(second.c_str());
  if (link(a.c_str(), second.c_str()) != 0 && rename(a.c_str(), second.c_str()) != 0) fail(a);
  rename_over(b, a);
  rename_over(second, b);
}

void replace_text(const std::string& path, std::string_view text) {
  const std::string temporary = path + "~";
  std::FILE* file = std::fopen(temporary.c_str(), "w");
  if (!file) fail(path);
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if (std::fclose(file) != 0 || !written) {
    const int reason = errno;
    unlink(temporary.c_str());
    errno = reason;
    fail(path);
  }
  rename_over(temporary, path);
}

}  // namespace engrane::output
