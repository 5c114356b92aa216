// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/redundancy_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    Cure cure{fmt::format(fmt::runtime(release.change), fmt::format("{} {}", p.type, p.element->id())), {}, release.what};
    for (const int m : release.multipliers) cure.rows.push_back(begin + m);
    cures.push_back(std::move(cure));
  }
  return cures;
}

}  // namespace

std::string suggest_releases(const Assembler& assembler, const Eigen::MatrixXd& null) {
  const Eigen::Index needed = null.cols();
  const auto parts = static_cast<int>(assembler.model().parts.size());
  std::vector<Cure> chosen(static_cast<std::size_t>(parts));
  Eigen::Index given_up = 0;
  // sizes of the rows say nothing: units and lengths are in them
  Eigen::MatrixXd scaled = null;
  for (Eigen::Index j = 0; j < needed; ++j) scaled.col(j) /= std::max(scaled.col(j).lpNorm<Eigen::Infinity>(), 1e-300);
  const auto independent = [&](const std::vector<Eigen::Index>& rows) {
    Eigen::MatrixXd picked(static_cast<Eigen::Index>(rows.size()), needed);
    for (std::size_t i = 0; i < rows.size(); ++i) picked.row(static_cast<Eigen::Index>(i)) = scaled.row(rows[i]);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(picked.transpose());
    qr.setThreshold(1e-7);
    return qr.rank() == picked.rows();
  };
  // a second pass changes more of a joint that the first has changed already
  for (int pass = 0; pass < 2; ++pass)
    for (int p = parts; p-- > 0 && given_up < needed;) {
      Cure& mine = chosen[static_cast<std::size_t>(p)];
      for (const Cure& cure : cures_of(assembler, p)) {
        const auto more = static_cast<Eigen::Index>(cure.rows.size() - mine.rows.size());
        if (more <= 0 || given_up + more > needed) continue;
        if (!std::includes(cure.rows.begin(), cure.rows.end(), mine.rows.begin(), mine.rows.end())) continue;
        std::vector<Eigen::Index> rows = cure.rows;
        for (int q = 0; q < parts; ++q)
          if (q != p)
            rows.insert(rows.end(), chosen[static_cast<std::size_t>(q)].rows.begin(),
                        chosen[static_cast<std::size_t>(q)].rows.end());
        if (!independent(rows)) continue;
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
