// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/redundancy_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <unordered_map>
#include <vector>

namespace engrane::solve {

namespace {

/// One way of changing an element, and the multipliers that this gives up.
struct Cure {
  std::string becomes;
  std::vector<Eigen::Index> rows;
  std::string released;
};

std::vector<Cure> cures_of(const Assembler& assembler, int part) {
  const Model::Part& p = assembler.model().parts[static_cast<std::size_t>(part)];
  const Eigen::Index begin = assembler.numbering().multiplier_begin(part);
  std::vector<Cure> cures;
  for (const Release& release : p.element->releases()) {
    Cure cure{fmt::format(fmt::runtime(release.change), p.name()), {}, release.what};
    for (const int m : release.multipliers) cure.rows.push_back(begin + m);
    cures.push_back(std::move(cure));
  }
  return cures;
}

std::vector<Eigen::Index> more_than(const std::vector<Eigen::Index>& all, const std::vector<Eigen::Index>& some) {
  std::vector<Eigen::Index> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
  return rest;
}

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A growing set of independent sparse rows, as an echelon form: each row is free of the leading columns of those before it.
class IndependentRows {
 public:
  /// Adds these rows of `all` and returns true if the set remains independent; otherwise leaves it as it is.
  bool add(const Rows& all, const std::vector<Eigen::Index>& rows) {
    const std::size_t before = echelon_.size();
    for (const Eigen::Index row : rows)
      if (!add(all, row)) {
        for (; echelon_.size() > before; echelon_.pop_back()) place_.erase(echelon_.back().leading);
        return false;
      }
    return true;
  }

 private:
  struct Row {
    Eigen::Index leading;
    std::map<Eigen::Index, double> others;  ///< by column; the leading entry is 1
  };

  bool add(const Rows& all, Eigen::Index row) {
    std::map<std::size_t, double> known;       // entries in leading columns, by the place of their row
    std::map<Eigen::Index, double> remainder;  // in other columns
    const auto put = [&](Eigen::Index column, double value) {
      const auto found = place_.find(column);
      (found == place_.end() ? remainder[column] : known[found->second]) += value;
    };
    double size = 0;
    for (Rows::InnerIterator it(all, row); it; ++it) {
      size = std::max(size, std::abs(it.value()));
      put(it.col(), it.value());
    }
    while (!known.empty()) {
      const auto [place, value] = *known.begin();
      known.erase(known.begin());
      if (std::abs(value) <= negligible * size) continue;
      for (const auto& [column, entry] : echelon_[place].others) put(column, -value * entry);
    }
    std::erase_if(remainder, [&](const auto& entry) { return std::abs(entry.second) <= negligible * size; });
    const auto smaller = [](const auto& a, const auto& b) { return std::abs(a.second) < std::abs(b.second); };
    const auto largest = std::max_element(remainder.begin(), remainder.end(), smaller);
    if (largest == remainder.end() || std::abs(largest->second) < dependent * size) return false;
    const auto [leading, pivot] = *largest;
    remainder.erase(largest);
    for (auto& entry : remainder) entry.second /= pivot;
    place_[leading] = echelon_.size();
    echelon_.push_back({leading, std::move(remainder)});
    return true;
  }

  static constexpr double negligible = 1e-13, dependent = 1e-7;
  std::vector<Row> echelon_;
  std::unordered_map<Eigen::Index, std::size_t> place_;  ///< of the row with this leading column
};

}  // namespace

std::string suggest_releases(const Assembler& assembler, const Eigen::SparseMatrix<double>& null) {
  const Eigen::Index needed = null.cols();
  const auto parts = static_cast<int>(assembler.model().parts.size());
  std::vector<Cure> chosen(static_cast<std::size_t>(parts));
  Eigen::Index given_up = 0;
  // scale the columns to size 1: their sizes depend on units and lengths
  Rows rows = null;
  Eigen::VectorXd size = Eigen::VectorXd::Constant(needed, 1e-300);
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Rows::InnerIterator it(rows, i); it; ++it) size[it.col()] = std::max(size[it.col()], std::abs(it.value()));
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Rows::InnerIterator it(rows, i); it; ++it) it.valueRef() /= size[it.col()];
  IndependentRows taken;
  // a second pass may change a joint further than the first has done
  for (int pass = 0; pass < 2; ++pass)
    for (int p = parts; p-- > 0 && given_up < needed;) {
      Cure& mine = chosen[static_cast<std::size_t>(p)];
      for (const Cure& cure : cures_of(assembler, p)) {
        const auto more = static_cast<Eigen::Index>(cure.rows.size() - mine.rows.size());
        if (more <= 0 || given_up + more > needed) continue;
        if (!std::includes(cure.rows.begin(), cure.rows.end(), mine.rows.begin(), mine.rows.end())) continue;
        if (!taken.add(rows, more_than(cure.rows, mine.rows))) continue;
        given_up += more;
        mine = cure;
        break;
      }
    }
  std::string text;
  constexpr int most = 6;
  int listed = 0;
  for (const Cure& cure : chosen) {
    if (cure.rows.empty()) continue;
    if (listed++ >= most) continue;
    text += fmt::format("{}{}{}", text.empty() ? "" : "; ", cure.becomes,
                        cure.released.empty() ? "" : fmt::format(" (releases {})", cure.released));
  }
  if (listed > most) text += fmt::format("; and {} more such changes", listed - most);
  if (!text.empty() && given_up < needed) text += fmt::format("; {} redundant remain, without a simple cure", needed - given_up);
  return text;
}

}  // namespace engrane::solve
