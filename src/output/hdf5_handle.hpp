// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <span>
#include <string>
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
  /// Gives the identifier up without closing it.
  hid_t release() { return std::exchange(id_, -1); }
  void close() {
    if (id_ >= 0) H5Idec_ref(std::exchange(id_, -1));
  }

 private:
  hid_t id_ = -1;
};

/// To be called before anything else of HDF5, as often as one likes, and once before MPI starts: a library that finds MPI
/// running closes what is open when MPI ends, and crashes on a file that a full disk kept it from closing. Turns off its printing
/// of error stacks (what they tell goes into an OutputError) and its clean-up at exit.
void prepare();

/// Opens a file for reading, without locks. An invalid handle when it cannot.
Handle open_for_reading(const std::string& path);

/// Access as all our files have it: a format that every reader knows, no locks, nothing left open behind the file.
Handle file_access(const std::string& path);

/// Why the last call failed: the operating system's reason when there is one, else the innermost message of HDF5.
std::string reason_of_failure();

/// Throws OutputError about `path` when `status` (an identifier or a return code) is negative; returns it otherwise.
template <class Status>
Status check(Status status, const std::string& path);
[[noreturn]] void fail(const std::string& path);

template <class Status>
Status check(Status status, const std::string& path) {
  if (status < 0) fail(path);
  return status;
}

/// A place in a file to write small things to; `file` is its name for messages. All throw OutputError.
///
/// Arrays and texts of a few pages and more are compressed (shuffle, deflate), smaller ones stand in their object's header.
struct Place {
  hid_t id;
  const std::string& file;

  Handle group(const std::string& name) const;
  void attribute(const char* name, const std::string& text) const;  ///< variable-length UTF-8, replaced when there
  void attribute(const char* name, double number) const;
  void attribute(const char* name, int number) const;
  Handle text(const std::string& name, const std::string& content) const;              ///< one fixed-length UTF-8 string
  Handle texts(const std::string& name, std::span<const std::string> contents) const;  ///< fixed-length UTF-8
  Handle numbers(const std::string& name, std::span<const double> values, std::span<const hsize_t> shape) const;
  Handle plain_numbers(const std::string& name, std::span<const double> values) const;  ///< never compressed: to be written over
  Handle integers(const std::string& name, std::span<const std::int32_t> values) const;
};

/// What a place holds; reading never throws. All numbers of a dataset, nothing when there is none or it cannot be read.
std::vector<double> read_numbers(hid_t place, const std::string& name);
/// The same of whole numbers, nothing when they are of another type or do not fit.
std::vector<std::int32_t> read_integers(hid_t place, const std::string& name);
std::vector<std::string> read_texts(hid_t place, const std::string& name);
/// A text attribute, empty when there is none; a number, `missing` when there is none.
std::string read_text_attribute(hid_t object, const char* name);
double read_number_attribute(hid_t object, const char* name, double missing);
/// Extents of a dataset, nothing when there is none.
std::vector<hsize_t> read_shape(hid_t place, const std::string& name);

}  // namespace engrane::output::hdf5
