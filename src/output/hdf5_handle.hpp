// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace engrane::output::hdf5 {

/// Owns an HDF5 identifier of any kind and closes it.
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  ~Handle() { close(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      close();
      id_ = std::exchange(other.id_, -1);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  hid_t id() const { return id_; }
  /// Gives up the identifier without closing it.
  hid_t release() { return std::exchange(id_, -1); }
  void close() {
    if (id_ >= 0) H5Idec_ref(std::exchange(id_, -1));
  }

 private:
  hid_t id_ = -1;
};

/// Must be called before any other use of HDF5, and once before MPI starts; may be called repeatedly. If HDF5 finds MPI
/// running, it closes open files when MPI ends, and crashes on a file that it could not close because the disk was full.
/// Disables the printing of error stacks (OutputError reports them) and HDF5's clean-up at exit.
void prepare();

/// Opens a file for reading, without locks. Returns an invalid handle on failure.
Handle open_for_reading(const std::string& path);

/// File access properties for all our files: a format that every reader knows, no locks, and closing a file closes everything
/// in it.
Handle file_access(const std::string& path);

/// Reason for the last failure: that of the operating system if there is one, otherwise the innermost message of HDF5.
std::string reason_of_failure();

/// Throws OutputError about `path` if `status` (an identifier or a return code) is negative; otherwise returns it.
template <class Status>
Status check(Status status, const std::string& path);
[[noreturn]] void fail(const std::string& path);

template <class Status>
Status check(Status status, const std::string& path) {
  if (status < 0) fail(path);
  return status;
}

/// Valid UTF-8 with the same characters: a byte that is not part of any is read as Latin-1, as decks may be. Unlike printable(),
/// it keeps control characters, so that a deck read back is the same.
std::string utf8(std::string_view text);

/// A location in a file (a group, or an object with attributes) for writing small items. `file` is the file name for messages.
/// All members throw OutputError on failure. Texts are stored as UTF-8, whatever the deck is in.
///
/// Arrays and texts larger than 4 KiB are compressed (shuffle, deflate) where this saves enough; smaller ones are stored in the
/// header of their object.
struct Place {
  hid_t id;
  const std::string& file;

  Handle group(const std::string& name) const;
  void attribute(const char* name, const std::string& text) const;  ///< variable-length UTF-8, replaces an existing one
  void attribute(const char* name, double number) const;
  void attribute(const char* name, int number) const;
  Handle text(const std::string& name, const std::string& content) const;              ///< one fixed-length UTF-8 string
  Handle texts(const std::string& name, std::span<const std::string> contents) const;  ///< fixed-length UTF-8
  Handle numbers(const std::string& name, std::span<const double> values, std::span<const hsize_t> shape) const;
  Handle plain_numbers(const std::string& name, std::span<const double> values) const;  ///< never compressed: to be overwritten
  Handle integers(const std::string& name, std::span<const std::int32_t> values) const;
};

/// Reading never throws. Returns all numbers of a dataset; empty if there is none or it cannot be read.
std::vector<double> read_numbers(hid_t place, const std::string& name);
/// As above for integers; empty if they have another type or do not fit.
std::vector<std::int32_t> read_integers(hid_t place, const std::string& name);
std::vector<std::string> read_texts(hid_t place, const std::string& name);
/// Returns a text attribute, empty if there is none; or a number, `missing` if there is none.
std::string read_text_attribute(hid_t object, const char* name);
double read_number_attribute(hid_t object, const char* name, double missing);
/// Extents of a dataset, empty if there is none.
std::vector<hsize_t> read_shape(hid_t place, const std::string& name);

}  // namespace engrane::output::hdf5
