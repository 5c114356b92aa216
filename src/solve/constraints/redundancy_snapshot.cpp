// SPDX-License-Identifier: BSD-3-Clause
// Result of an analysis of the constraints, as numbers.
#include "solve/constraints/mobility.hpp"

namespace engrane::solve {

void Redundancy::save(Snapshot& snapshot) const {
  const Mobility& m = mobility_;
  snapshot.put("redundancy/counts",
               std::vector<double>{m.analysed ? 1.0 : 0.0, static_cast<double>(m.motions), static_cast<double>(m.constraints),
                                   static_cast<double>(m.rank), static_cast<double>(m.lost_here)});
  snapshot.put("redundancy/dependent", {m.dependent.begin(), m.dependent.end()});
  // one after another: redundant, widest, open, relative, number of members, members
  std::vector<double> groups;
  for (const RedundantGroup& one : m.groups) {
    groups.insert(groups.end(), {static_cast<double>(one.redundant), static_cast<double>(one.widest), one.open, one.relative,
                                 static_cast<double>(one.members.size())});
    groups.insert(groups.end(), one.members.begin(), one.members.end());
  }
  snapshot.put("redundancy/groups", std::move(groups));
  // rows, columns, then row, column and value of every entry
  std::vector<double> null{static_cast<double>(m.null.rows()), static_cast<double>(m.null.cols())};
  for (int column = 0; column < m.null.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(m.null, column); entry; ++entry)
      null.insert(null.end(), {static_cast<double>(entry.row()), static_cast<double>(column), entry.value()});
  snapshot.put("redundancy/null", std::move(null));
}

void Redundancy::load(const Snapshot& snapshot) {
  const std::vector<double>& counts = snapshot.array("redundancy/counts");
  Mobility m;
  m.analysed = counts.at(0) != 0;
  m.motions = static_cast<int>(counts.at(1));
  m.constraints = static_cast<int>(counts.at(2));
  m.rank = static_cast<int>(counts.at(3));
  m.lost_here = static_cast<int>(counts.at(4));
  for (const double multiplier : snapshot.array("redundancy/dependent")) m.dependent.push_back(static_cast<int>(multiplier));
  const std::vector<double>& groups = snapshot.array("redundancy/groups");
  for (std::size_t i = 0; i < groups.size();) {
    RedundantGroup one;
    one.redundant = static_cast<int>(groups.at(i));
    one.widest = static_cast<int>(groups.at(i + 1));
    one.open = groups.at(i + 2);
    one.relative = groups.at(i + 3);
    const auto members = static_cast<std::size_t>(groups.at(i + 4));
    i += 5;
    for (std::size_t k = 0; k < members; ++k) one.members.push_back(static_cast<int>(groups.at(i++)));
    m.groups.push_back(std::move(one));
  }
  const std::vector<double>& null = snapshot.array("redundancy/null");
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 2; i + 2 < null.size(); i += 3)
    entries.emplace_back(static_cast<int>(null[i]), static_cast<int>(null[i + 1]), null[i + 2]);
  m.null.resize(static_cast<Eigen::Index>(null.at(0)), static_cast<Eigen::Index>(null.at(1)));
  m.null.setFromTriplets(entries.begin(), entries.end());
  mobility_ = std::move(m);
}

}  // namespace engrane::solve
