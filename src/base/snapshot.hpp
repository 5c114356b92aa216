// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace engrane {

/// The complete state of a run at one instant as named arrays of numbers, written and read back for a restart. Each owner saves
/// and loads under names of its own, such as `scheme/algorithmic`.
class Snapshot {
 public:
  void put(std::string name, std::vector<double> values) { arrays_[std::move(name)] = std::move(values); }
  void put(std::string name, double value) { put(std::move(name), std::vector<double>{value}); }

  bool has(std::string_view name) const { return arrays_.find(name) != arrays_.end(); }
  /// Throws std::out_of_range, naming the array, if it does not exist.
  const std::vector<double>& array(std::string_view name) const {
    const auto it = arrays_.find(name);
    if (it == arrays_.end()) throw std::out_of_range("the restart point has no '" + std::string(name) + "'");
    return it->second;
  }
  double number(std::string_view name) const { return array(name).at(0); }

  const std::map<std::string, std::vector<double>, std::less<>>& arrays() const { return arrays_; }

 private:
  std::map<std::string, std::vector<double>, std::less<>> arrays_;
};

}  // namespace engrane
