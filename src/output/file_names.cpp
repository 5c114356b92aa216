// SPDX-License-Identifier: BSD-3-Clause
#include "output/file_names.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "output/error.hpp"
#include "output/hdf5_handle.hpp"

namespace engrane::output {

namespace {

[[noreturn]] void fail(const std::string& path) { throw OutputError(path, std::strerror(errno)); }

}  // namespace

bool worth_keeping(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || status.st_size == 0) return false;
  const hdf5::Handle file = hdf5::open_for_reading(path);
  if (file.id() < 0) return true;
  return hdf5::read_text_attribute(file.id(), "format") != "engrane" ||
         hdf5::read_text_attribute(file.id(), "status") == "complete";
}

namespace {

/// The longest of the names that a run may give to a file: see OutputName and replace_text().
constexpr std::string_view longest_ending = ".partial.xdmf~";

/// Throws OutputError if something else than a file has the name.
void refuse_other_than_file(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode) || S_ISCHR(status.st_mode)) return;
  throw OutputError(path, S_ISDIR(status.st_mode) ? std::strerror(EISDIR) : "it is no regular file");
}

}  // namespace

void test_places(const std::string& prefix) {
  const std::string shown = prefix + ".h5", name = std::filesystem::path(prefix).filename().string();
  std::string folder = std::filesystem::path(prefix).parent_path().string();
  if (folder.empty()) folder = ".";
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0)
    throw OutputError(shown, errno == ENOENT ? "there is no folder " + folder : std::strerror(errno));
  if (!S_ISDIR(status.st_mode)) throw OutputError(shown, folder + " is no folder");
  const long limit = pathconf(folder.c_str(), _PC_NAME_MAX);
  const auto most = (limit > 0 ? static_cast<std::size_t>(limit) : NAME_MAX) - longest_ending.size();
  if (name.size() > most)
    throw OutputError(
        shown, fmt::format("its name without ending has {} bytes, and {} are possible: -o gives another", name.size(), most));
  refuse_other_than_file(shown);  // first, as OutputName opens it
  const OutputName names(prefix);
  for (const char* extension : {".h5", ".h5~", ".xdmf", ".xdmf~", ".lst"}) {
    refuse_other_than_file(names.path(extension));
    refuse_other_than_file(names.final_path(extension));
  }
  // the listing is written in place, the others replace what has their names
  const std::string listing = names.path(".lst");
  if (access(listing.c_str(), W_OK) != 0 && errno != ENOENT) fail(listing);
  std::string trial = folder + "/.engrane-XXXXXX";
  const int file = mkostemp(trial.data(), O_CLOEXEC);
  if (file < 0) fail(shown);
  unlink(trial.c_str());
  ::close(file);
}

OutputName::OutputName(std::string prefix) : prefix_(std::move(prefix)), partial_(worth_keeping(prefix_ + ".h5")) {}

namespace {

/// Locks an open file; returns false if another process holds the lock. Succeeds if the file system has no locks.
bool take(int descriptor) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  // lock a byte far beyond the end: HDF5 readers lock their files too, and may read meanwhile
  lock.l_start = off_t{1} << 60;
  lock.l_len = 1;
  return fcntl(descriptor, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
}

/// Whether the open file still has this name.
bool is_called(int descriptor, const std::string& path) {
  struct stat open {
  }, named{};
  return fstat(descriptor, &open) == 0 && stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

}  // namespace

FileLock::FileLock(const std::string& path) : descriptor_(open(path.c_str(), O_RDWR | O_CLOEXEC)) {
  if (descriptor_ < 0 || take(descriptor_)) return;
  ::close(std::exchange(descriptor_, -1));
  throw OutputError(path, "another run is writing it");
}

FileLock FileLock::create(const std::string& path, const std::string& shown_as) {
  for (;;) {
    FileLock lock;
    lock.descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock.descriptor_ < 0) fail(shown_as);
    if (!take(lock.descriptor_)) throw OutputError(shown_as, "another run is writing it");
    // between opening and locking, another run may have renamed or removed the file
    if (is_called(lock.descriptor_, path)) return lock;
  }
}

void FileLock::sync(const std::string& path) const {
  if (descriptor_ >= 0 && fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail(path);
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}
FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

namespace {

/// Writes a whole block. A nearly full disk may first accept only part of it.
bool write_all(int file, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(file, data, size);
    if (written < 0) return false;
    data += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

void copy_contents(const std::string& from, const std::string& to, const std::string& shown_as) {
  const int source = open(from.c_str(), O_RDONLY | O_CLOEXEC), target = open(to.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  bool good = source >= 0 && target >= 0;
  std::vector<char> block(std::size_t{1} << 20);
  for (ssize_t size = 1; good && size > 0;) {
    size = read(source, block.data(), block.size());
    good = size >= 0 && write_all(target, block.data(), static_cast<std::size_t>(size));
  }
  const int reason = errno;
  if (source >= 0) ::close(source);
  if (target >= 0 && ::close(target) != 0) good = false;
  errno = reason;
  if (!good) fail(shown_as);
}

void rename_over(const std::string& from, const std::string& to) {
  if (rename(from.c_str(), to.c_str()) != 0) fail(to);
}

void exchange_names(const std::string& a, const std::string& b) {
  // some network file systems do not support this call
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) != 0) exchange_names_by_links(a, b);
}

void exchange_names_by_links(const std::string& a, const std::string& b) {
  // with a second link to `a`, `b` can take its name without a gap
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
