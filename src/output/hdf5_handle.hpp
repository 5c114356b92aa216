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

/// To be called before anything else of HDF5, as often as one likes. Turns off its printing of error stacks (what they
/// tell goes into an OutputError) and its clean-up at exit.
void prepare();

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
struct Place {
  hid_t id;
  const std::string& file;

  Handle group(const std::string& name) const;
  void attribute(const char* name, const std::string& text) const;  ///< variable-length UTF-8, replaced when there
  void attribute(const char* name, double number) const;
  void attribute(const char* name, int number) const;
  Handle text(const std::string& name, const std::string& content) const;  ///< scalar, variable-length UTF-8
  Handle numbers(const std::string& name, std::span<const double> values, std::span<const hsize_t> shape) const;
  Handle integers(const std::string& name, std::span<const std::int32_t> values) const;
};

}  // namespace engrane::output::hdf5
